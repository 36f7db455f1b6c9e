#!/usr/bin/python3
"""Configured without OpenNI2, the package has no driver and no virtual devices, without CLI11 no tools; it says so, and
keeps all the rest."""

import argparse
import json
import os
import re
import shlex
import subprocess
import tempfile

LEFT_OUT = ('grasp_affordances_openni2', 'grasp_affordances_virtual_device', 'xtion_node', 'record_oni', 'device_test',
            'depth_image_test', 'sensor_rostest_nodes')
KEPT = ('grasp_affordances_cameras', 'grasp_affordances_nodelets', 'pcd_publisher', 'camera_nodes', 'localizer_node',
        'nodelets_test', 'rostest_nodes')
MESSAGE = 'Without OpenNI2 (Debian package libopenni2-dev)'
TOOLS = ('localize', 'simulate', 'evaluate', 'localize_test', 'frame_ratios')
KEPT_WITHOUT_TOOLS = KEPT + ('write_scene', 'fuzz_cases')
TOOLS_MESSAGE = 'CLI11 was not found (Debian package libcli11-dev)'
STAND_IN = 'xtion_nodelet_left_out.cpp'
OPENNI2_SOURCES = r'/src/(openni2|virtual_device)/|/xtion_nodelet\.cpp$|/xtion_node\.cpp$|/xtion_parameters'

# pkg-config where libopenni2 is not installed.
PKG_CONFIG = '''#!/bin/sh
case "$*" in *openni2*) exit 1 ;; esac
exec pkg-config "$@"
'''


def run(command, **options):
    return subprocess.run(command, check=True, timeout=110, stdout=subprocess.PIPE, universal_newlines=True,
                          **options).stdout


def check_targets(cmake, folder, left_out, kept):
    targets = set(re.findall(r'[\w.+-]+', run([cmake, '--build', folder, '--target', 'help'])))
    assert not targets.intersection(left_out), targets.intersection(left_out)
    assert targets.issuperset(kept), set(kept) - targets


def check_build(cmake, folder, said):
    assert said.count(MESSAGE) == 1, said
    check_targets(cmake, folder, LEFT_OUT, KEPT)
    with open(os.path.join(folder, 'compile_commands.json')) as file:
        commands = json.load(file)
    sources = [entry['file'] for entry in commands if re.search(OPENNI2_SOURCES, entry['file'])]
    assert not sources, sources
    return {os.path.basename(entry['file']): entry for entry in commands}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--cmake', required=True)
    parser.add_argument('--source', required=True, help='source folder of the package')
    arguments = parser.parse_args()

    with tempfile.TemporaryDirectory(prefix='grasp_affordances_left_out_') as scratch:
        build = os.path.join(scratch, 'build')
        pkg_config = os.path.join(scratch, 'pkg-config')
        with open(pkg_config, 'w') as file:
            file.write(PKG_CONFIG)
        os.chmod(pkg_config, 0o755)
        configure = [arguments.cmake, '-S', arguments.source, '-B', build, '-DCATKIN_ENABLE_TESTING=ON',
                     '-DPYTHON_EXECUTABLE=/usr/bin/python3', '-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON',
                     '-DCMAKE_UNITY_BUILD=OFF']  # the names of the sources are looked at

        # Not asked for; then asked for and not found.
        check_build(arguments.cmake, build, run(configure + ['-DGRASP_AFFORDANCES_OPENNI2=OFF']))
        commands = check_build(arguments.cmake, build, run(configure + ['-DGRASP_AFFORDANCES_OPENNI2=ON',
                                                                        '-DPKG_CONFIG_EXECUTABLE=' + pkg_config]))

        said = run(configure + ['-DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON'])
        assert said.count(TOOLS_MESSAGE) == 1, said
        check_targets(arguments.cmake, build, TOOLS, KEPT_WITHOUT_TOOLS)

        # What stands in for the driver's nodelet compiles.
        entry = commands[STAND_IN]
        run(shlex.split(entry['command']) + ['-fsyntax-only'], cwd=entry['directory'])


if __name__ == '__main__':
    main()
