#!/usr/bin/python3
"""What the driver makes of devices that are pulled out, missing, stalled, or send corrupt frames.
~vanishings: how often a device is pulled out in the middle of a frame."""

import math
import os
import unittest

import rospy
import rostest
from sensor_msgs.msg import Image

from grasp_affordances.msg import CylindricalShellArray, LocalizationStatistics
from helpers import ABNORMAL_ENDS, Listener, measured, wait_until
from virtual_devices import (Diagnostics, VirtualDevices, depth_image_proc_loads, device, openni2_path, pixels,
                             value)

NO_DEPTH = 0xFFFF   # of a garbled frame: beyond all that a device measures
WRONG_SIZES = 8     # kinds of them, which come in turn
TIME_FAULTS = 2 * 24  # frames, in which all kinds come twice


def vector(message):
    return message.x, message.y, message.z


class SensorFaults(unittest.TestCase):

    def check_end(self, driver):
        self.assertEqual(driver.interrupt(), 0, driver.output())
        for sign in ABNORMAL_ENDS:
            self.assertNotIn(sign, driver.output())

    @measured
    def test_unplugged_and_plugged_in_again(self, measurement):
        diagnostics = Diagnostics('unplugged')
        with VirtualDevices(device()) as devices, devices.driver('unplugged') as driver:
            images = Listener('unplugged/depth/image_raw', Image)
            images.wait()
            _, status = diagnostics.wait('connected')
            self.assertEqual((value(status, 'uri'), status.hardware_id), ('virtual/1', 'virtual/1'))

            unplugged = rospy.Time.now()
            devices.write(device(state='unplugged'))
            noticed, status = diagnostics.wait('disconnected', since=unplugged)
            with measurement.judged():
                self.assertLess((noticed - unplugged).to_sec(), 2)
            self.assertEqual(status.level, status.ERROR)

            plugged = rospy.Time.now()
            devices.write(device())
            diagnostics.wait('connected', since=plugged)
            images.wait(lambda image: image.header.stamp > plugged)
            images.close()
            stamps = [image.header.stamp for image in images.messages()]
            self.assertEqual(stamps, sorted(set(stamps)))  # though the device's clock began anew
            self.check_end(driver)
            self.assertEqual(driver.output().count('was disconnected'), 1, driver.output())
        diagnostics.close()

    def test_unplugged_for_good(self):
        diagnostics = Diagnostics('pulled')
        with VirtualDevices(device()) as devices, devices.driver('pulled') as driver:
            images = Listener('pulled/depth/image_raw', Image)
            images.wait()
            devices.write()
            diagnostics.wait('disconnected')
            self.check_end(driver)
            images.close()
        diagnostics.close()

    def test_no_device_at_start_then_one_is_plugged_in(self):
        diagnostics = Diagnostics('late')
        with VirtualDevices() as devices, devices.driver('late') as driver:
            images = Listener('late/depth/image_raw', Image)
            _, status = diagnostics.wait('waiting')
            self.assertEqual(status.level, status.WARN)
            self.assertEqual(images.messages(), [])
            devices.write(device())
            images.wait()
            diagnostics.wait('connected')
            images.close()
            self.check_end(driver)
        diagnostics.close()

    def test_a_runtime_without_drivers_is_told_from_one_without_devices(self):
        diagnostics = Diagnostics('driverless')
        with VirtualDevices(device()) as devices:
            os.symlink(os.path.join(openni2_path(), 'libOpenNI2.so.0'), os.path.join(devices.folder, 'libOpenNI2.so.0'))
            environment = dict(devices.environment, LD_LIBRARY_PATH=devices.folder)
            with devices.driver('driverless', environment=environment) as driver:
                # Also after attempts enough.
                _, status = diagnostics.wait('waiting', since=rospy.Time.now() + rospy.Duration(3))
                self.assertIn('OpenNI2 does not start', status.message)
                self.assertEqual(driver.output().count('OpenNI2 does not start'), 1, driver.output())
                self.check_end(driver)
        diagnostics.close()

    def test_parameters_that_are_set_later_change_nothing(self):
        diagnostics = Diagnostics('steady')
        self.addCleanup(rospy.delete_param, 'steady')
        with VirtualDevices(device()) as devices, devices.driver('steady') as driver:
            images = Listener('steady/depth/image_raw', Image)
            images.wait()
            for period in (1e10, -1e10, 'often'):
                rospy.set_param('steady/driver/diagnostic_period', period)
                since = rospy.Time.now() + rospy.Duration(1.5)
                diagnostics.wait('connected', since=since)
                images.wait(lambda image: image.header.stamp > since)
            images.close()
            self.check_end(driver)
        diagnostics.close()

    @measured
    def test_stalled(self, measurement):
        diagnostics = Diagnostics('stalled')
        with VirtualDevices(device()) as devices, devices.driver('stalled') as driver:
            images = Listener('stalled/depth/image_raw', Image)
            images.wait()
            stalled = rospy.Time.now()
            devices.write(device(state='stalled'))
            noticed, status = diagnostics.wait('stalled', since=stalled)
            with measurement.judged():
                self.assertLess((noticed - stalled).to_sec(), 2)
            self.assertEqual(status.level, status.ERROR)

            resumed = rospy.Time.now()
            devices.write(device())
            images.wait(lambda image: image.header.stamp > resumed)
            diagnostics.wait('connected', since=resumed)
            images.close()
            self.check_end(driver)
        diagnostics.close()

    def check_bad_frames_are_skipped_and_counted(self, state, least):
        diagnostics = Diagnostics(state)
        with VirtualDevices(device(state=state)) as devices, devices.driver(state) as driver:
            images = Listener(state + '/depth/image_raw', Image)

            def counts(status):
                return int(value(status, 'depth corrupt frames')) > least

            _, status = diagnostics.wait('connected', accept=counts)
            self.assertEqual(status.level, status.WARN)
            self.assertEqual(value(status, 'depth frames'), '0')
            self.assertEqual(images.messages(), [])

            devices.write(device())
            image = images.wait()
            self.assertEqual((image.width, image.height, len(image.data)), (640, 480, 2 * 640 * 480))
            images.close()
            self.check_end(driver)
        diagnostics.close()

    def test_corrupt_frames_are_skipped_and_counted(self):
        self.check_bad_frames_are_skipped_and_counted('corrupt', 10)

    def test_frames_of_wrong_sizes_are_skipped_and_counted(self):
        self.check_bad_frames_are_skipped_and_counted('misshapen', 2 * WRONG_SIZES)

    @unittest.skipUnless(depth_image_proc_loads(), 'pluginlib does not find depth_image_proc')
    def test_half_old_frames_and_depths_that_are_none_are_localized_in(self):
        with VirtualDevices(device(state='garbled')) as devices, \
                devices.launch('xtion.launch', 'camera:=garbled', 'openni2_path:=' + openni2_path()) as graph:
            images = Listener('garbled/depth/image_raw', Image)
            image = images.wait()
            self.assertGreater((pixels(image) == NO_DEPTH).sum(), 1000)
            images.close()
            shells = Listener('localizer/shells', CylindricalShellArray)
            statistics = Listener('localizer/statistics', LocalizationStatistics)
            last = statistics.wait(lambda m: m.clouds_processed > 10)
            self.assertEqual(last.clouds_rejected, 0)
            self.assertGreater(last.points, 1000)
            for message in shells.messages():
                for shell in message.shells:
                    self.assertTrue(all(map(math.isfinite, (*vector(shell.centroid), *vector(shell.axis)))), shell)
            for listener in (shells, statistics):
                listener.close()
            self.assertEqual(graph.interrupt(), 0, graph.output())

    @measured
    def test_stamps_ascend_whatever_the_device_says_of_the_time(self, measurement):
        with VirtualDevices(device(state='backwards')) as devices, devices.driver('backwards') as driver:
            images = Listener('backwards/depth/image_raw', Image)
            images.wait(lambda _: len(images.messages()) > TIME_FAULTS)
            images.close()
            arrivals = images.arrivals()
            stamps = [image.header.stamp for image, _ in arrivals]
            self.assertEqual(stamps, sorted(set(stamps)))
            for image, arrival in arrivals:
                age = (arrival - image.header.stamp).to_sec()
                with measurement.judged():
                    self.assertLess(abs(age), 1, stamps)  # what a busy machine takes from node to node
            self.check_end(driver)

    def test_device_that_vanishes_in_the_middle_of_a_frame_again_and_again(self):
        vanishings = rospy.get_param('~vanishings')
        with VirtualDevices(device(state='vanishing')) as devices, devices.driver('vanishing') as driver:
            images = Listener('vanishing/depth/image_raw', Image)
            wait_until(lambda: driver.output().count('was disconnected') >= vanishings, 'vanishing',
                       20 + 2 * vanishings)
            plugged = rospy.Time.now()
            devices.write(device())
            images.wait(lambda image: image.header.stamp > plugged)
            images.close()
            stamps = [image.header.stamp for image in images.messages()]
            self.assertEqual(stamps, sorted(set(stamps)))
            self.assertGreaterEqual(len(stamps), vanishings)
            self.check_end(driver)

    def test_node_ends_while_its_device_vanishes(self):
        with VirtualDevices(device(state='vanishing')) as devices:
            for i in (1, 2, 3):
                with devices.driver('ends') as driver:
                    images = Listener('ends/depth/image_raw', Image)
                    wait_until(lambda: driver.output().count('was disconnected') >= i, 'vanishing')
                    images.close()
                    self.check_end(driver)


if __name__ == '__main__':
    rospy.init_node('sensor_faults_test')
    rostest.rosrun('grasp_affordances', 'sensor_faults', SensorFaults)
