#!/usr/bin/python3
"""Several cameras, localized in together: where shells are, and what is said of a silent or misplaced camera."""

import copy
import json
import math
import os
import struct
import subprocess
import tempfile
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from sensor_msgs.msg import PointCloud2
from tf2_msgs.msg import TFMessage

from grasp_affordances.msg import CylindricalShellArray, LocalizationStatistics
from grasp_affordances.srv import LocalizeNext
from helpers import (ABNORMAL_ENDS, TIME_FACTOR, Launch, Listener, Process, executable, measured, publisher,
                     wait_until, write_scene)

TURNS = (0, 60, -60)  # degrees, of the cameras about the table
POINTS = 640 * 480


class MultiCamera(Process):
    """The node, and what it publishes."""

    def __init__(self, views, *parameters):
        if rospy.has_param('multi_camera'):
            rospy.delete_param('multi_camera')
        super().__init__('grasp_affordances', 'multi_camera_node', '_views:=%d' % views, *parameters)
        self.shells = Listener('multi_camera/shells', CylindricalShellArray)
        self.statistics = Listener('multi_camera/statistics', LocalizationStatistics)

    def __exit__(self, *arguments):
        self.shells.close()
        self.statistics.close()
        super().__exit__(*arguments)


class Multiview(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix='grasp_affordances_views_')
        cls.files = [os.path.join(cls.folder.name, '%d.pcd' % turn) for turn in TURNS]
        cls.clouds = []
        for number, (file, turn) in enumerate(zip(cls.files, TURNS), 1):
            write_scene('table', file, turn=turn, noise_seed=1000 * number)
            with publisher(file, frame='camera_%d' % number):
                listener = Listener('points', PointCloud2)
                cls.clouds.append(listener.wait())
                listener.close()
        cls.publishers = [rospy.Publisher('points_%d' % number, PointCloud2, queue_size=3) for number in (1, 2, 3)]
        cls.fixed = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        cls.poses = [cls.pose(number, view) for number, view in enumerate(cls.localize(*cls.files)['views'], 1)]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @staticmethod
    def localize(*files):
        """What the command line finds in several views."""
        views = [argument for file in files for argument in ('--view', file)]
        return json.loads(subprocess.run([executable('grasp_affordances', 'localize'), '--json', *views], check=True,
                                         stdout=subprocess.PIPE, timeout=60).stdout)

    @staticmethod
    def pose(number, view):
        result = TransformStamped(child_frame_id='camera_%d' % number)
        result.header.frame_id = 'room'
        result.transform.translation = Vector3(*view['translation'])
        result.transform.rotation = Quaternion(*view['rotation'])
        return result

    def setUp(self):
        wait_until(lambda: not any(p.get_num_connections() for p in (*self.publishers, self.fixed)), 'disconnection')
        self.fixed.publish(self.poses)

    def connect(self, views):
        wait_until(lambda: all(p.get_num_connections() == 1 for p in self.publishers[:views]) and
                   self.fixed.get_num_connections() == 1, 'connections')

    def publish(self, views, stamp, offsets=(0.0, 0.004, 0.002)):
        """One cloud of each of these cameras; returns the stamp of the newest."""
        stamps = []
        for view in views:
            cloud = copy.copy(self.clouds[view])
            cloud.header = copy.copy(cloud.header)
            cloud.header.stamp = stamp + rospy.Duration(offsets[view])
            stamps.append(cloud.header.stamp)
            self.publishers[view].publish(cloud)
        return max(stamps)

    def check_against_command_line(self, views):
        with MultiCamera(views, '_target_frame:=room') as node:
            self.connect(views)
            stamp = self.publish(range(views), rospy.Time.now())
            message = node.shells.wait(lambda m: m.header.stamp == stamp)
            statistics = node.statistics.wait(lambda m: m.header.stamp == stamp)
        self.assertEqual(message.header.frame_id, 'room')
        self.assertEqual(statistics.header.frame_id, 'room')
        expected = self.localize(*self.files[:views])
        # Importance sampling may draw a point twice; its shells then differ, as they have curvatures of their own.
        by_point = {}
        for shell in expected['shells']:
            by_point.setdefault(shell['point_index'], []).append(shell)
        self.assertGreater(len(by_point), 100)
        # Poses took another way: the last bits differ, and with them, rarely, where a sample ends.
        shared = [shell for shell in message.shells if shell.point_index in by_point]
        self.assertGreater(len(shared), 0.95 * max(len(expected['shells']), len(message.shells)))
        for shell in shared:
            c = shell.centroid
            same = min(by_point[shell.point_index], key=lambda other: math.dist((c.x, c.y, c.z), other['centroid']))
            self.assertLess(math.dist((c.x, c.y, c.z), same['centroid']), 0.002)
            self.assertAlmostEqual(shell.inner_radius, same['inner_radius'], delta=0.0021)
        self.assertEqual({shell.point_index // POINTS for shell in message.shells}, set(range(views)))
        self.assertEqual(statistics.points, expected['points'])
        self.assertAlmostEqual(statistics.view_disagreement, expected['view_disagreement'], delta=1e-4)
        self.assertLess(statistics.view_disagreement, 0.01)

    def test_two_cameras(self):
        self.check_against_command_line(2)

    def test_three_cameras(self):
        self.check_against_command_line(3)

    def test_wrong_extrinsics_are_reported(self):
        poses = copy.deepcopy(self.poses)
        poses[1].transform.translation.z += 0.03
        self.fixed.publish(poses)
        with MultiCamera(2, '_target_frame:=room') as node:
            self.connect(2)
            stamp = self.publish(range(2), rospy.Time.now())
            statistics = node.statistics.wait(lambda m: m.header.stamp == stamp)
            self.assertGreater(statistics.view_disagreement, 0.015)
            self.assertTrue(any('view' in warning for warning in statistics.warnings), statistics.warnings)
            wait_until(lambda: statistics.warnings[0] in node.output(), 'complaint')

    def test_clouds_of_different_moments_are_not_put_together_and_time_may_start_again(self):
        with MultiCamera(2, '_target_frame:=room', '_sync_slop:=0.03') as node:
            self.connect(2)
            start = rospy.Time.now()
            late = (0.0, 0.04)
            for i in range(3):
                self.publish(range(2), start + rospy.Duration(i), late)
            wait_until(lambda: 'more than sync_slop' in node.output(), 'complaint')
            self.assertEqual(node.statistics.messages(), [])
            stamp = self.publish(range(2), start - rospy.Duration(100))
            self.assertEqual(node.statistics.wait().header.stamp, stamp)

    def test_stamps_at_the_end_of_time(self):
        with MultiCamera(2, '_target_frame:=room') as node:
            self.connect(2)
            self.publish((0,), rospy.Time.now())
            for seconds in (2 ** 32 - 1, 2 ** 31, 0):
                self.publish((1,), rospy.Time(seconds))
            self.publish((1,), rospy.Time.now())
            # Some may be forgotten for what arrives late of those before.
            for _ in range(20):
                self.publish(range(2), rospy.Time.now())
                time.sleep(0.3 * TIME_FACTOR)
                if node.statistics.messages():
                    break
            node.statistics.wait()
            self.assertEqual(node.interrupt(), 0, node.output())

    def test_stamps_that_stand_still(self):
        with MultiCamera(2, '_target_frame:=room', '_sampling/samples:=100', '_sync_slop:=0.1') as node:
            self.connect(2)
            stamp = rospy.Time.now()
            end = time.monotonic() + 20 * TIME_FACTOR
            while len(node.statistics.messages()) < 6 and time.monotonic() < end:
                self.publish(range(2), stamp, (0.0, 5.0))
                time.sleep(0.3)
            self.assertGreaterEqual(len(node.statistics.messages()), 6)

    def test_two_cameras_of_one_frame_are_named(self):
        with MultiCamera(2, '_target_frame:=room') as node:
            self.connect(2)
            stamp = rospy.Time.now()
            for cloud, points in zip(self.clouds, self.publishers[:2]):
                cloud = copy.copy(cloud)
                cloud.header = copy.copy(cloud.header)
                cloud.header.stamp, cloud.header.frame_id = stamp, 'camera_1'
                data = bytearray(cloud.data)
                struct.pack_into('<fff', data, 0, 0.0, 0.0, -1.0)  # one bad point: still in its frame
                cloud.data = bytes(data)
                points.publish(cloud)
            wait_until(lambda: "/points_1 and /points_2 both have the frame 'camera_1'" in node.output(), 'complaint')

    def test_a_silent_camera_is_named(self):
        with MultiCamera(3, '_target_frame:=room') as node:
            self.connect(3)
            self.publish((0, 2), rospy.Time.now())
            wait_until(lambda: 'no clouds arrive on ' in node.output(), 'complaint')
            self.assertRegex(node.output(), r'no clouds arrive on /points_2, none came in 5 s [^,]*$')
            self.assertEqual(node.statistics.messages(), [])
            # Each time, also where the others go on.
            for _ in range(3):
                time.sleep(1)
                self.publish((0, 2), rospy.Time.now())
            wait_until(lambda: 'no clouds arrive on /points_2, none came in 10 s' in node.output(), 'complaint')
            self.assertNotIn('no clouds arrive on /points_1', node.output())

    def test_a_set_without_its_transforms_is_dropped_and_counted(self):
        with MultiCamera(2, '_target_frame:=nowhere', '_transform_timeout:=0.05') as node:
            self.connect(2)
            self.publish(range(2), rospy.Time.now())
            wait_until(lambda: 'want of a transform' in node.output(), 'complaint')
            self.assertIn('nowhere', node.output())
            room = TransformStamped(child_frame_id='room')
            room.header.frame_id = 'nowhere'
            room.transform.rotation.w = 1
            self.fixed.publish(self.poses + [room])
            time.sleep(0.5)  # until it has arrived: nothing tells
            stamp = self.publish(range(2), rospy.Time.now())
            statistics = node.statistics.wait(lambda m: m.header.stamp == stamp)
            self.assertEqual((statistics.clouds_received, statistics.clouds_processed,
                              statistics.clouds_without_transform), (2, 1, 1))
            self.assertEqual(node.interrupt(), 0)
            for sign in ABNORMAL_ENDS:
                self.assertNotIn(sign, node.output())

    def trigger(self, timeout):
        """A call that waits for a set of clouds, in another thread; returns how to get its answer."""
        rospy.wait_for_service('multi_camera/trigger', 20)
        answers = []
        thread = threading.Thread(target=lambda: answers.append(
            rospy.ServiceProxy('multi_camera/trigger', LocalizeNext)(timeout=timeout)), daemon=True)
        thread.start()

        def answer():
            thread.join(20)
            return answers[0]
        return answer

    def test_trigger_on_demand(self):
        with MultiCamera(2, '_target_frame:=room', '_on_demand:=true', '_sampling/samples:=1000') as node:
            silent = self.trigger(timeout=0.3)()
            self.assertFalse(silent.success)
            self.assertIn('no set of clouds arrived within 0.3 s', silent.message)
            # Though somebody listens, it subscribes only while it is asked.
            wait_until(lambda: not any(p.get_num_connections() for p in self.publishers), 'end of the subscription')
            for processed in (1, 2):
                answer = self.trigger(timeout=20)
                self.connect(2)
                stamp = self.publish(range(2), rospy.Time.now())
                found = answer()
                self.assertTrue(found.success, found.message)
                self.assertEqual(found.statistics.header.stamp, stamp)
                self.assertEqual(found.statistics.clouds_processed, processed)
                self.assertEqual({shell.point_index // POINTS for shell in found.shells}, {0, 1})
                published = node.shells.wait(lambda m: m.header.stamp == stamp)
                self.assertEqual(len(published.shells), len(found.shells))
                wait_until(lambda: not any(p.get_num_connections() for p in self.publishers), 'end of the subscription')
            self.assertEqual(node.interrupt(), 0, node.output())
            for sign in ABNORMAL_ENDS:
                self.assertNotIn(sign, node.output())

    @measured
    def test_max_rate(self, measurement):
        stopping = threading.Event()
        self.addCleanup(stopping.set)

        def publish():
            while not stopping.wait(0.2):
                self.publish(range(2), rospy.Time.now())

        camera = threading.Thread(target=publish, daemon=True)
        with MultiCamera(2, '_target_frame:=room', '_max_rate:=1', '_sampling/samples:=100') as node:
            self.connect(2)
            camera.start()
            first = node.statistics.wait()
            last = node.statistics.wait(lambda m: m.clouds_processed == first.clouds_processed + 2)
            # On average, whatever one set was late by.
            self.assertGreater((last.header.stamp - first.header.stamp).to_sec(), 2 / 1 - 0.5)
            self.assertGreater(last.clouds_left_out, 2)
            # Who asks does not wait for the rate.
            start = time.monotonic()
            for _ in range(4):
                self.assertTrue(self.trigger(timeout=20)().success)
            with measurement.judged():
                self.assertLess(time.monotonic() - start, 4 / 1 * TIME_FACTOR)
            stopping.set()
            camera.join(20)

    def test_needs_a_target_frame(self):
        with MultiCamera(2) as node:
            self.assertEqual(node.wait(15), 1)
            self.assertIn('~target_frame', node.output())

    def test_simulated_cameras(self):
        with Launch('simulated_cameras.launch', 'frames_ahead:=2', 'rate:=5'):
            shells = Listener('multi_camera/shells', CylindricalShellArray)
            message = shells.wait(lambda m: len({shell.point_index // POINTS for shell in m.shells}) == 2)
            shells.close()
        self.assertEqual(message.header.frame_id, 'world')


if __name__ == '__main__':
    rospy.init_node('multiview_test')
    rostest.rosrun('grasp_affordances', 'multiview', Multiview)
