"""Virtual OpenNI2 devices for the rostests: their list, programs that find them, and what those say of them."""

import glob
import os
import shutil
import subprocess
import tempfile
import xml.etree.ElementTree

import numpy
import roslib.packages
import rospy
import yaml
from diagnostic_msgs.msg import DiagnosticArray

from helpers import Launch, Listener, Process, executable


def openni2_is_built():
    """Whether the build has the driver: it is left out where OpenNI2 is not found."""
    return bool(roslib.packages.find_node('grasp_affordances', 'xtion_node'))


def depth_image_proc_loads():
    """Debian 11 installs its library where pluginlib does not look for it, as scripts/demo has it."""
    plugins = subprocess.run(['rospack', 'plugins', '--attrib=plugin', 'nodelet'], check=True, stdout=subprocess.PIPE,
                             universal_newlines=True).stdout
    file = dict(line.split(' ', 1) for line in plugins.splitlines())['depth_image_proc']
    library = xml.etree.ElementTree.parse(file).getroot().get('path')
    prefix = file.split('/share/')[0]
    places = (prefix + '/lib/', '/usr/lib/*/ros/')
    return '/' not in library or any(glob.glob(place + os.path.basename(library) + '.so') for place in places)


def openni2_path():
    return os.path.join(os.path.dirname(executable('grasp_affordances', 'xtion_node')), 'openni2')


class VirtualDevices:
    """The devices that programs with this environment find. Leaving the block removes its folder."""

    def __init__(self, *devices):
        self.folder = tempfile.mkdtemp(prefix='grasp_affordances_devices_')
        self._list = os.path.join(self.folder, 'devices.yaml')
        self.write(*devices)
        libraries = [openni2_path()] + os.environ.get('LD_LIBRARY_PATH', '').split(':')
        self.environment = dict(os.environ, LD_LIBRARY_PATH=':'.join(libraries),
                                GRASP_AFFORDANCES_VIRTUAL_DEVICES=self._list)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder)

    def write(self, *devices):
        with open(self._list + '.new', 'w') as file:
            yaml.safe_dump(list(devices), file)
        os.rename(self._list + '.new', self._list)

    def driver(self, name, *parameters, environment=None):
        """A driver in a process of its own, its topics in the namespace of that name and its frames named after it."""
        return Process('grasp_affordances', 'xtion_node', '__ns:=' + name, '__name:=driver', '_camera:=' + name,
                       *parameters, environment=environment or self.environment)

    def launch(self, file, *arguments):
        return Launch(file, *arguments, environment=self.environment)

    def record(self, file, frames):
        """Records that many depth frames of the first device; returns the path."""
        path = os.path.join(self.folder, file)
        subprocess.run([executable('grasp_affordances', 'record_oni'), path, str(frames)], env=self.environment,
                       check=True, timeout=30)
        return path


def device(uri='virtual/1', **settings):
    """An entry of the list."""
    return dict({'uri': uri, 'scene': 'table', 'seed': 1, 'frames': 3}, **settings)


class Diagnostics:
    """What the driver of a name says of its device."""

    def __init__(self, name):
        self._name = '%s/driver: device' % name
        self._listener = Listener('/diagnostics', DiagnosticArray)

    def close(self):
        self._listener.close()

    def _statuses(self, since):
        for message in self._listener.messages():
            for status in message.status:
                if status.name == self._name and message.header.stamp >= since:
                    yield message.header.stamp, status

    def wait(self, state, since=rospy.Time(), accept=lambda status: True, timeout=20):
        """Stamp and status of the first message of that state (and otherwise accepted) after a time."""
        def found(_):
            return any(value(status, 'state') == state and accept(status) for _, status in self._statuses(since))
        self._listener.wait(found, timeout)
        return next((stamp, status) for stamp, status in self._statuses(since)
                    if value(status, 'state') == state and accept(status))


def value(status, key):
    """None where there is none."""
    return next((pair.value for pair in status.values if pair.key == key), None)


def pixels(image):
    """A depth image as an array."""
    return numpy.frombuffer(image.data, numpy.uint16).reshape(image.height, image.width)
