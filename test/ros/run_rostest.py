#!/usr/bin/python3
"""Runs rostest with the arguments given. Unlike rostest it says what was skipped, and why: with exit status 77, unless
something else failed."""

import os
import subprocess
import sys
import tempfile

SKIPPED = 77


def main():
    with tempfile.NamedTemporaryFile('r', prefix='grasp_affordances_skipped_') as reasons:
        status = subprocess.call([sys.executable, '/usr/bin/rostest', *sys.argv[1:]],
                                 env=dict(os.environ, GRASP_AFFORDANCES_SKIPPED=reasons.name))
        text = reasons.read()
    print(text, end='')
    sys.exit(SKIPPED if text and status == 0 else status)


if __name__ == '__main__':
    main()
