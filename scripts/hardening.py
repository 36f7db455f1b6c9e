#!/usr/bin/env python3
"""Looks into the programs and libraries of a build folder for what the distribution's hardening flags bring.

Every one must be position-independent, with relocations that are read-only after all symbols have been bound at the
start. Every source must have been compiled with stack protectors and fortified functions, and the programs and
libraries that have both the most of our code and input from elsewhere must call them.
"""

import json
import os
import re
import subprocess
import sys

# Name of a file: what it must import, as there are buffers on its stacks and calls with known buffers in it.
PROTECTED = {
    'libgrasp_affordances_cameras.so': ('__stack_chk_fail', r'__\w+_chk'),
    'libgrasp_affordances_nodelets.so': ('__stack_chk_fail', r'__\w+_chk'),
    'localize': ('__stack_chk_fail', r'__\w+_chk'),
    'simulate': ('__stack_chk_fail', r'__\w+_chk'),
}


def readelf(*arguments):
    return subprocess.run(['readelf', '--wide', *arguments], check=True, capture_output=True, text=True).stdout


def is_elf(path):
    with open(path, 'rb') as file:
        return file.read(4) == b'\x7fELF'


def built(folder):
    """Programs and shared libraries below a folder, but not those of CMake's own tries."""
    for parent, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if name != 'CMakeFiles']
        for name in sorted(files):
            path = os.path.join(parent, name)
            if not os.path.islink(path) and not name.endswith('.o') and is_elf(path):
                yield path


def faults_of_file(path):
    dynamic = readelf('--dynamic', path)
    segments = readelf('--program-headers', path)
    header = readelf('--file-header', path)
    faults = []
    is_program = 'INTERP' in segments
    if not re.search(r'Type:\s+DYN', header) or (is_program and not re.search(r'FLAGS_1\).*\bPIE\b', dynamic)):
        faults.append('is not position-independent')
    if 'GNU_RELRO' not in segments:
        faults.append('has writable relocations (no GNU_RELRO)')
    if not re.search(r'\(FLAGS(_1)?\).*\b(BIND_NOW|NOW)\b', dynamic):
        faults.append('binds symbols lazily (no BIND_NOW)')
    if re.search(r'GNU_STACK.*RWE', segments):
        faults.append('has an executable stack')
    symbols = readelf('--dyn-syms', path)
    for wanted in PROTECTED.get(os.path.basename(path), ()):
        if not re.search(r'UND {}\b'.format(wanted), symbols):
            faults.append('calls no ' + wanted)
    return faults


def faults_of_command(command):
    return ['compiled without ' + flag for flag in ('-fstack-protector-strong', '-D_FORTIFY_SOURCE=2')
            if flag not in command.split()]


def main():
    folder = sys.argv[1]
    with open(os.path.join(folder, 'compile_commands.json')) as file:
        commands = json.load(file)
    files = list(built(folder))
    faults = [(entry['file'], fault) for entry in commands for fault in faults_of_command(entry['command'])]
    faults += [(path, fault) for path in files for fault in faults_of_file(path)]
    absent = set(PROTECTED) - {os.path.basename(path) for path in files}
    faults += [(name, 'is absent') for name in sorted(absent)]
    for path, fault in faults:
        print('{}: {}'.format(path, fault), file=sys.stderr)
    print('Hardening of {} programs and libraries from {} sources: {} faults'.format(
        len(files), len(commands), len(faults)))
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
