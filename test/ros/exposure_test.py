#!/usr/bin/python3
"""Whatever the graph sends to the nodes, they read and write no file of the sender's choice."""

import ctypes
import glob
import os
import shutil
import struct
import tempfile
import unittest

import rosgraph
import roslib.message
import rospy
import rosservice
import rostest

from grasp_affordances.msg import LocalizationStatistics
from helpers import Listener, Process, cloud, wait_until
from virtual_devices import VirtualDevices, device

OF_ROS = ('/clock', '/rosout')  # topics

# Every roscpp node has them. With Debian's log4cxx the node may crash when it is asked a second time.
OF_ROSCPP = {'get_loggers', 'set_logger_level'}
SERVICES = {
    '/localizer': {'localize', 'trigger', 'select', 'best', 'reconfigure/set_parameters'},
    '/cameras': {'trigger', 'select', 'best', 'reconfigure/set_parameters'},
    '/alone/driver': {'../depth/set_camera_info', '../rgb/set_camera_info'}}


class Watch:
    """What happens to a folder and the files in it, as the kernel tells it."""

    EVENT = struct.Struct('iIII')
    ACCESS, MODIFY, OPEN, CREATE, DELETE = 0x1, 0x2, 0x20, 0x100, 0x200

    def __init__(self, folder):
        libc = ctypes.CDLL(None, use_errno=True)
        self._file = libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        mask = self.ACCESS | self.MODIFY | self.OPEN | self.CREATE | self.DELETE
        if self._file < 0 or libc.inotify_add_watch(self._file, folder.encode(), mask) < 0:
            raise OSError(ctypes.get_errno(), 'inotify')

    def close(self):
        os.close(self._file)

    def events(self):
        """Names of the files since the last call."""
        try:
            data = os.read(self._file, 1 << 16)
        except BlockingIOError:
            return []
        names, begin = [], 0
        while begin < len(data):
            length = self.EVENT.unpack_from(data, begin)[3]
            begin += self.EVENT.size
            names.append(data[begin:begin + length].rstrip(b'\0').decode())
            begin += length
        return names


def fill(message, text):
    """A message whose texts are all that one, with one entry in each list of texts or messages."""
    for name, kind in zip(message.__slots__, message._slot_types):
        base, is_list = kind.split('[')[0], kind.endswith(']')
        if base == 'string':
            setattr(message, name, [text] if is_list else text)
        elif base == 'Header' or '/' in base:
            part = fill(roslib.message.get_message_class('std_msgs/Header' if base == 'Header' else base)(), text)
            setattr(message, name, [part] if is_list else part)
        elif name == 'timeout':
            setattr(message, name, 0.05)
    return message


def services_of(node):
    return {name for name, nodes in rosgraph.Master(rospy.get_name()).getSystemState()[2] if node in nodes}


def subscriptions_of(node):
    """Topics and their types."""
    master = rosgraph.Master(rospy.get_name())
    types = dict(master.getTopicTypes())
    return {name: types[name] for name, nodes in master.getSystemState()[1] if node in nodes and name in types}


class Exposure(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix='grasp_affordances_exposure_')
        self.home = os.path.join(self.folder, 'home')
        self.bait = os.path.join(self.folder, 'bait')
        os.mkdir(self.home)
        os.mkdir(self.bait)
        for name in ('there.yaml', 'there.ini', 'there.pcd', 'there.oni', 'there.so'):
            with open(os.path.join(self.bait, name), 'w') as file:
                file.write('{}\n')
        there, new = os.path.join(self.bait, 'there'), os.path.join(self.bait, 'new')
        self.texts = [there + '.yaml', 'file://' + there + '.yaml', 'file://' + new + '.yaml', there + '.pcd',
                      there + '.oni', there + '.so', new + '/x.ini', 'package://grasp_affordances/../new.yaml',
                      '$(touch %s)' % new, '`touch %s`' % new, '; touch %s;' % new, '../' * 20 + new[1:] + '.yaml']
        self.environment = dict(os.environ, HOME=self.home, ROS_HOME=self.home)
        self.watch = Watch(self.bait)

    def tearDown(self):
        self.watch.close()
        shutil.rmtree(self.folder)

    def call_all(self, node):
        """Calls every service of a node with every text. A new service belongs into docs/security.md, too."""
        expected = {os.path.normpath(os.path.join(node, name)) for name in SERVICES[node]}
        of_roscpp = {os.path.join(node, name) for name in OF_ROSCPP}
        wait_until(lambda: expected | of_roscpp <= services_of(node), 'services of ' + node)
        self.assertEqual(services_of(node), expected | of_roscpp)
        for name in sorted(expected):
            service_class = rosservice.get_service_class_by_name(name)
            proxy = rospy.ServiceProxy(name, service_class)
            for text in self.texts:
                try:
                    proxy(fill(service_class._request_class(), text))
                except rospy.ServiceException:
                    pass  # refused

    def send_to_all(self, node):
        """Sends every text on every topic that a node subscribes to, and a cloud, which it answers."""
        points = rospy.resolve_name('points')
        answers = Listener(node + '/statistics', LocalizationStatistics)
        wait_until(lambda: points in subscriptions_of(node), 'subscription')
        publishers = {topic: rospy.Publisher(topic, roslib.message.get_message_class(kind), queue_size=10)
                      for topic, kind in subscriptions_of(node).items() if topic not in OF_ROS}
        wait_until(lambda: all(p.get_num_connections() > 0 for p in publishers.values()), 'connections')
        for text in self.texts:
            for topic, one in publishers.items():
                one.publish(cloud(frame=text) if topic == points else fill(one.data_class(), text))
            answers.wait(lambda answer: answer.header.frame_id == text.lstrip('/'))
        answers.close()
        for one in publishers.values():
            one.unregister()

    def written(self):
        """Files in the home folder, without those of ROS."""
        names = {os.path.relpath(os.path.join(folder, name), self.home)
                 for folder, _, names in os.walk(self.home) for name in names}
        return {name for name in names if not name.startswith(('log/', 'rospack_cache'))}

    def untouched(self):
        self.assertEqual(self.watch.events(), [])
        self.assertFalse(glob.glob(os.path.join(self.bait, 'new*')))

    def test_watch_sees_what_happens(self):
        with open(os.path.join(self.bait, 'there.yaml')) as file:
            file.read()
        self.assertIn('there.yaml', self.watch.events())
        open(os.path.join(self.bait, 'new'), 'w').close()
        self.assertIn('new', self.watch.events())

    def test_localizer(self):
        with Process('grasp_affordances', 'localizer_node', '__name:=localizer', environment=self.environment):
            self.call_all('/localizer')
            self.send_to_all('/localizer')
            self.untouched()

    def test_localizer_of_several_cameras(self):
        with Process('grasp_affordances', 'multi_camera_node', '__name:=cameras', '_target_frame:=map',
                     environment=self.environment):
            self.call_all('/cameras')
            self.untouched()

    def test_driver_writes_calibrations_where_it_was_started_to(self):
        """set_camera_info keeps a calibration. Where, nobody who calls it has a say in."""
        if rospy.has_param('alone'):
            rospy.delete_param('alone')
        with VirtualDevices(device(frames=1)) as devices:
            devices.environment.update(HOME=self.home, ROS_HOME=self.home)
            with devices.driver('alone', '_color_mode:=off'):
                self.call_all('/alone/driver')
                self.untouched()
        written = self.written()
        self.assertTrue(written)
        for name in written:
            self.assertRegex(name, r'^camera_info/(depth|rgb)\w*\.yaml$')

    def test_driver_writes_calibrations_into_the_files_that_it_was_started_with(self):
        urls = ['_%s_camera_info_url:=file://%s' % (name, os.path.join(self.home, 'mine', name + '.yaml'))
                for name in ('depth', 'rgb')]
        with VirtualDevices(device(frames=1)) as devices:
            devices.environment.update(HOME=self.home, ROS_HOME=self.home)
            with devices.driver('alone', '_color_mode:=off', *urls):
                self.call_all('/alone/driver')
                self.untouched()
        self.assertEqual(self.written(), {'mine/depth.yaml', 'mine/rgb.yaml'})


if __name__ == '__main__':
    rospy.init_node('exposure_test')
    rostest.rosrun('grasp_affordances', 'exposure', Exposure)
