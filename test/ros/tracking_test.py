#!/usr/bin/python3
"""Handles keep their ids from cloud to cloud: before a moving camera, a still one, several; and they go in time."""

import copy
import math
import os
import shutil
import tempfile
import time
import unittest

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import PoseArray, Quaternion, TransformStamped, Vector3
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import PointCloud2
from tf2_msgs.msg import TFMessage

from grasp_affordances.msg import HandleArray, LocalizationStatistics
from grasp_affordances.srv import BestHandle
from helpers import Launch, Listener, Process, publisher, rotated, wait_until, write_scene

CAMERA = 'by_hand_optical'
PERIOD = 0.1  # s
VARIANTS = 4  # of the table's noise


def vector(message):
    return (message.x, message.y, message.z)


def applied(T, point):
    t, q = T.translation, T.rotation
    return tuple(a + b for a, b in zip(rotated(q, point), (t.x, t.y, t.z)))


def ids(message):
    return [handle.id for handle in message.handles]


def shifted(x, stamp, frame=CAMERA):
    """T_room_camera of a camera that moves along x."""
    result = TransformStamped(child_frame_id=frame)
    result.header.frame_id = 'room'
    result.header.stamp = stamp
    result.transform.translation = Vector3(x, 0, 0)
    result.transform.rotation = Quaternion(0, 0, 0, 1)
    return result


class Node(Process):
    """A localizing node, and what it publishes."""

    OUTPUTS = {'handles': HandleArray, 'hand_poses': PoseArray, 'statistics': LocalizationStatistics}

    def __init__(self, executable_name, *parameters):
        if rospy.has_param('node'):
            rospy.delete_param('node')
        super().__init__('grasp_affordances', executable_name, '__name:=node', *parameters)
        self.listeners = {name: Listener('node/' + name, kind) for name, kind in self.OUTPUTS.items()}

    def __exit__(self, *arguments):
        for listener in self.listeners.values():
            listener.close()
        super().__exit__(*arguments)

    def answer(self, output, stamp):
        return self.listeners[output].wait(lambda m: m.header.stamp == stamp)


class Tracking(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix='grasp_affordances_tracking_')
        cls.table = [cls.cloud('table', noise) for noise in range(VARIANTS)]
        cls.empty = cls.cloud('empty_table', 0)
        cls.points = [rospy.Publisher(name, PointCloud2, queue_size=5) for name in ('points', 'points_1', 'points_2')]
        cls.moving = rospy.Publisher('/tf', TFMessage, queue_size=10)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def cloud(cls, scene, noise):
        """What a still camera sees of a scene; its noise varies."""
        file = os.path.join(cls.folder, '%s_%d.pcd' % (scene, noise))
        write_scene(scene, file, noise_seed=1000 * noise)
        # On a topic of its own: rospy may yet connect a listener that was just closed to a publisher that is new.
        with publisher(file, rate=5, frame=CAMERA, topic='simulated'):
            listener = Listener('simulated', PointCloud2)
            cloud = listener.wait()
            listener.close()
        return cloud

    def setUp(self):
        wait_until(lambda: not any(p.get_num_connections() for p in (*self.points, self.moving)), 'disconnection')
        self.start = rospy.Time.now()

    def connect(self, topics=1, transforms=0):
        publishers = self.points[:1] if topics == 1 else self.points[1:]
        wait_until(lambda: all(p.get_num_connections() == 1 for p in publishers) and
                   self.moving.get_num_connections() == transforms, 'connections')

    def publish(self, cloud, seconds, topic=0, frame=CAMERA):
        """The cloud, so long after the start of the test; returns its stamp."""
        message = copy.copy(cloud)
        message.header = copy.copy(cloud.header)
        message.header.stamp = self.start + rospy.Duration(seconds)
        message.header.frame_id = frame
        self.points[topic].publish(message)
        return message.header.stamp

    def handles(self, node, cloud, seconds, frame=CAMERA):
        """What is known after a cloud; hand poses are those of these handles."""
        stamp = self.publish(cloud, seconds, frame=frame)
        message = node.answer('handles', stamp)
        self.assertEqual(ids(message), sorted(set(ids(message))))
        poses = [hand.pose for handle in message.handles for hand in handle.hand_poses]
        self.assertEqual(node.answer('hand_poses', stamp).poses, poses)
        return message

    def test_ids_stay_while_the_camera_moves(self):
        camera = os.path.join(self.folder, 'camera.yaml')
        with open(camera, 'w') as file:
            file.write('{scene: table, rate: 5, amplitude_deg: 15, period_s: 8}')
        localizer = os.path.join(self.folder, 'localizer.yaml')
        with open(localizer, 'w') as file:
            file.write('{fixed_frame: world, transform_timeout: 5}')
        transforms = tf2_ros.Buffer(rospy.Duration(300))
        self.addCleanup(tf2_ros.TransformListener(transforms).unregister)
        with Launch('simulated_camera.launch', 'motion:=orbit', 'camera_config:=' + camera, 'config:=' + localizer):
            listener = Listener('localizer/handles', HandleArray)
            wait_until(lambda: len(listener.messages()) >= 25, '25 clouds', timeout=60)
            listener.close()
            messages = listener.messages()
            tracks, in_camera = {}, {}
            for message in messages:
                self.assertEqual(message.header.frame_id, 'camera_depth_optical_frame')
                T_world_camera = transforms.lookup_transform('world', message.header.frame_id, message.header.stamp,
                                                             rospy.Duration(5)).transform
                for handle in message.handles:
                    centroid = vector(handle.centroid)
                    tracks.setdefault(handle.id, []).append(applied(T_world_camera, centroid))
                    in_camera.setdefault(handle.id, []).append(centroid)
        # Of what was found in the first cloud at least the mug's handle, the bottle's neck and the bar stay to the end.
        staying = [id for id in ids(messages[0]) if len(tracks[id]) == len(messages)]
        self.assertGreaterEqual(len(staying), 3, 'of %s' % ids(messages[0]))
        for id in staying:
            for place in tracks[id]:
                self.assertLess(math.dist(place, tracks[id][-1]), 0.03)
        # While the camera moved: what is tracked in its own frame would not have stayed.
        self.assertGreater(max(math.dist(a, b) for id in staying for a in in_camera[id] for b in in_camera[id]), 0.06)

    def test_ids_stay_before_a_still_camera(self):
        with Node('localizer_node') as node:
            self.connect()
            first = self.handles(node, self.table[0], 0)
            best = {handle.id for handle in sorted(first.handles, key=lambda h: -h.score)[:3]}
            self.assertEqual(len(best), 3)
            for i in range(1, 20):
                message = self.handles(node, self.table[i % VARIANTS], i * PERIOD)
                self.assertTrue(best <= set(ids(message)), 'cloud %d: %s of %s' % (i, ids(message), best))
            self.assertEqual(message.header.frame_id, CAMERA)
            hits = {handle.id: handle.hits for handle in message.handles}
            self.assertGreaterEqual(min(hits[id] for id in best), 8)

    def test_handles_go_after_their_lifetime(self):
        with Node('localizer_node', '_tracking/lifetime:=0.5') as node:
            self.connect()
            for i in range(4):
                found = self.handles(node, self.table[i % VARIANTS], i * PERIOD)
            seen = {handle.id for handle in found.handles if handle.unseen_for == 0}
            self.assertGreaterEqual(len(seen), 3)
            for i in range(1, 5):
                remembered = self.handles(node, self.empty, (3 + i) * PERIOD)
                self.assertTrue(seen <= set(ids(remembered)))
                for handle in remembered.handles:
                    if handle.id in seen:
                        self.assertAlmostEqual(handle.unseen_for, i * PERIOD, delta=1e-6)
                        self.assertEqual(handle.shells, ())
            self.assertEqual(ids(self.handles(node, self.empty, 3 * PERIOD + 0.51)), [])

    def test_time_that_goes_back_begins_anew(self):
        with Node('localizer_node') as node:
            self.connect()
            for i in range(4):
                before = self.handles(node, self.table[i % VARIANTS], i * PERIOD)
            after = self.handles(node, self.table[0], -100)
            self.assertGreaterEqual(len(after.handles), 3)
            self.assertGreater(min(ids(after)), max(ids(before)))
            for handle in after.handles:
                self.assertEqual((handle.hits, handle.unseen_for), (1, 0))
            self.assertEqual(ids(self.handles(node, self.empty, -98)), [])

    def test_stamps_that_stand_still(self):
        with Node('localizer_node', '_tracking/lifetime:=0.5') as node:
            self.connect()
            messages = node.listeners['handles'].messages
            answered = 0

            def answer(cloud):
                nonlocal answered
                self.publish(cloud, 0)
                answered += 1
                wait_until(lambda: len(messages()) == answered, 'answer')
                return messages()[-1]

            for i in range(4):
                self.assertGreaterEqual(len(answer(self.table[i % VARIANTS]).handles), 3)
            # Then the time of arrival counts: what is not seen for its lifetime goes.
            end = time.monotonic() + 1.5
            while time.monotonic() < end:
                last = answer(self.empty)
                time.sleep(0.05)
            self.assertEqual(ids(last), [])

    def test_handles_age_by_a_simulated_clock(self):
        rospy.set_param('/use_sim_time', True)
        self.addCleanup(rospy.delete_param, '/use_sim_time')
        clock = rospy.Publisher('/clock', Clock, queue_size=1, latch=True)
        self.addCleanup(clock.unregister)
        clock.publish(Clock(rospy.Time(100)))
        best = rospy.ServiceProxy('node/best', BestHandle)
        with Node('localizer_node', '_max_age:=0.5') as node:
            self.connect()
            wait_until(lambda: clock.get_num_connections() == 1, 'clock')
            time.sleep(0.5)  # until it has come: nothing tells
            self.handles(node, self.table[0], 0)
            time.sleep(1)
            answer = best()
            self.assertTrue(answer.success, answer.message)
            self.assertEqual(answer.age, 0)
            clock.publish(Clock(rospy.Time(101)))
            wait_until(lambda: not best().success, 'refusal')
            self.assertAlmostEqual(best().age, 1)

    def test_late_clouds_have_nothing_forgotten(self):
        with Node('localizer_node') as node:
            self.connect()
            first = self.handles(node, self.table[0], 0)
            best = {handle.id for handle in sorted(first.handles, key=lambda h: -h.score)[:3]}
            for i in range(1, 12):
                late = 0.2 if i % 2 else 0
                message = self.handles(node, self.table[i % VARIANTS], i * PERIOD - late)
                self.assertTrue(best <= set(ids(message)), 'cloud %d: %s of %s' % (i, ids(message), best))

    def test_a_slash_before_the_frame_says_nothing(self):
        with Node('localizer_node') as node:
            self.connect()
            first = self.handles(node, self.table[0], 0)
            best = {handle.id for handle in sorted(first.handles, key=lambda h: -h.score)[:3]}
            for i in range(1, 7):
                message = self.handles(node, self.table[i % VARIANTS], i * PERIOD, '/' + CAMERA if i % 2 else CAMERA)
                self.assertTrue(best <= set(ids(message)), 'cloud %d: %s of %s' % (i, ids(message), best))
                self.assertEqual(message.header.frame_id, CAMERA)  # with a slash tf2 would refuse it
            self.assertEqual(node.output().count("'/%s'" % CAMERA), 1)
            self.assertNotIn('another frame', node.output())

    def test_frames_that_alternate_are_named_once(self):
        with Node('localizer_node') as node:
            self.connect()
            seen = set()
            for i in range(4):
                message = self.handles(node, self.table[0], i * PERIOD, 'another' if i % 2 else CAMERA)
                self.assertFalse(seen & set(ids(message)))
                seen |= set(ids(message))
            self.assertEqual(node.output().count("'another' after '%s'" % CAMERA), 1)
            self.assertNotIn("'%s' after" % CAMERA, node.output())

    def test_frames_that_alternate_before_a_fixed_one(self):
        with Node('localizer_node', '_fixed_frame:=room', '_transform_timeout:=5') as node:
            self.connect(transforms=1)
            for i in range(4):
                frame = 'another' if i % 2 else CAMERA
                self.moving.publish([shifted(0, self.start + rospy.Duration(i * PERIOD), frame)])
                message = self.handles(node, self.table[i % VARIANTS], i * PERIOD, frame)
                self.assertEqual(message.header.frame_id, frame)
                if i == 0:
                    first = message
            self.assertGreaterEqual(len(set(ids(first)) & set(ids(message))), 3)
            self.assertNotIn('another frame', node.output())

    def test_handles_are_tracked_in_the_fixed_frame(self):
        # The same cloud from a camera that moves: in the room nothing is where it was.
        with Node('localizer_node', '_fixed_frame:=room', '_transform_timeout:=5') as node:
            self.connect(transforms=1)
            known = set()
            for i in range(3):
                self.moving.publish([shifted(0.5 * i, self.start + rospy.Duration(i * PERIOD))])
                message = self.handles(node, self.table[0], i * PERIOD)
                # In the camera's frame, where they were seen, and those of before where they now are.
                self.assertEqual(message.header.frame_id, CAMERA)
                for handle in message.handles:
                    self.assertEqual(handle.id in known, handle.unseen_for > 0)
                if i == 0:
                    first = {handle.id: vector(handle.centroid) for handle in message.handles}
                    known |= set(ids(message))
                    self.assertGreaterEqual(len(known), 3)
            last = {handle.id: vector(handle.centroid) for handle in message.handles}
            for id, (x, y, z) in first.items():
                self.assertLess(math.dist(last[id], (x - 1.0, y, z)), 1e-6)

    def test_outputs_in_the_target_frame_are_tracked_in_the_fixed_one(self):
        with Node('localizer_node', '_fixed_frame:=' + CAMERA, '_target_frame:=room',
                  '_transform_timeout:=5') as node:
            self.connect(transforms=1)
            for i in range(2):
                self.moving.publish([shifted(0.5 * i, self.start + rospy.Duration(i * PERIOD))])
                message = self.handles(node, self.table[0], i * PERIOD)
                self.assertEqual(message.header.frame_id, 'room')
                places = {handle.id: vector(handle.centroid) for handle in message.handles}
                self.assertGreaterEqual(len(places), 3)
                if i == 0:
                    first = places
            for id, (x, y, z) in first.items():
                # A bent axis is averaged at points along its length: between them a chord leaves the bend by 0.1 mm.
                self.assertLess(math.dist(places[id], (x + 0.5, y, z)), 1e-4)

    def test_a_cloud_without_its_transform_is_dropped(self):
        for parameter in ('fixed_frame', 'approach_frame'):
            with Node('localizer_node', '_%s:=nowhere' % parameter, '_transform_timeout:=0.05') as node:
                self.connect(transforms=1)
                self.publish(self.table[0], 0)
                wait_until(lambda: 'cloud dropped for want of a transform' in node.output(), 'complaint')
                self.assertIn('nowhere', node.output())
                self.assertEqual(node.listeners['handles'].messages(), [])
            self.setUp()

    def test_several_cameras(self):
        with Node('multi_camera_node', '_views:=2', '_target_frame:=room', '_fixed_frame:=' + CAMERA,
                  '_approach_frame:=' + CAMERA, '_transform_timeout:=5') as node:
            self.connect(topics=2, transforms=1)
            for i in range(4):
                self.moving.publish([shifted(0.5 * i, self.start + rospy.Duration(i * PERIOD))])
                time.sleep(0.05)  # cameras give their clouds in turn
                for topic in (1, 2):
                    stamp = self.publish(self.table[(i + topic) % VARIANTS], i * PERIOD, topic)
                message = node.answer('handles', stamp)
                if i == 0:
                    first = message
            self.assertGreaterEqual(len(set(ids(first)) & set(ids(message))), 3)
            self.assertEqual(message.header.frame_id, 'room')


if __name__ == '__main__':
    rospy.init_node('tracking_test')
    rostest.rosrun('grasp_affordances', 'tracking', Tracking)
