#!/usr/bin/python3
"""A workspace in another frame, outputs in another frame, and transforms that are late, missing or of an earlier run."""

import contextlib
import copy
import math
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import PointCloud2
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from grasp_affordances.msg import CylindricalShellArray, LocalizationStatistics
from helpers import (TIME_FACTOR, Listener, Process, coordinates, moved_points, processor_time, published, rotated,
                     serialized, wait_until)

CAMERA = 'camera_optical'
OUTPUTS = {'shells': CylindricalShellArray, 'markers': MarkerArray, 'statistics': LocalizationStatistics}
STATIC = rospy.Time()


def transform(parent, child, translation, rotation=(0, 0, 0, 1), stamp=STATIC):
    """T_parent_child; the rotation is a quaternion, w last."""
    result = TransformStamped(child_frame_id=child)
    result.header.frame_id = parent
    result.header.stamp = stamp
    result.transform.translation = Vector3(*translation)
    result.transform.rotation = Quaternion(*rotation)
    return result


def applied(T, point):
    t, q = T.transform.translation, T.transform.rotation
    return tuple(a + b for a, b in zip(rotated(q, point), (t.x, t.y, t.z)))


def vector(message):
    return (message.x, message.y, message.z)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def along_largest_component(v):
    return v if max(v, key=abs) > 0 else tuple(-x for x in v)


# Some turn about a slanted axis.
TURNED = tuple(x / math.sqrt(0.3 ** 2 + 0.5 ** 2 + 0.1 ** 2 + 0.8 ** 2) for x in (0.3, -0.5, 0.1, 0.8))
T_ROOM_CAMERA = transform('room', CAMERA, (0.4, -0.2, 1.1), TURNED)


class Localizer(Process):
    """A localizer, and what it publishes."""

    def __init__(self, name, *parameters):
        if rospy.has_param(name):
            rospy.delete_param(name)
        super().__init__('grasp_affordances', 'localizer_node', '__name:=' + name, *parameters)
        self._listeners = {output: Listener(name + '/' + output, kind) for output, kind in OUTPUTS.items()}

    def __exit__(self, *arguments):
        for listener in self._listeners.values():
            listener.close()
        super().__exit__(*arguments)

    def answer(self, output, stamp):
        """What it publishes for the cloud of that stamp."""
        return self._listeners[output].wait(lambda m: m.header.stamp == stamp)

    def markers(self, stamp):
        return self._listeners['markers'].wait(lambda m: m.markers[-1].header.stamp == stamp).markers

    def answered(self):
        return bool(self._listeners['statistics'].messages())


class Tf(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = published('table')
        cls.points = rospy.Publisher('points', PointCloud2, queue_size=1)
        cls.moving = rospy.Publisher('/tf', TFMessage, queue_size=10)
        cls.fixed = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        cls.fixed.publish([T_ROOM_CAMERA])

    def setUp(self):
        self.wait_for_disconnection()

    def wait_for_disconnection(self):
        """Of a localizer that has ended: its connections must not be taken for those of the next one."""
        wait_until(lambda: not any(p.get_num_connections() for p in (self.points, self.moving, self.fixed)),
                   'disconnection')

    def connect(self, localizers=1, listeners=1):
        """Until all that wait for clouds and for transforms are connected."""
        wait_until(lambda: self.points.get_num_connections() == localizers and
                   self.moving.get_num_connections() == self.fixed.get_num_connections() == listeners, 'connections')

    def publish(self, stamp=None, frame=CAMERA):
        """The table; returns its stamp."""
        cloud = copy.copy(self.table)
        cloud.header = copy.copy(self.table.header)
        cloud.header.stamp = stamp or rospy.Time.now()
        cloud.header.frame_id = frame
        self.points.publish(cloud)
        return cloud.header.stamp

    def test_outputs_in_the_target_frame(self):
        with Localizer('plain') as plain, Localizer('moved', '_target_frame:=room') as moved:
            self.connect(localizers=2)
            stamp = self.publish(frame='/' + CAMERA)  # as older drivers write it
            expected = plain.answer('shells', stamp).shells
            message = moved.answer('shells', stamp)
            markers = moved.markers(stamp)
            self.assertEqual(moved.answer('statistics', stamp).header.frame_id, 'room')
        self.assertEqual(message.header.frame_id, 'room')
        self.assertEqual({marker.header.frame_id for marker in markers}, {'room'})
        self.assertEqual([m.pose for m in markers if m.ns == 'shells'], [shell.pose for shell in message.shells])

        self.assertGreater(len(expected), 50)
        self.assertEqual(len(message.shells), len(expected))
        q = T_ROOM_CAMERA.transform.rotation
        turned_over = 0
        for shell, original in zip(message.shells, expected):
            self.assertLess(math.dist(vector(shell.centroid), applied(T_ROOM_CAMERA, vector(original.centroid))), 1e-9)
            self.assertLess(math.dist(vector(shell.normal), rotated(q, vector(original.normal))), 1e-9)
            axis = rotated(q, vector(original.axis))
            self.assertLess(math.dist(vector(shell.axis), along_largest_component(axis)), 1e-9)
            turned_over += dot(vector(shell.axis), axis) < 0
            for direction, unit in ((shell.axis, (0, 0, 1)), (shell.normal, (1, 0, 0))):
                self.assertLess(math.dist(rotated(shell.pose.orientation, unit), vector(direction)), 1e-9)
            for name in ('inner_radius', 'length', 'points_inside', 'points_in_gap', 'point_index'):
                self.assertEqual(getattr(shell, name), getattr(original, name))
        self.assertGreater(turned_over, 0)

    def check_poses(self, shells, markers):
        """Shells and markers have valid poses, whatever is known of the sensor."""
        self.assertGreater(len(shells), 50)
        for shell in shells:
            self.assertLess(math.dist(rotated(shell.pose.orientation, (0, 0, 1)), vector(shell.axis)), 1e-9)
        for marker in markers:
            q = marker.pose.orientation
            self.assertAlmostEqual(math.hypot(q.x, q.y, q.z, q.w), 1, delta=1e-9)
            self.assertTrue(all(map(math.isfinite, vector(marker.pose.position))))

    def test_the_sensor_of_a_cloud_in_another_frame(self):
        cloud = moved_points(self.table, lambda point: applied(T_ROOM_CAMERA, point), 'room')
        with Localizer('unknown') as unknown, Localizer('known', '_sensor_frame:=/' + CAMERA) as known:
            self.connect(localizers=2)
            cloud.header.stamp = rospy.Time.now()
            self.points.publish(cloud)
            without, given = (localizer.answer('shells', cloud.header.stamp).shells for localizer in (unknown, known))
            for shells, localizer in ((without, unknown), (given, known)):
                self.check_poses(shells, localizer.markers(cloud.header.stamp))
            told, found = (localizer.answer('statistics', cloud.header.stamp) for localizer in (unknown, known))
            wait_until(lambda: 'the place of the sensor is not known' in unknown.output(), 'warning')
        camera = vector(T_ROOM_CAMERA.transform.translation)
        for shell in given:
            to_camera = [a - b for a, b in zip(camera, vector(shell.centroid))]
            self.assertGreater(dot(vector(shell.normal), to_camera), 0)
        self.assertTrue(all(math.isnan(x) for shell in without for x in vector(shell.normal)))
        self.assertGreater(found.concave, 0)
        self.assertEqual(told.concave, 0)
        self.assertGreater(found.handles, 0)
        self.assertGreaterEqual(told.handles, found.handles)
        self.assertTrue(any('~sensor_frame' in warning for warning in told.warnings), told.warnings)
        self.assertFalse(any('sensor_frame' in warning for warning in found.warnings), found.warnings)

    def test_a_cloud_without_the_transform_of_its_sensor_is_dropped(self):
        with Localizer('localizer', '_sensor_frame:=nowhere', '_transform_timeout:=0.05') as localizer:
            self.connect()
            self.publish()
            wait_until(lambda: 'cloud dropped for want of a transform' in localizer.output(), 'complaint')
            self.assertIn('nowhere', localizer.output())
            self.assertFalse(localizer.answered())

    def test_workspace_in_another_frame(self):
        # Without random draws a sample's shell depends on its point alone.
        estimator = '_estimation/estimator:=pca'
        with Localizer('plain', estimator, '_sampling/samples:=40000') as plain:
            self.connect(listeners=0)
            found = plain.answer('shells', self.publish()).shells
        self.wait_for_disconnection()
        points = coordinates(self.table)
        centre = applied(T_ROOM_CAMERA, points[found[len(found) // 2].point_index])
        lower, upper = ([x + side for x in centre] for side in (-0.06, 0.06))
        box = ['_workspace/%s_%s:=%r' % (end, axis, value) for end, values in (('min', lower), ('max', upper))
               for axis, value in zip('xyz', values)]
        with Localizer('boxed', estimator, '_workspace_frame:=room', *box) as boxed:
            self.connect()
            message = boxed.answer('shells', self.publish())
        self.assertEqual(message.header.frame_id, CAMERA)

        self.assertGreater(len(message.shells), 10)
        for shell in message.shells:
            for a, x, b in zip(lower, applied(T_ROOM_CAMERA, points[shell.point_index]), upper):
                self.assertTrue(a - 1e-6 < x < b + 1e-6)
        everywhere = {shell.point_index: shell for shell in found}
        shared = [shell for shell in message.shells if shell.point_index in everywhere]
        for shell in shared:
            self.assertEqual(serialized(shell), serialized(everywhere[shell.point_index]))
        # Points outside the box count: a part of some of these shells is there.
        self.assertTrue(any(self.reaches_beyond(shell, lower, upper) for shell in shared))

    @staticmethod
    def reaches_beyond(shell, lower, upper):
        ends = ([c + sign * shell.length / 2 * a for c, a in zip(vector(shell.centroid), vector(shell.axis))]
                for sign in (-1, 1))
        return any(not a < x < b for end in ends for a, x, b in zip(lower, applied(T_ROOM_CAMERA, end), upper))

    def test_a_cloud_without_its_transform_is_dropped_and_counted(self):
        with Localizer('localizer', '_target_frame:=map', '_transform_timeout:=0.05') as localizer:
            self.connect()
            self.publish()
            wait_until(lambda: 'cloud dropped for want of a transform' in localizer.output(), 'complaint')
            self.assertIn('map', localizer.output())
            stamp = rospy.Time.now()
            self.moving.publish([transform('map', 'room', (1, 0, 0), stamp=stamp)])
            self.publish(stamp)
            statistics = localizer.answer('statistics', stamp)
        self.assertEqual((statistics.clouds_received, statistics.clouds_processed, statistics.clouds_without_transform),
                         (2, 1, 1))

    def test_a_cloud_waits_for_its_transform(self):
        with Localizer('localizer', '_target_frame:=map', '_transform_timeout:=10') as localizer:
            self.connect()
            stamp = rospy.Time.now()
            self.moving.publish([transform('map', 'room', (0, 0, 0), stamp=stamp - rospy.Duration(0.1))])
            self.publish(stamp)
            time.sleep(0.5)
            self.assertFalse(localizer.answered())
            self.moving.publish([transform('map', 'room', (2, 0, 0), stamp=stamp + rospy.Duration(0.1))])
            statistics = localizer.answer('statistics', stamp)
            shells = localizer.answer('shells', stamp).shells
        self.assertEqual(statistics.clouds_without_transform, 0)
        self.assertGreater(statistics.milliseconds_latency, 400)
        # Halfway between the two.
        in_room = [applied(T_ROOM_CAMERA, coordinates(self.table)[shell.point_index]) for shell in shells[:20]]
        for shell, point in zip(shells, in_room):
            self.assertLess(math.dist(vector(shell.centroid), (point[0] + 1, point[1], point[2])), 0.1)

    def test_a_cloud_has_one_deadline_for_all_its_transforms(self):
        timeout = 2.0
        with Localizer('localizer', '_target_frame:=map', '_fixed_frame:=world', '_transform_timeout:=%g' % timeout,
                       '_sampling/samples:=100') as localizer:
            self.connect()
            stamp = self.publish()
            # The first transform comes within the cloud's time, the second one after it: though less than the timeout
            # after the first.
            time.sleep(0.7 * timeout)
            self.moving.publish([transform('map', 'room', (0, 0, 0), stamp=stamp)])
            time.sleep(0.7 * timeout)
            self.moving.publish([transform('world', 'map', (0, 0, 0), stamp=stamp)])
            wait_until(lambda: 'cloud dropped for want of a transform' in localizer.output() or localizer.answered(),
                       'the end of the cloud')
            self.assertFalse(localizer.answered())
            # All transforms are known now.
            statistics = localizer.answer('statistics', self.publish(stamp))
        self.assertEqual((statistics.clouds_processed, statistics.clouds_without_transform), (1, 1))

    def test_nothing_is_localized_that_cannot_be_published(self):
        with Localizer('localizer', '_fixed_frame:=nowhere', '_transform_timeout:=0.05',
                       '_sampling/samples:=1000000', '_sampling/importance:=false') as localizer:
            self.connect()
            before = processor_time(localizer)
            self.publish()
            wait_until(lambda: 'cloud dropped for want of a transform' in localizer.output(), 'complaint', timeout=60)
            # A million samples take some seconds.
            self.assertLess(processor_time(localizer) - before, 0.5 * TIME_FACTOR)

    def test_transforms_out_of_order(self):
        with Localizer('localizer', '_target_frame:=map') as localizer:
            self.connect()
            stamp = rospy.Time.now()
            for seconds in (0.1, -0.1):
                self.moving.publish([transform('map', 'room', (0, 0, 0), stamp=stamp + rospy.Duration(seconds))])
            time.sleep(0.1)  # until they have arrived: nothing tells
            self.publish(stamp)
            self.assertEqual(localizer.answer('statistics', stamp).clouds_without_transform, 0)

    def test_a_frame_of_two_clocks_that_nobody_asks_for(self):
        with Localizer('localizer', '_target_frame:=map', '_sampling/samples:=100') as localizer:
            self.connect()
            for i in range(10):
                stamp = rospy.Time.now()
                self.moving.publish([transform('map', 'room', (0, 0, 0), stamp=stamp)])
                for ahead in (1.0, 0.0):
                    self.moving.publish([transform('room', 'gripper', (0, 0, 0), stamp=stamp + rospy.Duration(ahead))])
                time.sleep(0.05)  # until they have arrived: nothing tells
                statistics = localizer.answer('statistics', self.publish(stamp))
                self.assertEqual(statistics.clouds_without_transform, 0)

    def test_stamps_at_the_end_of_time(self):
        end, beyond = rospy.Time(2 ** 32 - 1, 999999999), rospy.Time(2 ** 32 - 12)
        beyond.nsecs = 2 ** 32 - 1  # as nothing keeps a sender from writing them
        self.addCleanup(self.fixed.publish, [T_ROOM_CAMERA])
        with Localizer('localizer', '_target_frame:=map', '_transform_timeout:=0.05') as localizer:
            self.connect()
            # Also of a frame that is not known yet, in one message with another one, and as a fixed transform.
            start = rospy.Time.now()
            self.fixed.publish([T_ROOM_CAMERA, transform('room', 'corner', (0, 0, 0), stamp=end)])
            self.moving.publish([transform('map', 'room', (0, 0, 0), stamp=end),
                                 transform('map', 'room', (0, 0, 0), stamp=beyond),
                                 transform('map', 'room', (0, 0, 0), stamp=start),
                                 transform('map', 'elsewhere', (0, 0, 0), stamp=end)])
            wait_until(lambda: 'is too large to compute with' in localizer.output(), 'complaint')
            time.sleep(0.1 * TIME_FACTOR)  # until all have arrived: nothing tells
            self.assertEqual(localizer.answer('statistics', self.publish(start)).clouds_without_transform, 0)
            self.publish(end)
            wait_until(lambda: 'want of a transform' in localizer.output(), 'complaint')
            # Time goes back with the next cloud, which has transforms of before forgotten.
            self.publish(start + rospy.Duration(1))
            last = start + rospy.Duration(2)
            time.sleep(0.5 * TIME_FACTOR)  # until that one has been given up: nothing tells
            self.moving.publish([transform('map', 'room', (0, 0, 0), stamp=last)])
            time.sleep(0.1 * TIME_FACTOR)
            self.assertGreater(localizer.answer('statistics', self.publish(last)).clouds_without_transform, 0)
            self.assertEqual(localizer.interrupt(), 0, localizer.output())

    def test_a_rotation_of_few_digits(self):
        with Localizer('localizer', '_target_frame:=map') as localizer:
            self.connect()
            stamp = rospy.Time.now()
            self.moving.publish([transform('map', 'room', (0, 0, 0), (0, 0, 0.7, 0.71), stamp)])
            time.sleep(0.1)  # likewise
            self.publish(stamp)
            shells = localizer.answer('shells', stamp).shells
            self.assertGreater(len(shells), 50)
            for shell in shells:
                for direction in (shell.axis, shell.normal):
                    self.assertAlmostEqual(math.hypot(*vector(direction)), 1, delta=1e-6)

    def test_a_cloud_without_a_frame_waits_for_nothing(self):
        with Localizer('localizer', '_target_frame:=map', '_transform_timeout:=10') as localizer:
            self.connect()
            self.publish(frame='')
            wait_until(lambda: 'cloud dropped for want of a transform' in localizer.output(), 'complaint', timeout=5)
            self.assertNotIn('canTransform', localizer.output())

    def test_transforms_of_an_earlier_run_are_forgotten(self):
        start = rospy.Time.now()
        with Localizer('localizer', '_target_frame:=map', '_transform_timeout:=0.2') as localizer:
            self.connect()
            # First a run, then time goes back: the transforms do first, then the clouds.
            first = self.first_centroid(localizer, start, 0, 1.5)
            self.assertAlmostEqual(self.first_centroid(localizer, start, 7, 0.8) - first, 7, delta=1e-6)
            # The clouds go back first: what is known is of the run before.
            self.publish(start + rospy.Duration(0.1))
            wait_until(lambda: 'want of a transform' in localizer.output(), 'complaint')
            self.assertAlmostEqual(self.first_centroid(localizer, start, 3, 0.15) - first, 3, delta=1e-6)

    def send(self, x, *stamps):
        """The origin of the frame room in the frame map, along x."""
        for stamp in stamps:
            self.moving.publish([transform('map', 'room', (x, 0, 0), stamp=stamp)])
        time.sleep(0.2 * TIME_FACTOR)  # until they have arrived: nothing tells

    @staticmethod
    def moments():
        """What gives the time that is some seconds from now."""
        start = rospy.Time.now()
        return lambda seconds: start + rospy.Duration(seconds)

    def check_place(self, localizer, stamp, x):
        """Where the frame room was in the frame map for the cloud of that stamp."""
        centroid = localizer.answer('shells', stamp).shells[0].centroid
        self.assertLess(abs(centroid.x - x), 2)  # of the table in the frame room

    def test_transforms_of_runs_in_which_nothing_was_looked_up_are_forgotten(self):
        at = self.moments()
        with self.clock() as set_clock, \
                Localizer('localizer', '_target_frame:=map', '_transform_timeout:=0.2') as localizer:
            self.connect()
            for x, seconds in ((10, 100), (20, 50)):
                set_clock(at(seconds))
                self.send(x, at(seconds), at(seconds + 2))
            set_clock(at(46))
            self.send(30, at(46), at(54))
            self.check_place(localizer, self.publish(at(51)), 30)
            # The clouds go back first.
            self.publish(at(47))
            wait_until(lambda: 'want of a transform' in localizer.output(), 'complaint')
            localizer.interrupt()
            self.assertIn('transforms begin anew: /clock goes back to', localizer.output())

    def test_a_clock_that_went_back_while_no_transforms_came(self):
        at = self.moments()
        with self.clock() as set_clock, \
                Localizer('localizer', '_target_frame:=map', '_transform_timeout:=0.2') as localizer:
            self.connect()
            set_clock(at(50))
            self.send(10, at(50), at(52))
            for seconds in (20, 60):
                set_clock(at(seconds))
                time.sleep(1.2 * TIME_FACTOR)  # the node looks at the clock every half a second: nothing tells
            self.publish(at(51))
            wait_until(lambda: 'want of a transform' in localizer.output(), 'complaint')

    def test_transforms_that_went_back_without_a_clock_before_anybody_asked(self):
        at = self.moments()
        with Localizer('localizer', '_target_frame:=map', '_transform_timeout:=10') as localizer:
            self.connect()
            self.send(10, at(50), at(52))
            self.send(30, at(46))
            stamp = self.publish(at(51))
            time.sleep(0.5 * TIME_FACTOR)  # until they have been forgotten on its account: nothing tells
            end = time.monotonic() + 9 * TIME_FACTOR
            while not localizer.answered() and time.monotonic() < end:
                self.send(30, at(50.9), at(51.1))
            self.check_place(localizer, stamp, 30)
            localizer.interrupt()
            self.assertIn('transforms begin anew: those of room go back to', localizer.output())

    @contextlib.contextmanager
    def clock(self):
        """ROS time is simulated for who starts now; yields how to set it."""
        rospy.set_param('/use_sim_time', True)
        publisher = rospy.Publisher('/clock', Clock, queue_size=1, latch=True)

        def set_clock(now):
            publisher.publish(now)
            time.sleep(0.2 * TIME_FACTOR)  # until it has arrived: nothing tells

        try:
            yield set_clock
        finally:
            publisher.unregister()
            rospy.delete_param('/use_sim_time')

    def first_centroid(self, localizer, start, x, seconds):
        """Of a shell in the frame map, along x; its origin is at x in the frame room, from the start for two seconds."""
        for t in (0.0, 2.0):
            self.moving.publish([transform('map', 'room', (x, 0, 0), stamp=start + rospy.Duration(t))])
        time.sleep(0.1)  # until they have arrived: nothing tells
        stamp = self.publish(start + rospy.Duration(seconds))
        return localizer.answer('shells', stamp).shells[0].centroid.x

    def test_ends_while_a_cloud_waits(self):
        with Localizer('localizer', '_target_frame:=nowhere', '_transform_timeout:=10') as localizer:
            self.connect()
            self.publish()
            time.sleep(0.5)
            start = time.monotonic()
            self.assertEqual(localizer.interrupt(), 0, localizer.output())
            self.assertLess(time.monotonic() - start, 5)

    def test_says_that_there_is_no_clock(self):
        rospy.set_param('/use_sim_time', True)
        try:
            with Localizer('localizer') as localizer:
                self.connect(listeners=0)
                wait_until(lambda: '/clock' in localizer.output(), 'complaint')
                localizer.answer('statistics', self.publish())  # it works nevertheless
        finally:
            rospy.delete_param('/use_sim_time')


if __name__ == '__main__':
    rospy.init_node('tf_test')
    rostest.rosrun('grasp_affordances', 'tf', Tf)
