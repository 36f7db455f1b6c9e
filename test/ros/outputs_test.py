#!/usr/bin/python3
"""What a running localizer subscribes to and publishes, as a plain node or as a nodelet."""

import math
import time
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, PointCloud2, PointField
from visualization_msgs.msg import Marker, MarkerArray

from grasp_affordances.msg import CylindricalShellArray, HandleArray, LocalizationStatistics
from helpers import Listener, cloud, others_subscribed_to, publisher, scene, wait_until

OUTPUTS = {'shells': CylindricalShellArray, 'handles': HandleArray, 'markers': MarkerArray,
           'statistics': LocalizationStatistics}
OUTCOMES = ('too_few_points', 'degenerate', 'occluded', 'low_curvature', 'concave', 'no_shell', 'too_short',
            'unobserved_gap', 'uncovered', 'shells')


def shown_after(arrays):
    """Markers, by namespace and id, that rviz shows after these arrays."""
    shown = {}
    for marker in (marker for array in arrays for marker in array.markers):
        if marker.action == Marker.DELETEALL:
            shown.clear()
        elif marker.action == Marker.DELETE:
            shown.pop((marker.ns, marker.id), None)
        else:
            shown[marker.ns, marker.id] = marker
    return shown


def norm(vector):
    return math.sqrt(vector.x ** 2 + vector.y ** 2 + vector.z ** 2)


class Outputs(unittest.TestCase):
    def setUp(self):
        wait_until(lambda: {'/localizer/' + name for name in OUTPUTS} <= {
            topic for topic, _ in rospy.get_published_topics('/localizer')}, 'advertisement')
        self.listeners = {}

    def tearDown(self):
        for listener in self.listeners.values():
            listener.close()
        wait_until(lambda: not others_subscribed_to('/points'), 'end of the subscription')

    def listen(self):
        self.listeners = {name: Listener('localizer/' + name, kind) for name, kind in OUTPUTS.items()}
        wait_until(lambda: others_subscribed_to('/points'), 'subscription')

    def test_subscribes_only_while_somebody_listens(self):
        time.sleep(0.5)
        self.assertFalse(others_subscribed_to('/points'))
        for name, kind in OUTPUTS.items():
            listener = Listener('localizer/' + name, kind)
            wait_until(lambda: others_subscribed_to('/points') and others_subscribed_to('/camera_info'), name)
            listener.close()
            wait_until(lambda: not others_subscribed_to('/points') and not others_subscribed_to('/camera_info'),
                       'end of ' + name)

    def test_shells_arrive_and_an_empty_table_clears_them(self):
        self.listen()
        clouds = Listener('points', PointCloud2)
        with publisher(scene('table'), rate=3, frame='somewhere'):
            found = self.listeners['shells'].wait()
            statistics = self.listeners['statistics'].wait(lambda m: m.header.stamp == found.header.stamp)
            handles = self.listeners['handles'].wait(lambda m: m.header.stamp == found.header.stamp)
            drawn = self.listeners['markers'].wait(lambda m: m.markers[-1].header.stamp == found.header.stamp)
        self.check_shells(found)
        self.check_statistics(statistics, found)
        self.check_markers(drawn, found, handles)
        clouds.wait(lambda m: m.header.stamp == found.header.stamp and m.header.frame_id == found.header.frame_id)
        clouds.close()

        with publisher(scene('empty_table'), frame='elsewhere'):
            empty = self.listeners['shells'].wait(lambda m: m.header.frame_id == 'elsewhere')
            self.assertEqual(empty.shells, [])
            statistics = self.listeners['statistics'].wait(lambda m: m.header.stamp == empty.header.stamp)
            self.assertGreater(statistics.sampled, 0)
            self.assertEqual(sum(getattr(statistics, outcome) for outcome in OUTCOMES), statistics.sampled)
            wait_until(lambda: not shown_after(self.listeners['markers'].messages()), 'removal of the markers')

    def check_shells(self, message):
        self.assertEqual(message.header.frame_id, 'somewhere')
        self.assertGreater(len(message.shells), 0)
        for shell in message.shells:
            self.assertEqual((shell.pose.position.x, shell.pose.position.z), (shell.centroid.x, shell.centroid.z))
            self.assertAlmostEqual(norm(shell.axis), 1, delta=1e-9)
            self.assertAlmostEqual(norm(shell.normal), 1, delta=1e-9)
            self.assertLessEqual(shell.inner_radius, 0.026 + 1e-9)
            self.assertGreaterEqual(shell.length, 0.03)
            self.assertLess(shell.normal.x * shell.centroid.x + shell.normal.y * shell.centroid.y +
                            shell.normal.z * shell.centroid.z, 0, 'the normal points away from the sensor')

    def check_statistics(self, statistics, found):
        self.assertEqual(statistics.header.frame_id, found.header.frame_id)
        self.assertEqual((statistics.preset, statistics.estimator, statistics.seed), ('localizer', 'taubin', 1))
        self.assertEqual(statistics.shells, len(found.shells))
        self.assertEqual(sum(getattr(statistics, outcome) for outcome in OUTCOMES), statistics.sampled)
        self.assertGreater(statistics.milliseconds_total, 0)
        self.assertGreater(statistics.milliseconds_latency, statistics.milliseconds_total)
        self.assertGreaterEqual(statistics.clouds_received, statistics.clouds_processed)

    def check_markers(self, array, found, handles):
        shown = shown_after([array])
        expected = {(ns, i) for ns in ('shells', 'axes') for i in range(len(found.shells))}
        for handle in handles.handles:
            expected |= {('handles', handle.id), ('handle_ids', handle.id)}
            if handle.hand_poses:
                expected.add(('hand_poses', handle.id))
        self.assertEqual(set(shown), expected)
        self.assertEqual({marker.header.frame_id for marker in shown.values()}, {found.header.frame_id})
        for i, shell in enumerate(found.shells):
            self.assertEqual(shown['shells', i].pose, shell.pose)
            self.assertEqual(shown['shells', i].scale.z, shell.length)
        for handle in handles.handles:
            self.assertEqual(shown['handle_ids', handle.id].text, str(handle.id))

    def test_malformed_clouds_are_rejected_and_the_next_one_is_processed(self):
        big_endian, no_x, int_x, row_step, data = (cloud() for _ in range(5))
        big_endian.is_bigendian = True
        del no_x.fields[0]
        int_x.fields[0].datatype = PointField.INT32
        row_step.row_step -= 1
        row_step.data += b'\0'  # with exactly the points' bytes the step would not matter
        data.data = data.data[:-1]

        self.listen()
        errors = Listener('/rosout', Log)
        points = rospy.Publisher('points', PointCloud2, queue_size=10)
        wait_until(lambda: points.get_num_connections() == 1, 'connection')
        rejected = self.statistics_of(points, cloud()).clouds_rejected
        for malformed in (big_endian, no_x, int_x, row_step, data):
            points.publish(malformed)
            time.sleep(0.3)  # else the next, newer cloud might rightly replace it
            statistics = self.statistics_of(points, cloud())
            rejected += 1
            self.assertEqual(statistics.clouds_rejected, rejected)
            self.assertEqual(statistics.clouds_received, statistics.clouds_processed + statistics.clouds_dropped +
                             statistics.clouds_rejected)
        errors.wait(lambda m: m.level == Log.ERROR and 'cloud rejected' in m.msg and 'endian' in m.msg)
        errors.close()

    def test_a_cloud_without_a_measured_point_says_so(self):
        self.listen()
        points = rospy.Publisher('points', PointCloud2, queue_size=10)
        wait_until(lambda: points.get_num_connections() == 1, 'connection')
        statistics = self.statistics_of(points, cloud())
        self.assertEqual((statistics.points, statistics.sampled), (0, 0))
        self.assertEqual(len(statistics.warnings), 1)

    def test_camera_info_of_another_size_is_ignored(self):
        self.listen()
        warnings = Listener('/rosout', Log)
        points = rospy.Publisher('points', PointCloud2, queue_size=10)
        cameras = rospy.Publisher('camera_info', CameraInfo, queue_size=1, latch=True)
        wait_until(lambda: points.get_num_connections() == 1 and cameras.get_num_connections() == 1, 'connection')
        cameras.publish(CameraInfo(width=640, height=480, P=[525, 0, 319.5, 0, 0, 525, 239.5, 0, 0, 0, 1, 0]))
        time.sleep(0.3)
        self.statistics_of(points, cloud())
        warnings.wait(lambda m: m.level == Log.WARN and '640x480' in m.msg and '8x6' in m.msg)
        warnings.close()

    def statistics_of(self, points, message):
        points.publish(message)
        return self.listeners['statistics'].wait(lambda m: m.header.stamp == message.header.stamp)


if __name__ == '__main__':
    rospy.init_node('outputs_test')
    rostest.rosrun('grasp_affordances', 'outputs', Outputs)
