#!/usr/bin/python3
"""What the driver makes of devices that are pulled out, missing, stalled, or send corrupt frames."""

import unittest

import rospy
import rostest
from sensor_msgs.msg import Image

from helpers import ABNORMAL_ENDS, Listener
from virtual_devices import Diagnostics, VirtualDevices, device, value


class SensorFaults(unittest.TestCase):

    def check_end(self, driver):
        self.assertEqual(driver.interrupt(), 0, driver.output())
        for sign in ABNORMAL_ENDS:
            self.assertNotIn(sign, driver.output())

    def test_unplugged_and_plugged_in_again(self):
        diagnostics = Diagnostics('unplugged')
        with VirtualDevices(device()) as devices, devices.driver('unplugged') as driver:
            images = Listener('unplugged/depth/image_raw', Image)
            images.wait()
            _, status = diagnostics.wait('connected')
            self.assertEqual((value(status, 'uri'), status.hardware_id), ('virtual/1', 'virtual/1'))

            unplugged = rospy.Time.now()
            devices.write(device(state='unplugged'))
            noticed, status = diagnostics.wait('disconnected', since=unplugged)
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

    def test_stalled(self):
        diagnostics = Diagnostics('stalled')
        with VirtualDevices(device()) as devices, devices.driver('stalled') as driver:
            images = Listener('stalled/depth/image_raw', Image)
            images.wait()
            stalled = rospy.Time.now()
            devices.write(device(state='stalled'))
            noticed, status = diagnostics.wait('stalled', since=stalled)
            self.assertLess((noticed - stalled).to_sec(), 2)
            self.assertEqual(status.level, status.ERROR)

            resumed = rospy.Time.now()
            devices.write(device())
            images.wait(lambda image: image.header.stamp > resumed)
            diagnostics.wait('connected', since=resumed)
            images.close()
            self.check_end(driver)
        diagnostics.close()

    def test_corrupt_frames_are_skipped_and_counted(self):
        diagnostics = Diagnostics('corrupt')
        with VirtualDevices(device(state='corrupt')) as devices, devices.driver('corrupt') as driver:
            images = Listener('corrupt/depth/image_raw', Image)

            def counts(status):
                return int(value(status, 'depth corrupt frames')) > 10

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


if __name__ == '__main__':
    rospy.init_node('sensor_faults_test')
    rostest.rosrun('grasp_affordances', 'sensor_faults', SensorFaults)
