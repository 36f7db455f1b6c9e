#!/usr/bin/python3
"""Depth, color and registration of one device, and two devices at once, as the driver publishes them."""

import unittest

import numpy
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image

from helpers import Listener, Process, manager, measured, wait_until
from virtual_devices import VirtualDevices, device, pixels

FOCAL_LENGTH = 575.8  # px, of both cameras
BASELINE = 25.0       # mm; the color camera is to the right of the depth camera


def advertised(topic):
    return topic in (name for name, _ in rospy.get_published_topics())


def received(topic, message_type):
    listener = Listener(topic, message_type)
    message = listener.wait()
    listener.close()
    return message


def as_the_color_camera_sees(depth):
    """Each pixel moved by the disparity between the cameras, nearer surfaces over farther ones."""
    height, width = depth.shape
    rows, columns = numpy.nonzero(depth)
    millimetres = depth[rows, columns]
    moved = columns - numpy.floor(FOCAL_LENGTH * BASELINE / millimetres + 0.5).astype(int)
    order = numpy.argsort(millimetres)[::-1]  # the last one written stays
    order = order[moved[order] >= 0]
    result = numpy.zeros_like(depth)
    result[rows[order], moved[order]] = millimetres[order]
    result[-1, -1] = result[-1, -2]  # as the device does for the sake of recordings
    return result


class SensorStreams(unittest.TestCase):

    def test_depth_alone(self):
        with VirtualDevices(device(frames=1)) as devices, devices.driver('alone', '_color_mode:=off'):
            image = received('alone/depth/image_raw', Image)
            info = received('alone/depth/camera_info', CameraInfo)
            self.assertFalse(advertised('/alone/rgb/image_raw'))
        for message in (image, info):
            self.assertEqual(message.header.frame_id, 'alone_depth_optical_frame')
            self.assertEqual((message.width, message.height), (640, 480))
        self.assertEqual((image.encoding, image.step, len(image.data)), ('16UC1', 2 * 640, 2 * 640 * 480))
        for focal_length in (info.K[0], info.K[4], info.P[0], info.P[5]):
            self.assertAlmostEqual(focal_length, FOCAL_LENGTH, delta=0.01)
        self.assertEqual((info.K[2], info.K[5]), (319.5, 239.5))

    def test_small_images(self):
        with VirtualDevices(device(frames=1)) as devices, devices.driver('small', '_depth_mode:=320x240@30'):
            image = received('small/depth/image_raw', Image)
            info = received('small/depth/camera_info', CameraInfo)
        self.assertEqual((image.width, image.height, len(image.data)), (320, 240, 2 * 320 * 240))
        self.assertAlmostEqual(info.K[0], FOCAL_LENGTH / 2, delta=0.01)

    def test_color_and_registration(self):
        with VirtualDevices(device(frames=1)) as devices:
            with devices.driver('plain', '_color_mode:=640x480@30', '_depth_registration:=false'):
                depth = received('plain/depth/image_raw', Image)
                color = received('plain/rgb/image_raw', Image)
                color_info = received('plain/rgb/camera_info', CameraInfo)
            with devices.driver('registered', '_depth_registration:=true'):
                registered = received('registered/depth/image_raw', Image)
        self.assertEqual(depth.header.frame_id, 'plain_depth_optical_frame')
        for message in (color, color_info):
            self.assertEqual(message.header.frame_id, 'plain_rgb_optical_frame')
        self.assertEqual((color.encoding, color.width, color.height, len(color.data)),
                         ('rgb8', 640, 480, 3 * 640 * 480))
        self.assertGreater(len(set(color.data)), 100)
        self.assertEqual(registered.header.frame_id, 'registered_rgb_optical_frame')
        self.assertFalse(numpy.array_equal(pixels(registered), pixels(depth)))
        # The device's own last pixel takes no part: the one beside it stands there, before and after.
        expected = as_the_color_camera_sees(pixels(depth))
        self.assertLessEqual(numpy.count_nonzero(pixels(registered) != expected), 2)

    @measured
    def test_stamps_are_right_after_a_pause_in_which_a_recording_stands(self, measurement):
        with VirtualDevices(device(frames=1)) as devices:
            recording = devices.record('paused.oni', 60)
            with devices.driver('paused', '_device_id:=' + recording, '_playback_loop:=true'):
                for pause in (3, 0):
                    delay = self.delay('paused/depth/image_raw')
                    with measurement.judged():
                        self.assertAlmostEqual(delay, 0.033, delta=0.5)
                    rospy.sleep(pause)

    def delay(self, topic):
        """s, from the stamp of an image to its arrival."""
        images = Listener(topic, Image)
        images.wait()
        images.close()
        image, arrival = images.arrivals()[0]
        return (arrival - image.header.stamp).to_sec()

    def test_two_devices_in_one_process(self):
        loads = [Process('nodelet', 'nodelet', 'load', 'grasp_affordances/XtionNodelet', '/manager',
                         '__ns:=' + name, '__name:=driver', '_camera:=' + name, '_device_id:=' + device_id)
                 for name, device_id in (('first', 'virtual/1'), ('second', 'S2'))]
        devices = VirtualDevices(device('virtual/1', frames=1), device('virtual/2', serial='S2', seed=2, frames=1))
        with devices, manager(environment=devices.environment) as host, loads[0], loads[1]:
            images = [received(name + '/depth/image_raw', Image) for name in ('first', 'second')]
            self.assertEqual([image.header.frame_id for image in images],
                             ['first_depth_optical_frame', 'second_depth_optical_frame'])
            self.assertNotEqual(images[0].data, images[1].data)

            # One of them ends, the other goes on.
            self.assertEqual(loads[0].interrupt(), 0, loads[0].output())
            wait_until(lambda: not advertised('/first/depth/image_raw'), 'unloading')
            self.assertEqual(received('second/depth/image_raw', Image).data, images[1].data)
            self.assertEqual(loads[1].interrupt(), 0, loads[1].output())
            self.assertEqual(host.interrupt(), 0, host.output())


if __name__ == '__main__':
    rospy.init_node('sensor_streams_test')
    rostest.rosrun('grasp_affordances', 'sensor_streams', SensorStreams)
