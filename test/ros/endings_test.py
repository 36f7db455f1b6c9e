#!/usr/bin/python3
"""Ends in the middle of a frame, by all the ways a node is ended, and a node whose master goes away.
~repetitions: of the ends of a node and of a nodelet."""

import os
import signal
import socket
import struct
import threading
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest

from grasp_affordances.msg import LocalizationStatistics
from grasp_affordances.srv import Localize
from helpers import (ABNORMAL_ENDS, Nodelets, Process, Program, manager, others_subscribed_to, processor_time,
                     published, publisher, scene, wait_until)
from raw_peers import RawCaller, RawSubscriber

LONG_FRAMES = {'sampling': {'samples': 1000000}, 'lazy': False}  # each of some ten seconds
LIMIT = 2  # s that an end may take
SLACK = 3  # s, of a busy machine
NO_CHANGES = struct.pack('<5I', 0, 0, 0, 0, 0)  # a call of dynamic_reconfigure, in bytes


def by_signal(number):
    return lambda process: process.signal(number)


def by_call(_):
    """As rosnode kill does."""
    uri = rosgraph.Master(rospy.get_name()).lookupNode('/localizer')
    xmlrpc.client.ServerProxy(uri).shutdown('/test', 'for a test')


# roscpp leaves SIGTERM alone: our nodes take it, too.
ENDS = ((by_signal(signal.SIGINT), (0,)), (by_call, (0,)), (by_signal(signal.SIGTERM), (0,)))


class Master:
    """A master beside that of this test, which may go away."""

    def __init__(self):
        with socket.socket() as free:
            free.bind(('127.0.0.1', 0))
            self._port = free.getsockname()[1]
        uri = 'http://127.0.0.1:%d' % self._port
        self.environment = dict(os.environ, ROS_MASTER_URI=uri)
        self.graph = rosgraph.Master('/endings_test', uri)
        self._start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.interrupt()

    def _start(self):
        self._process = Program('rosmaster', '--core', '-p', str(self._port), environment=self.environment)
        wait_until(self.graph.is_online, 'master')

    def goes_away(self):
        self._process.signal(signal.SIGKILL)
        self._process.wait(15)

    def comes_back(self):
        """Another one, that knows nothing."""
        self._start()

    def knows(self, node):
        try:
            return bool(self.graph.lookupNode(node))
        except rosgraph.MasterError:
            return False


class Endings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = published('table')

    def setUp(self):
        rospy.set_param('localizer', LONG_FRAMES)

    def tearDown(self):
        if rospy.has_param('localizer'):
            rospy.delete_param('localizer')

    @staticmethod
    def subscribes(process):
        """Whether that process and no earlier one of the same name is known to subscribe to clouds."""
        if not others_subscribed_to('/points'):
            return False
        try:
            uri = rosgraph.Master(rospy.get_name()).lookupNode('/localizer')
            return xmlrpc.client.ServerProxy(uri).getPid('/test')[2] == process.pid
        except (OSError, rosgraph.MasterError):
            return False

    def work_on_a_frame(self, process):
        """Until it does: it then takes more of the processor than a start does. A frame takes much longer than this."""
        start = processor_time(process)
        wait_until(lambda: processor_time(process) > start + 0.5, 'work on a frame')

    def check_end(self, process, start, codes=(0,)):
        self.assertIn(process.wait(15), codes, process.output())
        self.assertLess(time.monotonic() - start, LIMIT + SLACK, process.output())
        for sign in ABNORMAL_ENDS:
            self.assertNotIn(sign, process.output())

    def test_of_a_node_in_the_middle_of_a_frame(self):
        with publisher(scene('table'), rate=10):
            for repetition in range(rospy.get_param('~repetitions')):
                for threads, (end, codes) in zip((1, 0, 2), ENDS):
                    with Process('grasp_affordances', 'localizer_node', '_threads:=%d' % threads) as node:
                        wait_until(lambda: self.subscribes(node), 'start')
                        self.work_on_a_frame(node)
                        start = time.monotonic()
                        end(node)
                        self.check_end(node, start, codes)
                        rospy.loginfo('end %d took %.3f s', repetition, time.monotonic() - start)

    def test_of_a_nodelet_in_the_middle_of_a_frame(self):
        with publisher(scene('table'), rate=10), manager() as host:
            nodelets = Nodelets()
            for _ in range(rospy.get_param('~repetitions')):
                nodelets.load('/localizer', 'LocalizerNodelet')
                self.work_on_a_frame(host)
                start = time.monotonic()
                nodelets.unload('/localizer')
                self.assertLess(time.monotonic() - start, LIMIT + SLACK)
            nodelets.load('/localizer', 'LocalizerNodelet')
            self.work_on_a_frame(host)
            start = time.monotonic()
            host.signal(signal.SIGINT)
            self.check_end(host, start)

    def test_in_the_middle_of_a_call(self):
        with Process('grasp_affordances', 'localizer_node') as node:
            rospy.wait_for_service('localizer/localize', 20)
            answers = []

            def call():
                try:
                    answers.append(rospy.ServiceProxy('localizer/localize', Localize)(cloud=self.table))
                except (rospy.ServiceException, rospy.exceptions.ROSException) as error:
                    answers.append(error)

            caller = threading.Thread(target=call, daemon=True)
            caller.start()
            self.work_on_a_frame(node)
            self.assertEqual(answers, [])
            start = time.monotonic()
            node.signal(signal.SIGINT)
            self.check_end(node, start)
            caller.join(20)
            self.assertTrue(isinstance(answers[0], Exception) or not answers[0].success, answers)

    def test_without_a_master_that_connected_peers_do_not_miss(self):
        with Master() as master:
            node = Process('grasp_affordances', 'localizer_node', environment=master.environment)
            camera = Process('grasp_affordances', 'pcd_publisher', '_file:=' + scene('table'),
                             environment=master.environment)
            with node, camera:
                wait_until(lambda: master.knows('/localizer'), 'node')
                wait_until(lambda: {'/localizer/select', '/localizer/reconfigure/set_parameters'} <=
                           {name for name, _ in master.graph.getSystemState()[2]}, 'services')
                uri = master.graph.lookupNode('/localizer')
                services = {name: master.graph.lookupService('/localizer/' + name)
                            for name in ('select', 'reconfigure/set_parameters')}
                with RawSubscriber(uri, '/localizer/statistics') as statistics:
                    before = statistics.message(LocalizationStatistics)
                    master.goes_away()
                    # Who is connected is answered as before, and so is who knows the node's address.
                    for _ in range(10):
                        after = statistics.message(LocalizationStatistics)
                    self.assertGreaterEqual(after.clouds_processed, before.clouds_processed + 10)
                    with RawSubscriber(uri, '/localizer/handles') as handles:
                        handles.receive_block()
                    with RawCaller(services['select'], '/localizer/select') as caller:
                        caller.ask(struct.pack('<I', 0))
                        caller.receive_block()
                    # roscpp registers with a master once: another one at the same address never hears of the node.
                    master.comes_back()
                    for _ in range(10):
                        statistics.message(LocalizationStatistics)
                    self.assertFalse(master.knows('/localizer'))
                    master.goes_away()
                    # A call that changes parameters writes them to the master and waits for it: the end does not.
                    with RawCaller(services['reconfigure/set_parameters'], '/localizer/reconfigure/set_parameters') as \
                            caller:
                        caller.ask(NO_CHANGES)
                        statistics.message(LocalizationStatistics)
                        start = time.monotonic()
                        for process in (node, camera):
                            process.signal(signal.SIGINT)
                        for process in (node, camera):
                            self.check_end(process, start)
                        rospy.loginfo('the end without a master took %.3f s', time.monotonic() - start)


if __name__ == '__main__':
    rospy.init_node('endings_test')
    rostest.rosrun('grasp_affordances', 'endings', Endings)
