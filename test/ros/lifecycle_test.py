#!/usr/bin/python3
"""Start, refusal to start and end of the localizer, as a plain node and as a nodelet."""

import os
import signal
import time
import unittest

import rosgraph
import rospy
import rostest

from grasp_affordances.msg import LocalizationStatistics
from grasp_affordances.srv import LocalizeNext
from helpers import ABNORMAL_ENDS, Listener, Process, manager, publisher, scene, wait_until

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
        listener = Listener('localizer/statistics', LocalizationStatistics)
        with publisher(scene('table'), rate=5, topic='elsewhere'), localizer() as node:
            complaint = 'no clouds arrive on /points (nobody publishes there; topics with clouds: /elsewhere)'
            wait_until(lambda: complaint in node.output(), 'complaint')
        with publisher(scene('table')), localizer() as node:
            listener.wait()
            # One cloud may be all that there is.
            time.sleep(6)
            self.assertNotIn('no clouds arrive', node.output())
        listener.close()

    def test_eager_node_subscribes_without_a_listener(self):
        with localizer('_lazy:=false'):
            wait_until(lambda: '/points' in str(rosgraph.Master(rospy.get_name()).getSystemState()[1]), 'subscription')


if __name__ == '__main__':
    rospy.init_node('lifecycle_test')
    rostest.rosrun('grasp_affordances', 'lifecycle', Lifecycle)
