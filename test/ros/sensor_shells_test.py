#!/usr/bin/python3
"""From a device through OpenNI2 to shells, live and from a recording."""

import unittest

import numpy
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

from grasp_affordances.msg import CylindricalShellArray
from helpers import Listener, wait_until
from virtual_devices import VirtualDevices, device, openni2_path

FRAMES = 3


class Pipeline:
    """What the driver, depth_image_proc and localizer publish, by the content of the depth image."""

    def __init__(self):
        self._images = Listener('camera/depth/image_raw', Image)
        self._shells = Listener('localizer/shells', CylindricalShellArray)

    def close(self):
        self._images.close()
        self._shells.close()

    def shells(self, contents):
        """The shells of that many different depth images, as what was received of both."""
        wait_until(lambda: len(self._answered()) >= contents, '%d different frames with shells' % contents)
        return self._answered()

    def _answered(self):
        arrays = {array.header.stamp: array for array in self._shells.messages()}
        return {image.data: arrays[image.header.stamp] for image in self._images.messages()
                if image.header.stamp in arrays}


class SensorShells(unittest.TestCase):

    def launched(self, devices, *arguments):
        return devices.launch('xtion.launch', 'openni2_path:=' + openni2_path(), *arguments)

    def test_live_frames_and_their_recording_give_the_same_shells(self):
        with VirtualDevices(device(frames=FRAMES)) as devices:
            pipeline = Pipeline()
            with self.launched(devices):
                live = pipeline.shells(FRAMES)
                self.check_cloud()
            pipeline.close()

            recording = devices.record('table.oni', 2 * FRAMES)
            devices.write()
            pipeline = Pipeline()
            with self.launched(devices, 'device_id:=' + recording, 'playback_loop:=true'):
                played = pipeline.shells(FRAMES)
            pipeline.close()
        self.assertEqual(set(played), set(live))
        for data, array in live.items():
            self.assertEqual(array.header.frame_id, 'camera_depth_optical_frame')
            self.assertGreater(len(array.shells), 10)
            self.assertEqual(played[data].shells, array.shells)

    def check_cloud(self):
        """The cloud is the depth image through the camera's projection."""
        listeners = [Listener('camera/depth/image_raw', Image), Listener('camera/depth/points', PointCloud2)]
        cloud = listeners[1].wait(lambda m: any(i.header.stamp == m.header.stamp for i in listeners[0].messages()))
        image = listeners[0].wait(lambda m: m.header.stamp == cloud.header.stamp)
        info = Listener('camera/depth/camera_info', CameraInfo)
        projection = info.wait().P
        for listener in listeners + [info]:
            listener.close()
        depth = numpy.frombuffer(image.data, numpy.uint16).astype(float) / 1000
        points = numpy.frombuffer(cloud.data, numpy.float32).reshape(-1, cloud.point_step // 4)[:, :3]
        measured = depth > 0
        self.assertGreater(numpy.count_nonzero(measured), 100000)
        self.assertTrue(numpy.isnan(points[~measured]).all())
        columns = numpy.tile(numpy.arange(640), 480)
        x = (columns - projection[2]) / projection[0] * depth
        self.assertLess(numpy.abs(points[measured, 0] - x[measured]).max(), 1e-5)
        self.assertLess(numpy.abs(points[measured, 2] - depth[measured]).max(), 1e-6)


if __name__ == '__main__':
    rospy.init_node('sensor_shells_test')
    rostest.rosrun('grasp_affordances', 'sensor_shells', SensorShells)
