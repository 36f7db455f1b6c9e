#!/usr/bin/python3
"""What the simulated camera publishes, alone and with the localizer in one manager; refusal to start; end."""

import array
import math
import struct
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
import tf2_ros
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

from grasp_affordances.msg import CylindricalShellArray
from helpers import (ABNORMAL_ENDS, TIME_FACTOR, Listener, Process, coordinates, manager, measured, publisher,
                     rotated, scene, wait_until)

NODELET = 'grasp_affordances/SimulatedCameraNodelet'


def camera(name, *parameters):
    """A camera in a process of its own, its topics in the namespace of that name and its frames named after it."""
    return Process('nodelet', 'nodelet', 'standalone', NODELET, '__ns:=' + name, '__name:=driver', '_camera:=' + name,
                   *parameters)


def loader(*options):
    """Loads a camera into the manager, stays, and unloads it when it is interrupted."""
    return Process('nodelet', 'nodelet', 'load', NODELET, 'manager', '__name:=driver', 'depth/points:=loaded/points',
                   *options)


def advertised(topic):
    return topic in (name for name, _ in rospy.get_published_topics())


def single(value):
    """Rounded to single precision."""
    return struct.unpack('f', struct.pack('f', value))[0]


def measured_bytes(cloud):
    """Coordinates of the measured points, bit by bit."""
    return [struct.pack('<fff', *point) for point in coordinates(cloud) if not math.isnan(point[2])]


class SimulatedCamera(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tf = tf2_ros.Buffer()
        cls.tf_listener = tf2_ros.TransformListener(cls.tf)

    def transform(self, target, source, stamp=rospy.Time(0)):
        transform = self.tf.lookup_transform(target, source, stamp, rospy.Duration(10)).transform
        return transform.translation, transform.rotation

    def frame(self):
        """Camera info, depth image and cloud with one stamp."""
        listeners = [Listener('camera/depth/' + name, kind) for name, kind in
                     (('camera_info', CameraInfo), ('image_raw', Image), ('points', PointCloud2))]
        infos, images, clouds = listeners
        cloud = clouds.wait(lambda m: all(m.header.stamp in (other.header.stamp for other in listener.messages())
                                          for listener in (infos, images)))
        frame = [listener.wait(lambda m: m.header.stamp == cloud.header.stamp) for listener in listeners]
        for listener in listeners:
            listener.close()
        return frame

    def test_images_and_clouds_are_those_of_an_xtion(self):
        info, image, cloud = self.frame()
        for message in (info, image, cloud):
            self.assertEqual(message.header.frame_id, 'camera_depth_optical_frame')
            self.assertEqual((message.width, message.height), (640, 480))
        self.assertEqual((image.encoding, image.step, len(image.data)), ('16UC1', 2 * 640, 2 * 640 * 480))
        self.assertEqual((cloud.row_step, len(cloud.data)), (640 * cloud.point_step, 480 * cloud.row_step))
        self.assertFalse(cloud.is_dense)
        self.assertEqual((info.distortion_model, info.D), ('plumb_bob', (0, 0, 0, 0, 0)))
        self.assertEqual(info.P[0:3] + info.P[4:7] + info.P[8:11], info.K)
        self.check_cloud_against_image(info, array.array('H', image.data), coordinates(cloud))

    def check_cloud_against_image(self, info, depth, points):
        fx, cx, fy, cy = info.K[0], info.K[2], info.K[4], info.K[5]
        measured = 0
        for pixel, (millimetres, (x, y, z)) in enumerate(zip(depth, points)):
            if millimetres == 0:
                self.assertTrue(math.isnan(x) and math.isnan(y) and math.isnan(z))
                continue
            measured += 1
            row, column = divmod(pixel, info.width)
            metres = single(millimetres * single(0.001))  # as depth_image_proc converts
            x_error = x - (column - cx) / fx * metres
            y_error = y - (row - cy) / fy * metres
            # Single precision keeps 24 bits, and at most four results are rounded on the way.
            if z != metres or abs(x_error) > abs(x) * 2 ** -22 or abs(y_error) > abs(y) * 2 ** -22:
                self.fail('row %d, column %d, %d mm: (%.9g, %.9g, %.9g)' % (row, column, millimetres, x, y, z))
        self.assertGreater(measured, 100000)

    def test_frames_are_those_of_openni2_launch(self):
        translation, rotation = self.transform('camera_link', 'camera_depth_frame')
        self.assertEqual((translation.x, translation.y, translation.z), (0, -0.02, 0))
        self.assertEqual(abs(rotation.w), 1)
        _, rotation = self.transform('camera_depth_frame', 'camera_depth_optical_frame')
        # Optical x, y, z are right, down, forward.
        for axis, expected in (((1, 0, 0), (0, -1, 0)), ((0, 1, 0), (0, 0, -1)), ((0, 0, 1), (1, 0, 0))):
            for value, coordinate in zip(rotated(rotation, axis), expected):
                self.assertAlmostEqual(value, coordinate, delta=1e-12)

    def test_clouds_lie_where_the_frames_say_with_a_still_and_with_a_moving_camera(self):
        # On a circle with a radius of 0.68 m x sin 10 degrees = 12 cm; a quarter of it spans 17 cm.
        for motion, moves in (('still', False), ('orbit', True)):
            with camera(motion, '_scene:=empty_table', '_motion:=' + motion, '_amplitude_deg:=10', '_period_s:=1'):
                self.transform('world', motion + '_depth_optical_frame')  # until we hear of frames
                clouds = Listener(motion + '/depth/points', PointCloud2)
                first = clouds.wait()
                later = clouds.wait(lambda m: 0.25 <= (m.header.stamp - first.header.stamp).to_sec() % 1 <= 0.75)
                places = [self.place_above_table(motion, cloud) for cloud in (first, later)]
                clouds.close()
            if moves:
                self.assertGreater(math.dist(*places), 0.1)
            else:
                self.assertEqual(*places)

    def test_turned_cameras_see_one_world_from_around(self):
        places = []
        for name, turn in (('ahead_of_it', 0), ('aside', 120)):
            with camera(name, '_scene:=empty_table', '_turn_deg:=%d' % turn, '_noise_seed:=%d' % turn):
                self.transform('world', name + '_depth_optical_frame')  # until we hear of frames
                clouds = Listener(name + '/depth/points', PointCloud2)
                places.append(self.place_above_table(name, clouds.wait()))
                clouds.close()
        self.assertGreater(math.dist(*places), 0.5)

    def test_frames_rendered_ahead_come_again_and_again_and_lie_where_the_frames_say(self):
        with camera('ahead', '_scene:=empty_table', '_motion:=orbit', '_amplitude_deg:=10', '_frames_ahead:=3',
                    '_rate:=10'):
            self.transform('world', 'ahead_depth_optical_frame')  # until we hear of frames
            clouds = Listener('ahead/depth/points', PointCloud2)
            clouds.wait(lambda _: len(clouds.messages()) == 9)
            clouds.close()
            received = clouds.messages()[:9]
            stamps = [cloud.header.stamp for cloud in received]
            self.assertEqual(stamps, sorted(set(stamps)))
            places = {}
            for cloud in received:
                places.setdefault(cloud.data, set()).add(self.place_above_table('ahead', cloud))
        self.assertEqual(len(places), 3)
        self.assertTrue(all(len(of_one_frame) == 1 for of_one_frame in places.values()), places)
        # A third of a turn apart, on a circle with a radius of 12 cm.
        first, second, third = (place for of_one_frame in places.values() for place in of_one_frame)
        for distance in (math.dist(first, second), math.dist(second, third), math.dist(third, first)):
            self.assertAlmostEqual(distance, math.dist(first, second), delta=1e-9)
            self.assertGreater(distance, 0.1)

    def place_above_table(self, name, cloud):
        """Where the camera was at the time of the cloud, whose points around the middle of the picture lie on z = 0."""
        self.assertEqual(cloud.header.frame_id, name + '_depth_optical_frame')
        translation, rotation = self.transform('world', cloud.header.frame_id, cloud.header.stamp)
        origin = (translation.x, translation.y, translation.z)
        points = coordinates(cloud)
        middle = [points[640 * row + column] for row in range(140, 341, 10) for column in range(120, 521, 20)]
        heights = [rotated(rotation, point)[2] + origin[2] for point in middle if not math.isnan(point[2])]
        self.assertGreater(len(heights), len(middle) // 2)
        for height in heights:
            # At a depth of 1 m the standard deviation is 1.6 mm. One frame later, the table is tilted by 7 mm.
            self.assertAlmostEqual(height, 0, delta=0.006)
        return origin

    @measured
    def test_renders_only_while_somebody_listens(self, measurement):
        rate = 10  # Hz
        with camera('lazy', '_scene:=table', '_seed:=1', '_rate:=%d' % rate):
            wait_until(lambda: advertised('/lazy/depth/points'), 'advertisement')
            time.sleep(1)
            # Frame n has the noise of the seed 1 + n: this is the first one that is rendered.
            clouds = Listener('lazy/depth/points', PointCloud2)
            first = clouds.wait()
            simulated = Listener('points', PointCloud2)
            with publisher(scene('table')):
                self.assertEqual(measured_bytes(first), measured_bytes(simulated.wait()))
            simulated.close()
            self.assertNotEqual(measured_bytes(clouds.wait(lambda m: m.header.seq != first.header.seq)),
                                measured_bytes(first))

            clouds.close()
            time.sleep(0.5)
            last = clouds.messages()[-1]
            time.sleep(4.5)
            clouds = Listener('lazy/depth/points', PointCloud2)
            again = clouds.wait()
            clouds.close()
        # The sequence number counts what is published, to nobody too. Some frames go by until the end of a connection is
        # noticed: on a busy machine those of more than a second.
        pause = (again.header.stamp - last.header.stamp).to_sec()
        self.assertGreater(pause, 4.5)
        with measurement.judged():
            self.assertLess(again.header.seq - last.header.seq, rate * pause / 2)

    def test_localizer_in_the_same_manager_finds_shells(self):
        shells = Listener('localizer/shells', CylindricalShellArray)
        found = shells.wait(lambda m: m.shells)
        self.assertEqual(found.header.frame_id, 'camera_depth_optical_frame')
        # Clouds are handed over as pointers; nobody else listens.
        wait_until(lambda: self.transports('/camera_nodelet_manager', '/camera/depth/points') == {'INTRAPROCESS'},
                   'a connection within the process alone')
        shells.close()

    @staticmethod
    def transports(node, topic):
        """Of all connections of a node that carry a topic."""
        slave = xmlrpc.client.ServerProxy(rosgraph.Master(rospy.get_name()).lookupNode(node))
        return {transport for _, _, _, transport, name, *_ in slave.getBusInfo(rospy.get_name())[2] if name == topic}

    def test_refuses_an_unknown_scene_and_names_the_known_ones(self):
        with camera('refused', '_scene:=tabel') as process:
            self.assertNotEqual(process.wait(15), 0)
            self.assertIn("~scene is the string 'tabel'; it must be one of", process.output())
            self.assertIn(' table', process.output())
        self.assertFalse(advertised('/refused/depth/points'))

    @measured
    def test_unloads_while_it_renders_ahead(self, measurement):
        with manager() as host, loader('_frames_ahead:=1000') as load:
            wait_until(lambda: advertised('/loaded/points'), 'advertisement')
            clouds = Listener('loaded/points', PointCloud2)
            time.sleep(2)  # for a frame or two dozens; a bond forms in the first second
            self.assertEqual(load.interrupt(), 0, load.output())
            start = time.monotonic()
            wait_until(lambda: not advertised('/loaded/points'), 'unloading')
            with measurement.judged():
                self.assertLess(time.monotonic() - start, 2 * TIME_FACTOR)
            clouds.close()
            self.assertEqual(clouds.messages(), [])
            self.assertEqual(host.interrupt(), 0, host.output())

    @measured
    def test_unloads_in_the_middle_of_a_frame(self, measurement):
        with manager() as host:
            for _ in range(2):
                with loader('_rate:=120') as load:  # faster than it can render: there is always a frame under work
                    clouds = Listener('loaded/points', PointCloud2)
                    clouds.wait()
                    time.sleep(1)
                    start = time.monotonic()
                    self.assertEqual(load.interrupt(), 0, load.output())
                    wait_until(lambda: not advertised('/loaded/points'), 'unloading')
                    with measurement.judged():
                        self.assertLess(time.monotonic() - start, 2)
                    clouds.close()
                stamps = [cloud.header.stamp for cloud in clouds.messages()]
                self.assertEqual(stamps, sorted(set(stamps)))
            # A bond that is still forming, about a second long, makes nodelet's Loader crash when it is destroyed.
            with loader('_rate:=120', '--no-bond'):
                clouds = Listener('loaded/points', PointCloud2)
                clouds.wait()
                self.assertEqual(host.interrupt(), 0, host.output())
                clouds.close()
            for sign in ABNORMAL_ENDS:
                self.assertNotIn(sign, host.output())


if __name__ == '__main__':
    rospy.init_node('simulated_camera_test')
    rostest.rosrun('grasp_affordances', 'simulated_camera', SimulatedCamera)
