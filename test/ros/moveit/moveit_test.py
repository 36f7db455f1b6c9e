#!/usr/bin/python3
"""Where moveit_msgs is found, moveit_grasps is built and plans grasps; here a package stands in for MoveIt's messages."""

import argparse
import os
import signal
import socket
import subprocess
import tempfile

HERE = os.path.dirname(os.path.realpath(__file__))


def run(command, **options):
    subprocess.run(command, check=True, timeout=250, **options)


def before(variable, *paths):
    """These paths before those that an environment variable has, such as of a ROS in /opt/ros."""
    return ':'.join([*paths, *filter(None, [os.environ.get(variable)])])


def build(cmake, source, folder, prefixes, options, targets):
    environment = dict(os.environ, CMAKE_PREFIX_PATH=before('CMAKE_PREFIX_PATH', *prefixes))
    run([cmake, '-S', source, '-B', folder, '-DPYTHON_EXECUTABLE=/usr/bin/python3', *options], env=environment, stdout=subprocess.DEVNULL)
    run([cmake, '--build', folder, '--parallel', '2', '--target', *targets], env=environment, stdout=subprocess.DEVNULL)


def check_libraries(node):
    """A planner of grasps has no use for cameras and for what the localizer is made of."""
    needed = subprocess.run(['ldd', node], check=True, stdout=subprocess.PIPE, universal_newlines=True).stdout
    assert 'libgrasp_affordances_ros.so' in needed, needed
    for library in ('OpenNI2', 'grasp_affordances_cameras', 'grasp_affordances_nodelets'):
        assert library not in needed, needed


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def check_node(node, prefixes, scratch):
    """plan_grasps_check.py with a master of its own."""
    port = free_port()
    python = [os.path.join(prefix, 'lib', 'python3', 'dist-packages') for prefix in prefixes]
    environment = dict(os.environ, ROS_IP='127.0.0.1', ROS_MASTER_URI='http://127.0.0.1:%d' % port, ROS_LOG_DIR=scratch,
                       PYTHONPATH=before('PYTHONPATH', *python, os.path.dirname(HERE)))
    master = subprocess.Popen(['roscore', '-p', str(port)], env=environment, stdout=subprocess.DEVNULL)
    try:
        run([os.path.join(HERE, 'plan_grasps_check.py'), node], env=environment)
    finally:
        master.send_signal(signal.SIGINT)
        master.wait(30)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--cmake', required=True)
    parser.add_argument('--source', required=True, help='source folder of the package')
    parser.add_argument('--devel', required=True, help='devel space of the package, built')
    arguments = parser.parse_args()

    with tempfile.TemporaryDirectory(prefix='grasp_affordances_moveit_') as scratch:
        messages_devel = os.path.join(scratch, 'messages', 'devel')
        prefixes = [messages_devel, arguments.devel]
        build(arguments.cmake, os.path.join(HERE, 'moveit_msgs'), os.path.join(scratch, 'messages'), [],
              ['-DCATKIN_DEVEL_PREFIX=' + messages_devel],
              ['moveit_msgs_generate_messages_cpp', 'moveit_msgs_generate_messages_py'])
        folder = os.path.join(scratch, 'grasps')
        build(arguments.cmake, HERE, folder, prefixes, ['-DGRASP_AFFORDANCES_SOURCE_DIR=' + arguments.source,
              '-DGRASP_AFFORDANCES_DEVEL=' + arguments.devel], ['moveit_grasps', 'moveit_grasps_test'])
        run([os.path.join(folder, 'moveit_grasps_test')])
        node = os.path.join(folder, 'moveit', 'moveit_grasps')
        check_libraries(node)
        check_node(node, prefixes, scratch)


if __name__ == '__main__':
    main()
