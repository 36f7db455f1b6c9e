#!/usr/bin/python3
"""Nodelets that are loaded and unloaded again and again while clouds flow, and what becomes of manager, loader and
nodelet when one of them is killed. ~cycles: how often the localizer is loaded; ~other_cycles: the other nodelets;
~turns: how often a client goes from one localizer to another one."""

import collections
import os
import signal
import socket
import time
import unittest

import rosgraph
import rospy
import rostest
from bond.msg import Status
from sensor_msgs.msg import Image, PointCloud2

from grasp_affordances.msg import LocalizationStatistics
from helpers import (ABNORMAL_ENDS, FREED_MEMORY_IS_KEPT, Listener, Nodelets, Process, manager, publisher, scene, usage,
                     wait_until)
from raw_peers import RawSubscriber
from virtual_devices import VirtualDevices, device, openni2_is_built

WARM_UP = 4        # cycles: what pluginlib and TBB keep for good
MASTER_THREADS = 3
MEMORY = 3         # MB: less than one cloud
BOND_TIMEOUT = 4   # s, bond's
SLACK = 5          # s, of a busy machine


def tidy_heap(environment=os.environ):
    """In which the allocator keeps next to no memory that was freed: no heap for each thread that there once was at a
    time, and a mapping of its own for every block of a page or more, so that a small block that lives on at the end of
    the heap keeps little of what lies before it."""
    return dict(environment, MALLOC_ARENA_MAX='1', MALLOC_MMAP_THRESHOLD_='4096', MALLOC_TRIM_THRESHOLD_='4096')


def usage_at_rest(process):
    """The least within a second. roscpp lets go of connections, and of what it has read of a cloud, some time after the
    nodelet is gone."""
    least = usage(process)
    for _ in range(20):
        time.sleep(0.05)
        least = least._make(map(min, least, usage(process)))
    return least


def loader():
    return Process('nodelet', 'nodelet', 'load', 'grasp_affordances/LocalizerNodelet', 'manager', '__name:=localizer')


def advertised():
    return 'localizer/statistics' in str(rospy.get_published_topics())


class Reload(unittest.TestCase):
    def tearDown(self):
        for name in ('localizer', 'other_localizer', 'multi_camera', 'simulated', 'camera'):
            if rospy.has_param(name):
                rospy.delete_param(name)

    def check_clean_end(self, process):
        start = time.monotonic()
        self.assertEqual(process.interrupt(), 0, process.output())
        self.assertLess(time.monotonic() - start, 2 + SLACK)
        for sign in ABNORMAL_ENDS:
            self.assertNotIn(sign, process.output())

    def check_cycles(self, host, name, kind, output, output_type, remappings=()):
        """Loads a nodelet so often, each time until it has published something new, and unloads it. Of memory, threads
        and open files nothing is lost."""
        cycles = rospy.get_param('~cycles' if kind == 'LocalizerNodelet' else '~other_cycles')
        nodelets = Nodelets()
        uri = rosgraph.Master(rospy.get_name()).lookupNode('/manager')
        longest = 0.0
        for cycle in range(cycles):
            if cycle == WARM_UP:
                before = usage_at_rest(host)
            if cycle % 20 == 0:
                rospy.loginfo('%s, cycle %d: %s', kind, cycle, usage(host))
            nodelets.load(name, kind, remappings)
            with RawSubscriber(uri, output) as subscriber:  # rospy's own is slower than a nodelet may come and go
                try:
                    subscriber.message(output_type)
                except socket.timeout:
                    self.fail('nothing on %s in cycle %d: %s' % (output, cycle, host.output()))
            start = time.monotonic()
            nodelets.unload(name)
            longest = max(longest, time.monotonic() - start)
        self.assertLess(longest, 2 + SLACK)
        self.assertNotIn('already advertised', host.output(), 'a nodelet began before the one before it had ended')
        # Connections end when their other ends are told. The master may keep some, to tell of publishers.
        wait_until(lambda: usage(host).files <= before.files + MASTER_THREADS and
                   usage(host).threads <= before.threads,
                   'end of threads and connections: %s, now %s' % (before, usage(host)))
        after = usage_at_rest(host)
        rospy.loginfo('%s, %d cycles: %s, then %s; the longest unloading took %.3f s', kind, cycles, before, after,
                      longest)
        if not FREED_MEMORY_IS_KEPT:
            self.assertLess(after.memory - before.memory, MEMORY)

    def test_localizer(self):
        with publisher(scene('table'), rate=30), manager(tidy_heap()) as host:
            rospy.set_param('localizer', {'lazy': False})
            self.check_cycles(host, '/localizer', 'LocalizerNodelet', '/localizer/statistics',
                              LocalizationStatistics)
            self.check_clean_end(host)

    def test_several_cameras(self):
        with publisher(scene('table'), rate=30), manager(tidy_heap()) as host:
            rospy.set_param('multi_camera', {'target_frame': 'camera_depth_optical_frame', 'sync_slop': 1.0})
            self.check_cycles(host, '/multi_camera', 'MultiCameraNodelet', '/multi_camera/statistics',
                              LocalizationStatistics, (('/points_1', '/points'), ('/points_2', '/points')))
            self.check_clean_end(host)

    def test_simulated_camera(self):
        with manager(tidy_heap()) as host:
            self.check_cycles(host, '/simulated/camera', 'SimulatedCameraNodelet',
                              '/simulated/depth/points', PointCloud2)
            self.check_clean_end(host)

    @unittest.skipUnless(openni2_is_built(), 'this build has no OpenNI2')
    def test_driver(self):
        with VirtualDevices(device()) as devices, manager(tidy_heap(devices.environment)) as host:
            self.check_cycles(host, '/camera/driver', 'XtionNodelet', '/camera/depth/image_raw',
                              Image)
            self.check_clean_end(host)

    def test_localizers_that_take_turns(self):
        """Lazy ones in one manager: as a client goes from one to the other, one lets go of the topic that the other one
        takes up."""
        with publisher(scene('table'), rate=30), manager() as host:
            nodelets = Nodelets()
            for name in ('/localizer', '/other_localizer'):
                rospy.set_param(name, {'sampling': {'samples': 100}})
                nodelets.load(name, 'LocalizerNodelet')
            uri = rosgraph.Master(rospy.get_name()).lookupNode('/manager')
            last = RawSubscriber(uri, '/localizer/statistics')
            for turn in range(rospy.get_param('~turns')):
                last.close()
                last = RawSubscriber(uri, '/%s/statistics' % ('other_localizer', 'localizer')[turn % 2])
                try:
                    last.message(LocalizationStatistics)
                except socket.timeout:
                    self.fail('nothing in turn %d: %s' % (turn, host.output()))
            last.close()
            self.check_clean_end(host)

    def check_answers(self):
        listener = Listener('localizer/statistics', LocalizationStatistics)
        listener.wait()
        listener.close()

    def wait_for_bond(self):
        """Until both ends of the bond have heard each other: each has said something, a second apart, after the other
        had. Before that an end that loses the other one waits for it for ever: a trap of nodelet's."""
        statuses = Listener('manager/bond', Status)

        def formed():
            said = collections.Counter(status.instance_id for status in statuses.messages() if status.active)
            return len(said) == 2 and min(said.values()) >= 3
        wait_until(formed, 'bond')
        statuses.close()

    def test_manager_is_killed_and_the_loader_ends(self):
        with publisher(scene('table'), rate=10), manager() as host, loader() as load:
            self.check_answers()
            self.wait_for_bond()
            host.signal(signal.SIGKILL)
            self.assertEqual(load.wait(BOND_TIMEOUT + SLACK), 0, load.output())

    def test_loader_is_killed_and_the_manager_unloads_its_nodelet_and_lives_on(self):
        with publisher(scene('table'), rate=10), manager() as host:
            with loader() as load:
                self.check_answers()
                self.wait_for_bond()
                load.signal(signal.SIGKILL)
                wait_until(lambda: not advertised(), 'unloading', BOND_TIMEOUT + SLACK)
            with loader() as load:
                self.check_answers()
                self.assertEqual(load.interrupt(), 0, load.output())
            self.check_clean_end(host)


if __name__ == '__main__':
    rospy.init_node('reload_test')
    rostest.rosrun('grasp_affordances', 'reload', Reload)
