#!/usr/bin/env python3
"""suite_page.py DIR: makes DIR/index.html of the suite.json that `evaluate --suite NAME --out DIR` left there.

A page to look through by cell of the grid: a click on a number lists its errors by cause, with the pictures that lie
beside the page. It needs no server.
"""

import html
import json
import os
import sys

# What a click on a number shows: kinds of errors.
KINDS = {
    "one": ["miss", "no-handle", "several-handles"],
    "none": ["miss", "no-handle"],
    "several": ["several-handles"],
    "wrong": ["wrong-handle"],
    "recall": ["miss"],
    "precision": ["wrong"],
}

PAGE = """<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>%(title)s</title>
<style>
body { font: 14px/1.4 sans-serif; margin: 1em 2em; color: #222; background: #fff; }
table { border-collapse: collapse; margin: 0 0 1.5em; }
th, td { border: 1px solid #ccc; padding: 3px 7px; text-align: left; vertical-align: top; white-space: nowrap; }
th { background: #f0f0f0; font-weight: normal; }
.overflow { overflow-x: auto; }
button { font: inherit; border: 0; padding: 0 2px; background: none; color: #0645ad; cursor: pointer; }
button:hover, button.shown { background: #ffe9a8; }
.one { font-weight: bold; }
.bar { display: inline-block; height: 0.7em; background: #7aa6d8; }
#errors { border-top: 3px solid #ffe9a8; padding-top: 0.5em; }
figure { display: inline-block; width: 420px; margin: 0 1em 1em 0; vertical-align: top; }
figure img { width: 100%%; background: #eee; }
figcaption { font-size: 12px; }
</style>
<h1>%(title)s</h1>
<p>%(coverage)s A click on a number shows its errors below the tables, by cause.</p>
%(tables)s
<div id="errors"></div>
<script type="application/json" id="suite">%(data)s</script>
<script>
%(script)s
</script>
</html>
"""

SCRIPT = """
"use strict";
const suite = JSON.parse(document.getElementById("suite").textContent);
const kinds = %s;

function add(parent, tag, text) {
  const element = document.createElement(tag);
  if (text !== undefined) element.textContent = text;
  return parent.appendChild(element);
}

function addEnds(parent, ends) {
  const all = Object.values(ends).reduce((sum, count) => sum + count, 0);
  const table = add(parent, "table");
  for (const [outcome, count] of Object.entries(ends).sort((a, b) => b[1] - a[1])) {
    const row = add(table, "tr");
    add(row, "td", outcome);
    add(row, "td", count);
    const bar = add(add(row, "td"), "span");
    bar.className = "bar";
    bar.style.width = 200 * count / all + "px";
  }
}

function addScenes(parent, scenes) {
  const table = add(parent, "table");
  const head = add(table, "tr");
  for (const title of ["scene", "exactly one", "none", "several", "wrong handles", "shells: found", "wrong shells"])
    add(head, "th", title);
  for (const scene of scenes) {
    const row = add(table, "tr");
    const of = " of " + scene.handles.affordances;
    for (const text of [scene.scene, scene.handles.one + of, scene.handles.none, scene.handles.several,
                        scene.handles.wrong, scene.shells.found + of, scene.shells.wrong])
      add(row, "td", text);
  }
}

function addReliability(parent, bins) {
  const table = add(parent, "table");
  for (const bin of bins) {
    const row = add(table, "tr");
    add(row, "td", "score " + bin.from + " to " + bin.to);
    add(row, "td", bin.right + " right, " + bin.wrong + " wrong");
  }
}

function addError(parent, pictures, error) {
  const figure = add(parent, "figure");
  if (error.picture) {
    const link = add(figure, "a");
    link.href = pictures + "/" + error.picture;
    const image = add(link, "img");
    image.loading = "lazy";
    image.src = link.href;
  }
  const place = error.scene + (error.seed ? ", seed " + error.seed : "") + ", run " + error.run + ": ";
  const caption = add(figure, "figcaption", place + error.what + (error.picture ? "" : " (no picture)"));
  if (error.ends) {
    const ends = Object.entries(error.ends).sort((a, b) => b[1] - a[1]);
    add(caption, "div", "samples on it: " + (ends.map(([name, count]) => count + " " + name).join(", ") || "none"));
  }
}

function show(button) {
  const cell = suite.cells[button.dataset.cell];
  const result = cell.results[button.dataset.result];
  const errors = result.errors.filter(error => kinds[button.dataset.show].includes(error.kind));
  for (const other of document.querySelectorAll("button.shown")) other.classList.remove("shown");
  button.classList.add("shown");
  const panel = document.getElementById("errors");
  panel.replaceChildren();
  add(panel, "h2", [cell.cell.row, cell.cell.sensor, cell.cell.background, result.preset].join(", ") + ": " +
                   button.title);
  addScenes(panel, result.scenes);
  if (result.missed.affordances > 0) {
    add(panel, "p", "Where the samples ended on the " + result.missed.affordances +
                    " affordances that no right handle finds:");
    addEnds(panel, result.missed.ends);
  }
  add(panel, "p", "Handles by their score:");
  addReliability(panel, result.reliability);
  const causes = new Map();
  for (const error of errors) causes.set(error.cause, [...(causes.get(error.cause) || []), error]);
  for (const [cause, list] of [...causes].sort((a, b) => b[1].length - a[1].length)) {
    const section = add(panel, "section");
    add(section, "h3", cause + " (" + list.length + ")");
    for (const error of list) addError(section, cell.pictures, error);
  }
  if (errors.length === 0) add(panel, "p", "No error.");
  panel.scrollIntoView();
}

document.addEventListener("click", event => {
  if (event.target.matches("button[data-cell]")) show(event.target);
});
"""


def percent(share):
    return "–" if share is None else "%.1f" % (100 * share)


def number(cell, result, show, text, title):
    return '<button class="%s" data-cell="%d" data-result="%d" data-show="%s" title="%s">%s</button>' % (
        show, cell, result, show, title, html.escape(text))


def handles_cell(cell, index, numbers):
    handles = numbers["handles"]
    parts = []
    if handles["affordances"]:
        parts.append("%s of %d<br>%s none, %s several" % (
            number(cell, index, "one", percent(handles["exactly_one"]), "not exactly one handle"),
            handles["affordances"],
            number(cell, index, "none", str(handles["none"]), "no handle"),
            number(cell, index, "several", str(handles["several"]), "several handles")))
    parts.append("%s wrong, precision %s" % (
        number(cell, index, "wrong", str(handles["wrong"]), "wrong handles"), percent(handles["precision"])))
    shells = numbers["shells"]
    parts.append("shells: recall %s, precision %s" % (
        number(cell, index, "recall", percent(shells["recall"]), "affordances without a right shell"),
        number(cell, index, "precision", percent(shells["precision"]), "wrong shells")))
    return "<br>".join(parts)


def distinct(values):
    return list(dict.fromkeys(values))


def grid(entries):
    """entries: (row, column, html)."""
    columns = distinct(column for _, column, _ in entries)
    cells = {(row, column): content for row, column, content in entries}
    lines = ["<div class=\"overflow\"><table>", "<tr><th></th>%s</tr>" % "".join(
        "<th>%s</th>" % html.escape(", ".join(column)) for column in columns)]
    for row in distinct(row for row, _, _ in entries):
        lines.append("<tr><th>%s</th>%s</tr>" % (html.escape(row), "".join(
            "<td>%s</td>" % cells.get((row, column), "") for column in columns)))
    return "\n".join(lines + ["</table></div>"])


def tables(cells):
    sections = {}
    for i, cell in enumerate(cells):
        what = cell["cell"]
        for j, result in enumerate(cell["results"]):
            entry = (what["row"], (what["sensor"], what["background"]), handles_cell(i, j, result))
            sections.setdefault((result["preset"], what["capture_radius"]), []).append(entry)
    return "\n".join("<h2>Preset %s, capture radius %.4g cm</h2>\n%s" % (
        html.escape(preset), 100 * radius, grid(entries)) for (preset, radius), entries in sections.items())


def coverage(cells):
    frames = sum(cell["results"][0]["frames"] for cell in cells)
    return "%d cells, %d frames; evaluated in %.0f minutes. Shares in percent, of affordances with 200 points or more." \
        % (len(cells), frames, sum(cell["seconds"] for cell in cells) / 60)


def page(suite):
    return PAGE % {
        "title": html.escape("Suite " + suite["suite"]),
        "coverage": coverage(suite["cells"]),
        "tables": tables(suite["cells"]),
        "data": json.dumps(suite, separators=(",", ":")).replace("<", "\\u003c"),  # no tag in a string ends the script
        "script": SCRIPT % json.dumps(KINDS),
    }


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(os.path.join(sys.argv[1], "suite.json"), encoding="utf-8") as file:
        suite = json.load(file)
    with open(os.path.join(sys.argv[1], "index.html"), "w", encoding="utf-8") as file:
        file.write(page(suite))


if __name__ == "__main__":
    main()
