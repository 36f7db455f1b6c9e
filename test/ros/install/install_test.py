#!/usr/bin/python3
"""Another package finds the core library, in the devel space and in an installed copy; both have the tools on the PATH, and
the copy runs its launch files."""

import argparse
import os
import signal
import socket
import subprocess
import tempfile
import xml.etree.ElementTree

# What the core library uses inside must not be needed by those who use the core library.
PRIVATE_PACKAGES = ('PCL', 'TBB', 'yaml-cpp')


def run(command, **options):
    subprocess.run(command, check=True, timeout=100, **options)


def before(variable, *paths):
    """These paths before those that an environment variable has, such as of a ROS in /opt/ros."""
    return ':'.join([*paths, *filter(None, [os.environ.get(variable)])])


def build_consumer(cmake, prefix, build):
    source = os.path.join(os.path.dirname(os.path.realpath(__file__)), 'consumer')
    hidden = ['-DCMAKE_DISABLE_FIND_PACKAGE_%s=TRUE' % package for package in PRIVATE_PACKAGES]
    environment = dict(os.environ, CMAKE_PREFIX_PATH=before('CMAKE_PREFIX_PATH', prefix))
    run([cmake, '--no-warn-unused-cli', '-S', source, '-B', build] + hidden, env=environment, stdout=subprocess.DEVNULL)
    run([cmake, '--build', build], stdout=subprocess.DEVNULL)
    for consumer in ('target_consumer', 'catkin_consumer'):
        run([os.path.join(build, consumer)])


def check_libraries(prefix):
    """The localizer's library needs neither the cameras' nor OpenNI2; no library of plugins needs another one."""
    libraries = os.path.join(prefix, 'lib')
    environment = dict(os.environ, LD_LIBRARY_PATH=libraries)
    for name, strangers in (('nodelets', ('OpenNI2', 'grasp_affordances_cameras')),
                            ('cameras', ('grasp_affordances_nodelets',))):
        library = os.path.join(libraries, 'libgrasp_affordances_%s.so' % name)
        needed = subprocess.run(['ldd', library], check=True, stdout=subprocess.PIPE, env=environment).stdout.decode()
        assert os.path.join(libraries, 'libgrasp_affordances_ros.so') in needed, needed
        for stranger in strangers:
            assert stranger not in needed, needed


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


class SourcedShell:
    """A shell that has sourced the setup.bash of an installed copy, or of a devel space, and knows nothing else."""

    def __init__(self, prefix, home):
        self.setup = os.path.join(prefix, 'setup.bash')
        self.port = free_port()
        self.environment = {'PATH': '/usr/bin:/bin', 'HOME': home, 'ROS_IP': '127.0.0.1', 'LC_ALL': 'C.UTF-8'}

    def command(self, text):
        master = 'export ROS_MASTER_URI=http://127.0.0.1:%d' % self.port
        return ['bash', '-c', 'source %s && %s && exec %s' % (self.setup, master, text)]

    def answer(self, text):
        return subprocess.run(self.command(text), env=self.environment, check=True, timeout=40,
                              stdout=subprocess.PIPE).stdout.decode()

    def start(self, text):
        return subprocess.Popen(self.command(text), env=self.environment, start_new_session=True)


def has_tools(prefix):
    """They are left out where CLI11 is missing."""
    return os.path.exists(os.path.join(prefix, 'lib', 'grasp_affordances', 'simulate'))


def check_path(prefix, scratch):
    """The lines of the documents run as they are printed, however often setup.bash is sourced."""
    shell = SourcedShell(prefix, scratch)
    tools = os.path.join(prefix, 'lib', 'grasp_affordances')
    names = ('localize', 'simulate', 'evaluate')
    found = shell.answer('bash -c "command -v %s"' % ' '.join(names)).split()
    assert found == [os.path.join(tools, name) for name in names], found
    version = shell.answer('localize --version')
    assert version.startswith('localize '), version
    path = shell.answer('bash -c "source %s && echo \\$PATH"' % shell.setup).strip().split(':')
    assert path.count(tools) == 1, path
    assert '/usr/bin' in path and '/bin' in path, path


def check_launch_files(prefix):
    """Whatever node of ours an installed launch file starts is installed. Names that arguments make up are left out."""
    folder = os.path.join(prefix, 'share', 'grasp_affordances', 'launch')
    types = set()
    for file in os.listdir(folder):
        for node in xml.etree.ElementTree.parse(os.path.join(folder, file)).iter('node'):
            if node.get('pkg') == 'grasp_affordances' and '$' not in node.get('type'):
                types.add(node.get('type'))
    assert 'pcd_publisher' in types, types
    for name in types:
        assert os.access(os.path.join(prefix, 'lib', 'grasp_affordances', name), os.X_OK), name


def check_launch(prefix, devel, scratch):
    shell = SourcedShell(prefix, scratch)
    share = os.path.join(prefix, 'share', 'grasp_affordances')
    assert shell.answer('rospack find grasp_affordances').strip() == share
    plugins = shell.answer('rospack plugins --attrib=plugin nodelet')
    for file in ('nodelet_plugins.xml', 'camera_plugins.xml'):
        assert os.path.join(share, file) in plugins, plugins
        assert os.path.exists(os.path.join(share, file)), file

    scene = os.path.join(scratch, 'table.pcd')
    if has_tools(prefix):
        shell.answer('rosrun grasp_affordances simulate --scene table --seed 1 --out ' + scene)
    else:
        run([os.path.join(devel, 'lib', 'grasp_affordances', 'write_scene'), 'table', '1', '0', '0', scene])
    launch = shell.start('roslaunch -p %d grasp_affordances pcd.launch file:=%s' % (shell.port, scene))
    try:
        shell.answer('bash -c "until rosparam get /localizer/preset; do sleep 0.2; done" 2>/dev/null')
        statistics = shell.answer('rostopic echo -n 1 /localizer/statistics')
        assert 'sampled: 2000' in statistics, statistics
        assert 'shells: 0' not in statistics, statistics
        picked = shell.answer('rosrun grasp_affordances pick_best.py')
        assert picked.startswith('handle '), picked
        launch.send_signal(signal.SIGINT)
        assert launch.wait(30) == 0
    finally:
        if launch.poll() is None:
            os.killpg(launch.pid, signal.SIGKILL)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--cmake', required=True)
    parser.add_argument('--build', required=True, help='build folder, built')
    parser.add_argument('--devel', required=True, help='devel space of that build')
    parser.add_argument('--prefix', required=True, help='install prefix of that build')
    arguments = parser.parse_args()

    with tempfile.TemporaryDirectory(prefix='grasp_affordances_install_') as scratch:
        # catkin installs its setup files to the configured prefix whatever `--prefix` says: only DESTDIR moves all.
        root = os.path.join(scratch, 'root')
        run([arguments.cmake, '--install', arguments.build], env=dict(os.environ, DESTDIR=root),
            stdout=subprocess.DEVNULL)
        prefix = root + arguments.prefix
        build_consumer(arguments.cmake, arguments.devel, os.path.join(scratch, 'devel_consumer'))
        build_consumer(arguments.cmake, prefix, os.path.join(scratch, 'installed_consumer'))
        check_libraries(prefix)
        if has_tools(prefix):
            check_path(prefix, scratch)
            check_path(arguments.devel, scratch)
        # rosrun looks into no folder `build` of a package, and finds nothing in a devel space that is there.
        shell = SourcedShell(prefix, scratch)
        assert not has_tools(prefix) or shell.answer('rosrun grasp_affordances localize --version').startswith('localize ')
        check_launch_files(prefix)
        check_launch(prefix, arguments.devel, scratch)


if __name__ == '__main__':
    main()
