#!/usr/bin/env python3
"""Of scripts/free_machine.py: what counts as others, and what becomes of a test where they are busy."""

import os
import subprocess
import sys
import time
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'scripts')
sys.path.insert(0, SCRIPTS)
import free_machine  # noqa: E402

BUSY = [sys.executable, '-c', 'while True: pass']
# init, a shell with a test run that has a test with a node and a node of another test, and a compiler.
PROCESSES = {1: (0, 'init', 7.0), 10: (1, 'bash', 1.0), 20: (10, 'ctest', 2.0), 30: (20, 'python3', 4.0),
             31: (30, 'node', 8.0), 32: (20, 'rostest', 16.0), 33: (32, 'node', 32.0), 40: (10, 'cc1plus', 64.0)}


class FreeMachine(unittest.TestCase):

    def test_all_programs_count_and_what_a_virtual_machine_was_not_given(self):
        ticks = os.sysconf('SC_CLK_TCK')
        stat = 'cpu  %d 0 %d 900 800 700 600 %d 0 0\ncpu0 1 1 1\n' % (3 * ticks, 2 * ticks, ticks)
        self.assertEqual(free_machine.machine_seconds(stat), 3 + 2 + 1)

    def test_a_tree_has_all_descendants(self):
        self.assertEqual(free_machine.tree_seconds(PROCESSES, 30), 4 + 8)
        self.assertEqual(free_machine.tree_seconds(PROCESSES, 20), 2 + 4 + 8 + 16 + 32)
        self.assertEqual(free_machine.tree_seconds(PROCESSES, 99), 0)

    def test_tests_of_one_run_belong_together(self):
        for process in (30, 31, 32, 33):
            self.assertEqual(free_machine.run_of_tests(PROCESSES, process), 20)
        for process in (10, 40):
            self.assertEqual(free_machine.run_of_tests(PROCESSES, process), process)

    def test_a_machine_is_free_where_others_take_little_on_average_and_never_much(self):
        self.assertEqual(free_machine.reason_not_free([]), '')
        self.assertEqual(free_machine.reason_not_free([0.0, 0.25, 0.0, 0.1]), '')
        self.assertIn('0.20 processors on average', free_machine.reason_not_free([0.2, 0.2]))
        self.assertIn('0.60 at most', free_machine.reason_not_free([0.6] + [0.0] * 99))

    def test_what_we_start_is_ours_while_it_runs_and_when_it_has_ended(self):
        def own():
            return free_machine.tree_seconds(free_machine.read_processes(), os.getpid())
        before = own()
        with subprocess.Popen(BUSY) as process:
            end = time.monotonic() + 30
            while own() < before + 0.2:
                self.assertLess(time.monotonic(), end, 'it gets no processor time')
                time.sleep(0.05)
            during = own()
            process.kill()
        self.assertGreater(own(), during - 1e-6)  # sums in any order

    def run_program(self, *command, others=0):
        """free_machine.py with a command, beside others who are busy; its status and what it prints."""
        # As from another run: what this test starts belongs to it. An orphan does not.
        started = [int(subprocess.check_output(['sh', '-c', '"$@" >&- 2>&- & echo $!', 'sh', *BUSY]))
                   for _ in range(others)]
        try:
            result = subprocess.run([sys.executable, os.path.join(SCRIPTS, 'free_machine.py'), '--attempts', '2',
                                     *command], stdout=subprocess.PIPE, encoding='utf-8', check=False)
        finally:
            for process in started:
                os.kill(process, 9)
        return result.returncode, result.stdout

    def test_a_measurement_that_succeeds_is_judged_whatever_else_runs(self):
        self.assertEqual(self.run_program('sleep', '1', others=2), (0, ''))

    def test_one_that_fails_beside_others_is_tried_again_and_skipped(self):
        status, text = self.run_program('sh', '-c', 'echo tried; sleep 1; exit 1', others=2)
        self.assertEqual(status, free_machine.SKIPPED)
        self.assertEqual(text.count('tried'), 2)
        self.assertRegex(text, r'\nSKIPPED: the machine was not free: other programs took \d.\d\d processors')

    def test_one_that_a_signal_ends_has_failed(self):
        status, text = self.run_program('sh', '-c', 'sleep 1; kill -SEGV $$', others=2)
        self.assertEqual((status, text), (128 + 11, ''))


if __name__ == '__main__':
    unittest.main()
