#!/usr/bin/python3
"""What the localizer does when it is asked to: services, clouds on demand, a rate and a time that are not exceeded."""

import math
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, PointStamped, Quaternion, TransformStamped, Vector3
from sensor_msgs.msg import CameraInfo, PointCloud2
from tf2_msgs.msg import TFMessage

from grasp_affordances.msg import CylindricalShellArray, LocalizationStatistics, RegionOfInterest
from grasp_affordances.srv import Localize, LocalizeNext
from helpers import (ABNORMAL_ENDS, TIME_FACTOR, Listener, Process, cloud, coordinates, manager, measured, moved_points,
                     published, publisher, scene, serialized, wait_until)

OUTCOMES = ('too_few_points', 'degenerate', 'occluded', 'low_curvature', 'concave', 'no_shell', 'too_short',
            'unobserved_gap', 'uncovered', 'out_of_time', 'shells')


class Localizer(Process):
    """A localizer and its services."""

    def __init__(self, *parameters):
        if rospy.has_param('localizer'):
            rospy.delete_param('localizer')
        super().__init__('grasp_affordances', 'localizer_node', *parameters)
        self._calls = {}
        for name, kind in (('localize', Localize), ('trigger', LocalizeNext)):
            rospy.wait_for_service('localizer/' + name, timeout=20)
            self._calls[name] = rospy.ServiceProxy('localizer/' + name, kind)

    def localize(self, cloud, region=None, camera_info=None, sensor=None):
        return self._calls['localize'](cloud=cloud, region=region or RegionOfInterest(),
                                       camera_info=camera_info or CameraInfo(), sensor=sensor or PointStamped())

    def trigger(self, timeout=0, region=None):
        return self._calls['trigger'](region=region or RegionOfInterest(), timeout=timeout)


class Call(threading.Thread):
    """A call of ~trigger that goes on while the test does other things. An exception is its answer, too."""

    def __init__(self, timeout):
        super().__init__(daemon=True)
        self._timeout = timeout
        self.answer = None
        self.start()
        time.sleep(0.5)  # until it waits: nothing tells

    def run(self):
        try:
            self.answer = rospy.ServiceProxy('localizer/trigger', LocalizeNext)(timeout=self._timeout)
        except (rospy.ServiceException, rospy.exceptions.ROSException) as error:
            self.answer = error


def box(centre, half, frame=''):
    return RegionOfInterest(frame_id=frame, min=Point(*(x - half for x in centre)),
                            max=Point(*(x + half for x in centre)))


def place(x, y, z, frame=''):
    result = PointStamped(point=Point(x, y, z))
    result.header.frame_id = frame
    return result


def fixed_transform(parent, child, translation):
    result = TransformStamped(child_frame_id=child)
    result.header.frame_id = parent
    result.transform.translation = Vector3(*translation)
    result.transform.rotation = Quaternion(0, 0, 0, 1)
    return result


def vector(message):
    return (message.x, message.y, message.z)


class OnDemand(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = published('table')
        cls.frame = cls.table.header.frame_id
        cls.coordinates = coordinates(cls.table)

    def check_sums(self, statistics):
        self.assertEqual(sum(getattr(statistics, outcome) for outcome in OUTCOMES), statistics.sampled)

    def check_received(self, statistics):
        """Every cloud that came in is accounted for."""
        known = sum(getattr(statistics, 'clouds_' + what) for what in
                    ('processed', 'dropped', 'left_out', 'rejected', 'without_transform'))
        self.assertIn(statistics.clouds_received - known, (0, 1))

    def check_inside(self, shells, centre, half):
        self.assertGreater(len(shells), 3)
        for shell in shells:
            for x, middle in zip(self.coordinates[shell.point_index], centre):
                self.assertLessEqual(abs(x - middle), half + 1e-6)

    def test_localize_without_a_camera(self):
        with Localizer() as localizer:
            found = localizer.localize(self.table)
            self.assertTrue(found.success, found.message)
            self.assertEqual(found.message, '')
            self.assertGreater(len(found.shells), 50)
            self.assertGreater(len(found.handles), 0)
            self.assertEqual(found.statistics.header, self.table.header)
            self.assertEqual((found.statistics.shells, found.statistics.handles),
                             (len(found.shells), len(found.handles)))
            self.assertGreater(found.statistics.milliseconds_latency, found.statistics.milliseconds_total)
            self.check_sums(found.statistics)

            again = localizer.localize(self.table)
            self.assertEqual([serialized(shell) for shell in again.shells],
                             [serialized(shell) for shell in found.shells])

            centre = self.coordinates[found.shells[len(found.shells) // 2].point_index]
            region = localizer.localize(self.table, box(centre, 0.05))
            self.assertTrue(region.success, region.message)
            self.check_inside(region.shells, centre, 0.05)

            # The region was that call's only.
            self.assertEqual(len(localizer.localize(self.table).shells), len(found.shells))

    def test_localize_finds_what_is_published_for_the_same_cloud(self):
        with Localizer() as localizer, publisher(scene('table')):
            listener = Listener('localizer/shells', CylindricalShellArray)
            published = listener.wait()
            listener.close()
            found = localizer.localize(self.table)
        self.assertEqual([serialized(shell) for shell in found.shells],
                         [serialized(shell) for shell in published.shells])

    def test_localize_says_why_not(self):
        with Localizer('_transform_timeout:=0.1') as localizer:
            malformed = cloud()
            malformed.data = malformed.data[:-1]
            beyond = box((0, 0, 0), 1000)
            inverted = RegionOfInterest(min=Point(0.1, 0, 0), max=Point(-0.1, 1, 1))
            for answer, words in ((localizer.localize(malformed), ('data',)),
                                  (localizer.localize(self.table, beyond), ('region', '[-100, 100] m')),
                                  (localizer.localize(self.table, inverted), ('region', 'not above')),
                                  (localizer.localize(self.table, box((0, 0, 1), 1, 'nowhere')), ('nowhere',)),
                                  (localizer.localize(self.table, camera_info=CameraInfo(width=3, height=2)),
                                   ('camera_info', '3x2'))):
                self.assertFalse(answer.success, words)
                self.assertEqual(answer.shells, [])
                for word in words:
                    self.assertIn(word, answer.message)
                self.assertNotIn('\n', answer.message)

            nothing = localizer.localize(cloud())
            self.assertTrue(nothing.success)
            self.assertIn('No handle', nothing.message)
            self.assertEqual(nothing.message, nothing.statistics.explanation)
            elsewhere = localizer.localize(self.table, box((50, 50, 50), 1))
            self.assertTrue(elsewhere.success)
            self.assertIn('workspace', elsewhere.message)

    def test_region_in_another_frame(self):
        fixed = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        fixed.publish([fixed_transform('shelf', self.frame, (10, 20, 30))])
        with Localizer() as localizer:
            found = localizer.localize(self.table)
            centre = self.coordinates[found.shells[0].point_index]
            there = tuple(a + b for a, b in zip(centre, (10, 20, 30)))
            moved = localizer.localize(self.table, box(there, 0.05, 'shelf'))
            self.assertTrue(moved.success, moved.message)
            self.check_inside(moved.shells, centre, 0.05)
            # As in the cloud's own frame, but for the rounding of the box.
            here = localizer.localize(self.table, box(centre, 0.05))
            self.assertAlmostEqual(len(moved.shells), len(here.shells), delta=0.05 * len(here.shells) + 1)
            with publisher(scene('table'), rate=10):
                triggered = localizer.trigger(timeout=20, region=box(there, 0.05, 'shelf'))
            self.assertTrue(triggered.success, triggered.message)
            self.check_inside(triggered.shells, centre, 0.05)
        fixed.unregister()

    def test_localize_in_points_seen_from_elsewhere(self):
        fixed = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        fixed.publish([fixed_transform('base', 'eye', (0, 0, -1.625))])
        # The origin is on the other side of the table.
        points = moved_points(self.table, lambda p: (p[0], p[1], p[2] - 1.625), 'base')
        with Localizer() as localizer:
            unknown = localizer.localize(points)
            self.assertTrue(unknown.success, unknown.message)
            self.assertEqual(unknown.statistics.concave, 0)
            self.assertTrue(all(math.isnan(shell.normal.x) for shell in unknown.shells))
            self.assertTrue(any('the field sensor' in warning for warning in unknown.statistics.warnings))
            for handle in unknown.handles:
                for pose in [handle.pose] + [hand.pose for hand in handle.hand_poses]:
                    q = pose.orientation
                    self.assertAlmostEqual(math.hypot(q.x, q.y, q.z, q.w), 1, delta=1e-9)

            given = localizer.localize(points, sensor=place(0, 0, -1.625, 'base'))
            self.assertTrue(given.success, given.message)
            self.assertGreater(given.statistics.concave, 0)
            self.assertGreater(len(given.handles), 0)
            self.assertGreaterEqual(len(unknown.handles), len(given.handles))
            for shell in given.shells:
                n, c = vector(shell.normal), vector(shell.centroid)
                self.assertGreater(-n[0] * c[0] - n[1] * c[1] + n[2] * (-1.625 - c[2]), 0)

            by_tf = localizer.localize(points, sensor=place(0, 0, 0, 'eye'))
            self.assertEqual([serialized(shell) for shell in by_tf.shells],
                             [serialized(shell) for shell in given.shells])
            # The place was that call's only.
            self.assertEqual(localizer.localize(points).statistics.concave, 0)

            for sensor, word in ((place(0, 0, 1), 'frame'), (place(0, math.nan, 1, 'base'), 'finite'),
                                 (place(0, 0, 0, 'nowhere'), 'nowhere')):
                answer = localizer.localize(points, sensor=sensor)
                self.assertFalse(answer.success)
                self.assertIn(word, answer.message)
        fixed.unregister()

    def test_trigger_answers_with_what_is_published(self):
        with Localizer() as localizer, publisher(scene('table'), rate=10):
            answer = localizer.trigger(timeout=20)  # nobody listens: it subscribes
            self.assertTrue(answer.success, answer.message)
            self.assertGreater(len(answer.shells), 50)
            self.assertGreater(len(answer.handles), 0)
            self.check_sums(answer.statistics)
            self.assertGreaterEqual(answer.statistics.clouds_processed, 1)

            listener = Listener('localizer/shells', CylindricalShellArray)
            listener.wait()
            answer = localizer.trigger(timeout=20)
            published = listener.wait(lambda m: m.header.stamp == answer.statistics.header.stamp)
            self.assertEqual([serialized(shell) for shell in answer.shells],
                             [serialized(shell) for shell in published.shells])
            before = rospy.Time.now()
            self.assertGreater(localizer.trigger(timeout=20).statistics.header.stamp, before - rospy.Duration(0.5))
            listener.close()

    @measured
    def test_trigger_says_why_not(self, measurement):
        with Localizer() as localizer:
            start = time.monotonic()
            answer = localizer.trigger(timeout=0.5)
            self.assertFalse(answer.success)
            self.assertIn('no cloud on /points arrived within 0.5 s', answer.message)
            elapsed = time.monotonic() - start
            self.assertGreaterEqual(elapsed, 0.5)
            with measurement.judged():
                self.assertLess(elapsed, 3)
            for timeout in (-1, float('nan'), 1e9):
                answer = localizer.trigger(timeout)
                self.assertFalse(answer.success)
                self.assertIn('[0, 3600] s', answer.message)
            self.assertIn('region', localizer.trigger(20, RegionOfInterest(max=Point(-1, 1, 1))).message)

            points = rospy.Publisher('points', PointCloud2, queue_size=1)
            malformed = cloud()
            malformed.is_bigendian = True
            call = Call(timeout=20)
            wait_until(lambda: points.get_num_connections() == 1, 'connection')
            points.publish(malformed)
            call.join(20)
            self.assertFalse(call.answer.success)
            self.assertIn('endian', call.answer.message)
            points.unregister()

    def test_a_waiting_trigger_holds_nothing_up(self):
        with Localizer() as localizer:
            call = Call(timeout=20)
            start = time.monotonic()
            self.assertTrue(localizer.localize(self.table).success)
            self.assertLess(time.monotonic() - start, 10)
            self.assertIsNone(call.answer)
            with publisher(scene('table')):
                call.join(20)
            self.assertTrue(call.answer.success, call.answer.message)

    def test_on_demand_localizes_only_when_asked(self):
        with Localizer('_on_demand:=true', '_lazy:=false') as localizer, publisher(scene('table'), rate=10):
            listener = Listener('localizer/statistics', LocalizationStatistics)
            time.sleep(1.5)
            self.assertEqual(listener.messages(), [])
            for processed in (1, 2):
                answer = localizer.trigger(timeout=20)
                self.assertTrue(answer.success, answer.message)
                self.assertEqual(answer.statistics.clouds_processed, processed)
                self.assertGreater(answer.statistics.clouds_left_out, 0)
                self.check_received(answer.statistics)
            time.sleep(0.5)
            self.assertEqual(len(listener.messages()), 2)
            listener.close()

    def test_on_demand_subscribes_only_while_it_is_asked(self):
        points = rospy.Publisher('points', PointCloud2, queue_size=1)
        with Localizer('_on_demand:=true'):
            listener = Listener('localizer/statistics', LocalizationStatistics)
            time.sleep(0.5)
            self.assertEqual(points.get_num_connections(), 0)
            call = Call(timeout=20)
            wait_until(lambda: points.get_num_connections() == 1, 'subscription')
            points.publish(cloud())
            call.join(20)
            self.assertTrue(call.answer.success, call.answer.message)
            listener.wait()
            wait_until(lambda: points.get_num_connections() == 0, 'end of the subscription')
            listener.close()
        points.unregister()

    @measured
    def test_max_rate(self, measurement):
        with Localizer('_max_rate:=2', '_sampling/samples:=100') as localizer, publisher(scene('table'), rate=20):
            listener = Listener('localizer/statistics', LocalizationStatistics)
            first = listener.wait().header.stamp
            last = listener.wait(lambda m: m.clouds_processed == 6)
            # On average, whatever one cloud was late by.
            self.assertGreater((last.header.stamp - first).to_sec(), 5 / 2 - 0.5)
            self.assertGreater(last.clouds_left_out, 10)
            self.check_received(last)
            # Who asks does not wait for the rate.
            start = time.monotonic()
            for _ in range(10):
                self.assertTrue(localizer.trigger(timeout=20).success)
            with measurement.judged():
                self.assertLess(time.monotonic() - start, 10 / 2 * TIME_FACTOR)
            listener.close()

    def test_time_budget(self):
        with Localizer('_sampling/time_budget_ms:=0.001') as localizer:
            answer = localizer.localize(self.table)
            self.assertTrue(answer.success)
            self.assertEqual(answer.statistics.out_of_time, answer.statistics.sampled)
            self.assertGreater(answer.statistics.sampled, 0)
            self.check_sums(answer.statistics)
            self.assertIn('time_budget_ms', answer.message)

    def check_clean_end(self, process, call):
        start = time.monotonic()
        self.assertEqual(process.interrupt(), 0, process.output())
        self.assertLess(time.monotonic() - start, 2 + 3)  # the last three for a busy machine
        call.join(20)
        for sign in ABNORMAL_ENDS:
            self.assertNotIn(sign, process.output())
        # Answered, or told that the connection has ended.
        self.assertTrue(isinstance(call.answer, Exception) or not call.answer.success, call.answer)

    def test_node_ends_while_a_call_waits(self):
        with Localizer() as localizer:
            self.check_clean_end(localizer, Call(timeout=60))

    def test_node_ends_while_a_region_waits_for_its_transform(self):
        with Localizer('_transform_timeout:=10') as localizer:
            thread = threading.Thread(target=self.localize_nowhere, daemon=True)
            thread.start()
            time.sleep(0.5)
            start = time.monotonic()
            self.assertEqual(localizer.interrupt(), 0, localizer.output())
            self.assertLess(time.monotonic() - start, 5)
            thread.join(20)

    def localize_nowhere(self):
        try:
            rospy.ServiceProxy('localizer/localize', Localize)(cloud=self.table, region=box((0, 0, 1), 1, 'nowhere'))
        except (rospy.ServiceException, rospy.exceptions.ROSException):
            pass

    def load(self):
        return Process('nodelet', 'nodelet', 'load', 'grasp_affordances/LocalizerNodelet', 'manager', '--no-bond',
                       '__name:=localizer')

    def test_manager_ends_while_a_call_waits(self):
        with manager() as host, self.load():
            rospy.wait_for_service('localizer/trigger', timeout=20)
            self.check_clean_end(host, Call(timeout=60))

    def test_nodelet_is_unloaded_while_a_call_waits(self):
        with manager() as host:
            with self.load() as load:
                rospy.wait_for_service('localizer/trigger', timeout=20)
                call = Call(timeout=60)
                self.assertEqual(load.interrupt(), 0, load.output())
                call.join(20)
                self.assertIsNotNone(call.answer)
                if not isinstance(call.answer, Exception):
                    self.assertIn('ends', call.answer.message)
            with self.load():
                rospy.wait_for_service('localizer/localize', timeout=20)
                answer = rospy.ServiceProxy('localizer/localize', Localize)(cloud=self.table)
                self.assertTrue(answer.success)
                self.assertEqual(host.interrupt(), 0, host.output())
            for sign in ABNORMAL_ENDS:
                self.assertNotIn(sign, host.output())


if __name__ == '__main__':
    rospy.init_node('on_demand_test')
    rostest.rosrun('grasp_affordances', 'on_demand', OnDemand)
