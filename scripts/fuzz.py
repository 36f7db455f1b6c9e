#!/usr/bin/env python3
"""Runs fuzzers, see scripts/fuzz, and prints a line for each: what it ran, what it covers, what it found."""

import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import time

CASES = pathlib.Path(__file__).resolve().parent.parent / "test" / "fuzz"
STATUS = re.compile(r"^#(\d+)\s+(\w+)\s+cov: (\d+) ft: (\d+) corp: (\d+)/")
MINUTES = (1, 10, 30)

# Inputs are small, and so is what may be allocated for one. An input may take a second of processor time, which the
# fuzzers check themselves; the timeout, of wall time, is for what waits.
OPTIONS = ["-timeout=60", "-rss_limit_mb=2048", "-detect_leaks=1", "-print_final_stats=1", "-reload=0"]
LONGEST = {"bag": 8192, "config_yaml": 8192, "core": 8192, "labels_json": 4096, "pcd": 4096, "point_cloud2": 4096}
LARGEST_ALLOCATION = 256  # MB
MEMORY = "/dev/shm"  # a file system without a disk


class Run:
    """One target's run: the coverage over time, and the finding where there is one."""

    def __init__(self, target):
        self.target = target
        self.coverage = []  # seconds, edges, features, corpus
        self.executions = 0
        self.seconds = 0.0
        self.processor_seconds = 0.0
        self.finding = None
        self.status = None

    def note(self, line, elapsed):
        status = STATUS.match(line)
        if status:
            number, event, edges, features, corpus = status.groups()
            self.executions = int(number)
            if event != "READ":
                self.coverage.append((elapsed, int(edges), int(features), int(corpus)))
        written = re.search(r"Test unit written to (\S+)", line)
        if written:
            self.finding = written.group(1)
        executed = re.match(r"stat::number_of_executed_units:\s+(\d+)", line)
        if executed:
            self.executions = int(executed.group(1))

    def edges_after(self, seconds):
        return next((edges for elapsed, edges, _, _ in reversed(self.coverage) if elapsed <= seconds), 0)

    def summary(self):
        text = (f"{self.target:13} {self.executions:9} executions in {self.seconds:5.0f} s, "
                f"{self.processor_seconds:5.0f} s of them on a processor")
        if self.coverage:
            (_, edges, features, _), (_, last_edges, last_features, corpus) = self.coverage[0], self.coverage[-1]
            at = "".join(
                f", {self.edges_after(60 * minutes)} after {minutes} min" for minutes in MINUTES
                if 60 * minutes <= self.seconds + 1)
            text += f"; edges {edges} -> {last_edges}{at}; features {features} -> {last_features}; corpus {corpus}"
        return text + "; " + (self.finding if self.status else "no finding")


def run(target, arguments):
    corpus, findings, logs = (arguments.build / name for name in ("corpus", "findings", "logs"))
    for folder in (corpus / target, findings / target, logs):
        folder.mkdir(parents=True, exist_ok=True)
    command = [str(arguments.build / "bin" / f"fuzz_{target}"), *OPTIONS, f"-max_total_time={arguments.seconds}",
               f"-seed={arguments.seed}", f"-max_len={LONGEST[target]}", f"-artifact_prefix={findings / target}/",
               f"-malloc_limit_mb={LARGEST_ALLOCATION}"]
    dictionary = CASES / f"{target}.dict"
    if dictionary.exists():
        command.append(f"-dict={dictionary}")
    command += [str(folder) for folder in (corpus / target, arguments.seeds / target, CASES / "cases" / target)
                if folder.is_dir()]
    environment = dict(os.environ, UBSAN_OPTIONS="print_stacktrace=1", ASAN_OPTIONS="detect_odr_violation=0")
    if target == "core":  # arithmetic is many times slower under sanitizers; fuzz_cases looks at a second without them
        environment.setdefault("GRASP_AFFORDANCES_TIME_FACTOR", "8")
    if os.access(MEMORY, os.W_OK):  # files of inputs are written over and over: on a disk that takes most of the time
        environment.setdefault("TMPDIR", MEMORY)
    result = Run(target)
    start = time.monotonic()
    with open(logs / f"{target}.log", "w", encoding="utf-8") as log:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                                   errors="replace", env=environment)
        for line in process.stdout:
            elapsed = time.monotonic() - start
            log.write(f"{elapsed:8.1f} {line}")
            log.flush()
            result.note(line, elapsed)
        _, status, usage = os.wait4(process.pid, 0)
    result.status = os.waitstatus_to_exitcode(status)
    result.processor_seconds = usage.ru_utime + usage.ru_stime
    result.seconds = time.monotonic() - start
    if result.status and result.finding is None:
        result.finding = f"exit status {result.status}, see {logs / target}.log"
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="tree with the fuzzers")
    parser.add_argument("--seed", type=int, default=0, help="of the random numbers; 0: another one each time")
    parser.add_argument("--seeds", type=pathlib.Path, required=True, help="folder with a folder of inputs per target")
    parser.add_argument("--seconds", type=int, default=60, help="per target")
    parser.add_argument("--jobs", type=int, default=2, help="fuzzers at a time")
    parser.add_argument("targets", nargs="+", choices=sorted(LONGEST))
    arguments = parser.parse_args()
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        runs = []
        for job in concurrent.futures.as_completed([pool.submit(run, t, arguments) for t in arguments.targets]):
            runs.append(job.result())
            print(runs[-1].summary(), flush=True)
    return 1 if any(result.status for result in runs) else 0


if __name__ == "__main__":
    sys.exit(main())
