#!/usr/bin/env python3
"""plot_evaluation.py DIR: draws what `evaluate --out DIR` measured.

precision-PRESET.png: precision per scene and estimator (figure 6 of the paper), from summary.json.
runtime.png: running time against the number of samples (figure 7), from runtime.csv where there is one.
samples-PRESET.png: recall against the number of samples, from samples.csv where there is one, instead of precision.
Error bars are 95 % confidence intervals.
"""

import csv
import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402: the backend is chosen first

ESTIMATORS = {"taubin": ("Taubin", "tab:blue"), "pca": ("PCA", "tab:green"), "normals": ("Normals", "tab:red")}


def error_bars(values, intervals):
    """Distances to the ends of the intervals; none where there is no interval."""
    below = [value - interval[0] if interval else 0.0 for value, interval in zip(values, intervals)]
    above = [interval[1] - value if interval else 0.0 for value, interval in zip(values, intervals)]
    return [below, above]


def plot_precision(rows, preset, path):
    """Bars of the mean precision over the units of each scene with a defined precision."""
    rows = [row for row in rows if row["preset"] == preset and row["views"] == 1 and not row["group"]]
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    estimators = [name for name in ESTIMATORS if any(row["estimator"] == name for row in rows)]
    width = 0.8 / len(estimators)
    figure, axes = plt.subplots(figsize=(max(6.0, 0.9 * len(scenes)), 4.0))
    for i, estimator in enumerate(estimators):
        bars = {scenes.index(row["scene"]): row["unit_precision"] for row in rows
                if row["estimator"] == estimator and row["unit_precision"]["mean"] is not None}
        means = [bar["mean"] for bar in bars.values()]
        label, color = ESTIMATORS[estimator]
        axes.bar([scene + (i - (len(estimators) - 1) / 2) * width for scene in bars], means, width, label=label,
                 color=color, yerr=error_bars(means, [bar["interval"] for bar in bars.values()]), capsize=2)
    axes.set_xticks(range(len(scenes)))
    axes.set_xticklabels(scenes, rotation=30, ha="right")
    axes.set_ylim(0.0, 1.05)
    axes.set_ylabel("precision")
    axes.set_title("Precision with the preset %s, 95 %% confidence intervals" % preset)
    axes.grid(axis="y", alpha=0.3)
    axes.set_axisbelow(True)
    figure.legend(loc="lower center", ncol=len(estimators))
    figure.tight_layout(rect=(0.0, 0.07, 1.0, 1.0))
    figure.savefig(path, dpi=120)
    plt.close(figure)


def plot_runtime(rows, path):
    """Milliseconds against samples, with one panel per preset; logarithmic, for Normals takes much longer."""
    presets = list(dict.fromkeys(row["preset"] for row in rows))
    figure, panels = plt.subplots(1, len(presets), figsize=(5.5 * len(presets), 4.0), sharey=True, squeeze=False)
    for preset, axes in zip(presets, panels[0]):
        for estimator, (label, color) in ESTIMATORS.items():
            line = [row for row in rows if row["preset"] == preset and row["estimator"] == estimator]
            if not line:
                continue
            means = [float(row["milliseconds"]) for row in line]
            intervals = [(float(row["milliseconds_low"]), float(row["milliseconds_high"])) for row in line]
            axes.errorbar([int(row["samples"]) for row in line], means, yerr=error_bars(means, intervals),
                          label=label, color=color, marker="o", markersize=3, capsize=2)
        axes.set_yscale("log")
        axes.set_xlabel("samples")
        axes.set_title("preset %s, %s nearest neighbors" % (preset, rows[0]["k"]))
        axes.grid(alpha=0.3, which="both")
        axes.legend()
    panels[0][0].set_ylabel("time per cloud [ms]")
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def plot_samples(rows, preset, path):
    """Recall of affordances with at least 200 points: shells, at least one handle, exactly one handle."""
    rows = [row for row in rows if row["preset"] == preset and row["views"] == "1"]
    rows = [row for row in rows if row["group"] == "1"] or rows
    curves = {"recall_200": "shells", "handle_recall_200": "at least one handle", "exactly_one_200": "one handle"}
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    figure, panels = plt.subplots(len(scenes), len(curves), figsize=(4.0 * len(curves), 3.5 * len(scenes)),
                                  sharex=True, sharey=True, squeeze=False)
    for scene, line_of_panels in zip(scenes, panels):
        for (column, title), axes in zip(curves.items(), line_of_panels):
            for estimator, importance in dict.fromkeys((row["estimator"], row["importance"]) for row in rows):
                line = sorted((int(row["samples"]), float(row[column])) for row in rows
                              if row["scene"] == scene and row["estimator"] == estimator
                              and row["importance"] == importance and row[column])
                label, color = ESTIMATORS[estimator]
                axes.plot(*zip(*line), label="%s, importance sampling %s" % (label, importance), color=color,
                          linestyle="-" if importance == "on" else "--", marker="o", markersize=3)
            ticks = sorted({int(row["samples"]) for row in rows})
            axes.set_xscale("log")
            axes.set_xticks(ticks)
            axes.set_xticklabels(ticks)
            axes.minorticks_off()
            axes.set_title("%s: %s" % (scene, title), fontsize=10)
            axes.set_xlabel("samples")
            axes.grid(alpha=0.3, which="both")
    panels[0][0].set_ylabel("affordances of 200 points or more")
    panels[0][0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    with open(os.path.join(folder, "summary.json")) as file:
        summary = json.load(file)
    presets = list(dict.fromkeys(row["preset"] for row in summary))
    samples = os.path.join(folder, "samples.csv")
    if os.path.exists(samples):
        with open(samples) as file:
            rows = list(csv.DictReader(file))
        for preset in presets:
            plot_samples(rows, preset, os.path.join(folder, "samples-%s.png" % preset))
    else:
        for preset in presets:
            plot_precision(summary, preset, os.path.join(folder, "precision-%s.png" % preset))
    runtimes = os.path.join(folder, "runtime.csv")
    if os.path.exists(runtimes):
        with open(runtimes) as file:
            plot_runtime(list(csv.DictReader(file)), os.path.join(folder, "runtime.png"))


if __name__ == "__main__":
    main()
