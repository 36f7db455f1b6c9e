#!/usr/bin/env python3
"""Runs clang-tidy over sources of a build, see scripts/check. Most of its time goes into the headers of libraries, so that
sources with the same compiler options are read together, as far as their names do not clash."""

import argparse
import concurrent.futures
import itertools
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

TOGETHER = 8
OURS = r"/(include/grasp_affordances|src|test)/([a-z0-9_]+/)*[a-z0-9_]+\.(h|cpp)$"
# Precompiled headers are GCC's; clang cannot read them.
UNITY = re.compile(r"/Unity/unity_\d+_cxx\.cxx$")
NOT_FOR_CLANG = re.compile(r" (-Winvalid-pch|-include \S*cmake_pch\S*)")


def sources_of(unity):
    """The sources that CMake has compiled as one."""
    return re.findall(r'^#include "(.*)"$', pathlib.Path(unity).read_text(), re.MULTILINE)


def read_groups(build, wanted):
    """{(folder, compiler options): sources}. Of a source that is compiled several times the first is taken."""
    groups, seen = {}, set()
    for entry in json.loads((build / "compile_commands.json").read_text()):
        compiled = entry["file"]
        files = sources_of(compiled) if UNITY.search(compiled) else [compiled]
        files = [file for file in files
                 if file not in seen and not file.startswith(f"{build}/") and (not wanted or file in wanted)]
        if not files:
            continue
        seen.update(files)
        command = shlex.split(NOT_FOR_CLANG.sub("", entry["command"]))
        if "ccache" in command[0]:
            command.pop(0)
        output = command.index("-o")
        options = command[1:output] + command[output + 2:]
        options.remove("-c")
        options.remove(compiled)
        groups.setdefault((entry["directory"], tuple(options)), []).extend(files)
    if wanted - seen or not seen:
        sys.exit(f"not in {build}/compile_commands.json: {', '.join(sorted(wanted - seen)) or 'any source'}")
    return groups


class Tidy:
    def __init__(self, folder):
        self._folder = folder
        self._numbers = itertools.count()  # which threads may share

    def look(self, directory, options, sources):
        """What clang-tidy says of the sources; None: nothing."""
        file = sources[0]
        if len(sources) > 1:
            file = str(self._folder / f"together_{next(self._numbers)}.cpp")
            pathlib.Path(file).write_text("".join(f'#include "{source}"\n' for source in sources))
            syntax = ["clang++-14", *options, "-w", "-fsyntax-only", file]
            if subprocess.run(syntax, cwd=directory, capture_output=True, check=False).returncode:
                half = len(sources) // 2
                said = [self.look(directory, options, some) for some in (sources[:half], sources[half:])]
                return "".join(text for text in said if text) or None
        command = ["clang-tidy-14", "--quiet", f"--header-filter={OURS}", "--checks=-bugprone-suspicious-include", file,
                   "--", *options]
        result = subprocess.run(command, cwd=directory, capture_output=True, encoding="utf-8", check=False)
        if result.returncode == 0:
            return None
        errors = [line for line in result.stderr.splitlines() if not line.endswith(" generated.")]
        return result.stdout + "\n".join(errors) or f"clang-tidy failed on {file}\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path, help="folder with compile_commands.json")
    parser.add_argument("sources", nargs="*", type=os.path.abspath, help="all of the build where none is given")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    folder = build / "tidy"
    folder.mkdir(exist_ok=True)
    tidy = Tidy(folder)
    jobs = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (directory, options), sources in read_groups(build, set(arguments.sources)).items():
            for i in range(0, len(sources), TOGETHER):
                jobs.append(pool.submit(tidy.look, directory, options, sources[i:i + TOGETHER]))
        said = False
        for job in concurrent.futures.as_completed(jobs):
            if job.result():
                said = True
                print(job.result(), flush=True)
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main())
