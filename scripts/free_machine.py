#!/usr/bin/env python3
"""Whether a machine was free while something was measured on it: how much processor time other programs took.

As a program: free_machine.py [--attempts N] COMMAND [ARGUMENT ...] runs a test that measures times. Where the test fails
and the machine was not free, it is run again. Exit status: that of the test, or 77 where no attempt could be judged;
the reason is printed. A test that a signal ends has failed, whatever else ran."""

import argparse
import os
import subprocess
import sys
import threading
import time

SKIPPED = 77       # exit status of a test that says nothing
PERIOD = 1.0       # s, between two looks at the machine
MEAN_LIMIT = 0.1   # processors that others may take on average where a machine is called free
PEAK_LIMIT = 0.3   # processors that others may take in any period

_TICKS = os.sysconf('SC_CLK_TCK')
_RUNNERS = ('ctest', 'rostest')  # of tests: what they start belongs to us


def machine_seconds(text):
    """Processor time that all programs took since the machine was started, in s; `text`: of /proc/stat. Time that a
    virtual machine was not given (steal) counts too."""
    user, nice, system, _, _, _, _, steal = (int(word) for word in text.split('\n', 1)[0].split()[1:9])
    return (user + nice + system + steal) / _TICKS


def read_processes():
    """{process: (its parent, its name, its processor time and that of its ended children in s)}"""
    processes = {}
    for name in os.listdir('/proc'):
        if name.isdigit():
            try:
                with open('/proc/%s/stat' % name) as file:
                    head, _, tail = file.read().rpartition(')')
            except (FileNotFoundError, ProcessLookupError):
                continue  # it has ended
            fields = tail.split()
            processes[int(name)] = (int(fields[1]), head.partition('(')[2], sum(map(int, fields[11:15])) / _TICKS)
    return processes


def tree_seconds(processes, root):
    """Processor time of a process and of all that it has started, in s."""
    children = {}
    for process, (parent, _, _) in processes.items():
        children.setdefault(parent, []).append(process)
    total, waiting = 0.0, [root]
    while waiting:
        process = waiting.pop()
        if process in processes:
            total += processes[process][2]
        waiting += children.get(process, [])
    return total


def run_of_tests(processes, process):
    """The outermost program that runs tests, of those that have started a process; else the process itself."""
    root = process
    while process in processes:
        process = processes[process][0]
        if process in processes and processes[process][1] in _RUNNERS:
            root = process
    return root


def reason_not_free(others):
    """Why a machine was not free in which others took so many processors in each period; empty where it was."""
    mean, peak = sum(others) / max(len(others), 1), max(others, default=0.0)
    if mean <= MEAN_LIMIT and peak <= PEAK_LIMIT:
        return ''
    return 'the machine was not free: other programs took %.2f processors on average and %.2f at most' % (mean, peak)


class Watch:
    """Watches the machine while its block runs. What ctest or rostest has started, this process among it, is not taken
    for others; where neither runs, what this process has started is not."""

    def __init__(self):
        self._root = run_of_tests(read_processes(), os.getpid())
        self._others = []
        self._lock = threading.Lock()
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self):
        self._last = self._look()
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ending.set()
        self._thread.join()

    def _look(self):
        with open('/proc/stat') as file:
            text = file.read()
        return time.monotonic(), machine_seconds(text), tree_seconds(read_processes(), self._root)

    def _run(self):
        while not self._ending.wait(PERIOD):
            self._note()

    def _note(self):
        with self._lock:
            now, last = self._look(), self._last
            elapsed, machine, own = (new - old for new, old in zip(now, last))
            if elapsed >= PERIOD / 2:  # the times have steps of 10 ms
                self._others.append(max(machine - own, 0.0) / elapsed)
                self._last = now

    def others(self):
        """Processors that others took, period by period until now."""
        self._note()
        with self._lock:
            return list(self._others)

    def mean(self):
        """Processors that others took on average."""
        others = self.others()
        return sum(others) / max(len(others), 1)

    def reason_not_free(self):
        """Why what was measured since the beginning of the block says nothing; empty where it does."""
        return reason_not_free(self.others())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--attempts', type=int, default=3, help='at most (default: %(default)d)')
    parser.add_argument('command', nargs=argparse.REMAINDER, metavar='COMMAND [ARGUMENT ...]')
    options = parser.parse_args()
    if options.attempts < 1 or not options.command:
        parser.error('needs a command and at least one attempt')
    for attempt in range(1, options.attempts + 1):
        with Watch() as machine:
            status = subprocess.call(options.command)
            reason = machine.reason_not_free()
        if status <= 0 or not reason:
            break
        print('attempt %d of %d is not judged: %s' % (attempt, options.attempts, reason), flush=True)
    else:
        print('SKIPPED: ' + reason, flush=True)
        sys.exit(SKIPPED)
    sys.exit(status if status >= 0 else 128 - status)


if __name__ == '__main__':
    main()
