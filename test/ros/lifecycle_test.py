#!/usr/bin/python3
"""Start, refusal to start and end of the localizer, as a plain node and as a nodelet."""

import contextlib
import os
import re
import signal
import time
import unittest

import rosgraph
import rospy
import rostest
from sensor_msgs.msg import Image, PointCloud2

from grasp_affordances.msg import LocalizationStatistics
from grasp_affordances.srv import LocalizeNext
from helpers import ABNORMAL_ENDS, Listener, Process, cloud, manager, publisher, scene, wait_until

BAD_PARAMETERS = (('hand/capture_radius', 0.7, '[0.002, 0.5] m'),
                  ('sampling/samples', 12.5, 'an integer in [1, 1000000]'),
                  ('estimation/estimator', 'taubing', 'taubing'),
                  ('shell/min_lenght', 0.03, 'unknown name'))


def localizer(*arguments):
    return Process('grasp_affordances', 'localizer_node', *arguments)


def loader(*options):
    """Loads the localizer into the manager, stays, and unloads it when it is interrupted."""
    return Process('nodelet', 'nodelet', 'load', 'grasp_affordances/LocalizerNodelet', 'manager', *options,
                   '__name:=localizer')


def advertised():
    return 'localizer/statistics' in str(rospy.get_published_topics())


class Lifecycle(unittest.TestCase):
    def setUp(self):
        self.clear_parameters()

    def tearDown(self):
        self.clear_parameters()

    @staticmethod
    def clear_parameters():
        if rospy.has_param('localizer'):
            rospy.delete_param('localizer')

    def check_answers(self):
        """A cloud is answered by whoever is the localizer now."""
        listener = Listener('localizer/statistics', LocalizationStatistics)
        self.assertGreater(listener.wait().sampled, 0)
        listener.close()

    def check_clean_end(self, process):
        self.assertEqual(process.interrupt(), 0, process.output())
        for sign in ABNORMAL_ENDS:
            self.assertNotIn(sign, process.output())

    def test_nodelet_unloads_reloads_and_its_manager_exits_cleanly(self):
        with publisher(scene('table'), rate=10), manager() as host:
            for _ in range(2):
                with loader() as load:
                    self.check_answers()
                    self.assertEqual(load.interrupt(), 0, load.output())
                wait_until(lambda: not advertised(), 'unloading')
            # A bond that is still forming, about a second long, makes nodelet's Loader crash when it is destroyed.
            with loader('--no-bond'):
                listener = Listener('localizer/statistics', LocalizationStatistics)
                listener.wait()
                self.check_clean_end(host)  # while it is at work
                listener.close()

    def test_node_exits_cleanly(self):
        with publisher(scene('table'), rate=10), localizer() as node:
            listener = Listener('localizer/statistics', LocalizationStatistics)
            listener.wait()
            self.check_clean_end(node)
            listener.close()

    def test_node_ends_without_a_crash_when_it_is_interrupted_while_it_starts(self):
        for step in range(15):
            with localizer() as node:
                time.sleep(0.05 * step)  # from before its first line to after its last topic
                self.assertIn(node.interrupt(), (0, -signal.SIGINT), node.output())

    def test_node_waits_for_a_master_until_it_is_interrupted(self):
        environment = dict(os.environ, ROS_MASTER_URI='http://127.0.0.1:9')  # where nobody listens
        with Process('grasp_affordances', 'localizer_node', environment=environment) as node:
            wait_until(lambda: 'waits for the master at http://127.0.0.1:9' in node.output(), 'a complaint')
            self.check_clean_end(node)

    def test_node_refuses_bad_parameters(self):
        for name, value, text in BAD_PARAMETERS:
            with localizer('_%s:=%s' % (name, value)) as node:
                self.assertEqual(node.wait(15), 1, node.output())
                for part in (name, str(value), text):
                    self.assertIn(part, node.output())
            self.clear_parameters()

    def test_nodelet_refuses_bad_parameters_and_its_manager_lives_on(self):
        with publisher(scene('table'), rate=10), manager() as host:
            for name, value, text in BAD_PARAMETERS:
                rospy.set_param('localizer/' + name, value)
                with loader() as load:
                    self.assertNotEqual(load.wait(15), 0)
                self.assertFalse(advertised())
                for part in (name, str(value), text):
                    self.assertIn(part, host.output())
                self.clear_parameters()
            with loader():
                self.check_answers()

    def test_an_input_that_cannot_be_subscribed_to_ends_no_other_nodelet(self):
        with publisher(scene('table'), rate=10), manager() as host:
            # One topic for clouds and for the camera's intrinsics.
            with loader('points:=camera_info') as load:
                listener = Listener('localizer/statistics', LocalizationStatistics)
                wait_until(lambda: 'for want of input' in host.output(), 'complaint')
                listener.close()
                answer = rospy.ServiceProxy('localizer/trigger', LocalizeNext)(timeout=60)
                self.assertIn('no clouds can be had', answer.message)
                self.assertEqual(load.interrupt(), 0, load.output())
            wait_until(lambda: not advertised(), 'unloading')
            with loader():
                self.check_answers()

    def test_publisher_refuses_a_file_that_is_not_there(self):
        with publisher('/nowhere/cloud.pcd') as node:
            self.assertEqual(node.wait(15), 1)
            self.assertIn('/nowhere/cloud.pcd', node.output())

    def test_publisher_refuses_bad_parameters(self):
        for name, value, text in (('rate', -1, '[0, 1000] Hz'), ('rate', 'fast', '[0, 1000] Hz'),
                                  ('rate', 1e-12, '[0.001, 1000] Hz'),
                                  ('frame_id', 5, 'the name of a frame'), ('rat', 3, 'unknown name')):
            with Process('grasp_affordances', 'pcd_publisher', '_file:=' + scene('table'),
                         '_%s:=%s' % (name, value)) as node:
                self.assertEqual(node.wait(15), 1, node.output())
                for part in ('~' + name, str(value), text):
                    self.assertIn(part, node.output())
            rospy.delete_param('pcd_publisher')

    def test_says_why_no_clouds_arrive(self):
        clouds = {topic: rospy.Publisher(topic, PointCloud2, queue_size=1, latch=topic == 'once')
                  for topic in ('elsewhere', 'mute', 'once', 'slow')}
        image = rospy.Publisher('pictures', Image, queue_size=1)
        master = rosgraph.Master('/ghost')
        nobody = 'http://127.0.0.1:9/'
        master.registerPublisher('/haunted', 'sensor_msgs/PointCloud2', nobody)
        clouds['once'].publish(cloud())
        reasons = {'nowhere': r'nobody publishes there; topics with clouds: [^)]*/elsewhere\b',
                   'pictures': r'its type is sensor_msgs/Image, published by %s, but sensor_msgs/PointCloud2 is '
                               r'needed; topics with clouds: [^)]*/elsewhere\b' % rospy.get_name(),
                   'haunted': r'registered but not connected: /ghost; is it alive, is ROS_IP/ROS_HOSTNAME right\?\)',
                   'mute': r'its publisher %s sends nothing\)' % rospy.get_name()}
        with contextlib.ExitStack() as nodes:
            outputs = {topic: nodes.enter_context(localizer('__name:=on_' + topic, 'points:=' + topic, '_lazy:=false'))
                       for topic in (*reasons, 'once', 'slow')}
            wait_until(lambda: clouds['slow'].get_num_connections() == 1, 'connection')
            clouds['slow'].publish(cloud())
            time.sleep(4)
            clouds['slow'].publish(cloud())
            for topic, reason in reasons.items():
                complaint = r'no clouds arrive on /%s, none came in \d+ s \(%s' % (topic, reason)
                wait_until(lambda: re.search(complaint, outputs[topic].output()), complaint)
            # One cloud may be all that there is, and some cameras send few.
            time.sleep(7)
            for topic in ('once', 'slow'):
                self.assertNotIn('no clouds arrive', outputs[topic].output())
        master.unregisterPublisher('/haunted', nobody)
        for topic in (image, *clouds.values()):
            topic.unregister()

    def test_says_when_a_driver_stops_and_when_it_dies(self):
        with publisher(scene('table'), rate=5) as driver, localizer() as node:
            listener = Listener('localizer/statistics', LocalizationStatistics)
            wait_until(lambda: len(listener.messages()) > 5, 'answers')
            complaint = r'no clouds arrive on /points, the last one came ([5-9]|1\d) s ago \(%s'
            silent = complaint % r'its publisher /pcd_publisher sends nothing\)'
            driver.signal(signal.SIGSTOP)
            wait_until(lambda: re.search(silent, node.output()), silent)
            dead = complaint % 'registered but not connected: /pcd_publisher; is it alive'
            driver.signal(signal.SIGKILL)
            wait_until(lambda: re.search(dead, node.output()), dead)
            listener.close()
        master = rosgraph.Master('/pcd_publisher')
        master.unregisterPublisher('/points', master.lookupNode('/pcd_publisher'))

    def test_eager_node_subscribes_without_a_listener(self):
        with localizer('_lazy:=false'):
            wait_until(lambda: '/points' in str(rosgraph.Master(rospy.get_name()).getSystemState()[1]), 'subscription')


if __name__ == '__main__':
    rospy.init_node('lifecycle_test')
    rostest.rosrun('grasp_affordances', 'lifecycle', Lifecycle)
