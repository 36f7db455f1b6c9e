#!/usr/bin/python3
"""The localizer under load: clouds that come faster than it works, clouds of 1280x1024, ten subscribers of an output of
which one never reads, and a machine whose cores are busy with other work. ~seconds: to measure in each test."""

import os
import sys
import threading
import time
import unittest

import numpy
import rosgraph
import rospy
import rostest
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Header

from grasp_affordances.msg import LocalizationStatistics
from helpers import (ABNORMAL_ENDS, FREED_MEMORY_IS_KEPT, MEMORY_FACTOR, TIME_FACTOR, Listener, Nodelets, Process, Program,
                     manager, measured, published, publisher, scene, usage, wait_until)
from raw_peers import RawSubscriber

OUTPUTS = ('shells', 'handles', 'hand_poses', 'markers', 'statistics', 'selected', 'selected_pose',
           'handles_interactive/update')
READERS = 9
WARM_UP = 0.3    # share of the time: until everything that is kept has its size
FEWEST = 8       # answers to look at, however long they take
SLACK = 0.5 * TIME_FACTOR  # s, of a machine with more to do than it has cores
SMALL = 4096     # bytes, of a receive buffer


class BusyCores:
    """For every core a process that wants all of it."""

    def __enter__(self):
        self._processes = [Program(sys.executable, '-c', 'while True: pass') for _ in range(os.cpu_count())]
        return self

    def __exit__(self, *_):
        for process in self._processes:
            process.interrupt()


class Subscribers:
    """Nine that read the markers, and one for each output that never reads."""

    def __init__(self, node):
        uri = rosgraph.Master(rospy.get_name()).lookupNode(node)
        self._stuck = [RawSubscriber(uri, '/localizer/' + output, SMALL) for output in OUTPUTS]
        self._readers = [RawSubscriber(uri, '/localizer/markers') for _ in range(READERS)]
        self.read = [0] * READERS
        self._threads = [threading.Thread(target=self._run, args=(i,), daemon=True) for i in range(READERS)]

    def __enter__(self):
        for thread in self._threads:
            thread.start()
        return self

    def __exit__(self, *_):
        for subscriber in self._stuck + self._readers:
            subscriber.close()
        for thread in self._threads:
            thread.join(20)

    def _run(self, i):
        try:
            while True:
                self._readers[i].receive_block()
                self.read[i] += 1
        except OSError:
            pass  # it was closed


class BigClouds:
    """A simulated table as a cloud of 1280x1024, published as fast as this process can, up to a rate."""

    def __init__(self, rate):
        table = published('table')
        xyz = numpy.frombuffer(table.data, numpy.uint8).reshape(table.height, table.width, table.point_step)[..., :12]
        big = numpy.repeat(numpy.repeat(xyz, 2, axis=0), 2, axis=1)
        nothing = numpy.full((1024 - big.shape[0], big.shape[1], 3), numpy.nan, numpy.float32).view(numpy.uint8)
        big = numpy.concatenate((big, nothing))
        self.message = PointCloud2(header=Header(frame_id=table.header.frame_id), height=1024, width=1280,
                                   point_step=12, row_step=12 * 1280, fields=table.fields[:3], data=big.tobytes())
        self._publisher = rospy.Publisher('points', PointCloud2, queue_size=1)
        self._rate = rate
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._stopping.set()
        self._thread.join(20)
        self._publisher.unregister()

    def _run(self):
        while not self._stopping.wait(1 / self._rate):
            self.message.header.stamp = rospy.Time.now()
            self._publisher.publish(self.message)


class Load(unittest.TestCase):
    def setUp(self):
        # Slower than its cameras, and as slow with a sanitizer as without.
        rospy.set_param('localizer', {'threads': 1, 'sampling': {'samples': 10000 // TIME_FACTOR}})

    def tearDown(self):
        for name in ('localizer', 'camera'):
            if rospy.has_param(name):
                rospy.delete_param(name)

    def measure(self, measurement, process, node, megabytes, period=None):
        """While the node is under load: it answers to the end, with the newest clouds, and its memory is flat.
        `period`, s: of clouds that come from the same process, where their way takes no time; of others the ages say
        nothing."""
        seconds = rospy.get_param('~seconds')
        answers = Listener('localizer/statistics', LocalizationStatistics)
        with Subscribers(node) as subscribers:
            answers.wait(lambda m: m.clouds_processed >= 2, timeout=60)
            memory = []
            start = time.monotonic()
            while time.monotonic() < start + seconds or len(answers.messages()) < FEWEST:
                time.sleep(0.1)
                self.assertLess(time.monotonic(), start + seconds + 60 * TIME_FACTOR, 'it answers no more')
                if time.monotonic() > start + WARM_UP * seconds:
                    memory.append(usage(process).memory)
            end = rospy.Time.now()
            arrivals = answers.arrivals()
            # It has not stopped: an answer to a cloud that is newer than all this.
            answers.wait(lambda m: m.header.stamp > end, timeout=20)
            read = list(subscribers.read)
        answers.close()
        self.check_newest_only(arrivals)
        rospy.loginfo('%d answers, %d clouds received, memory %.1f to %.1f MB, %s markers read', len(arrivals),
                      arrivals[-1][0].clouds_received - arrivals[0][0].clouds_received, min(memory), max(memory), read)
        if not FREED_MEMORY_IS_KEPT:
            self.assertLess(max(memory) - min(memory), megabytes * MEMORY_FACTOR)
        with measurement.judged():
            self.check_latency(arrivals, period)
            self.assertGreater(min(read), 0.5 * len(arrivals))

    def check_newest_only(self, arrivals):
        messages = [message for message, _ in arrivals]
        first, last = messages[0], messages[-1]
        self.assertGreater(last.clouds_dropped, first.clouds_dropped)
        for message in messages:
            handled = message.clouds_processed + message.clouds_dropped + message.clouds_rejected
            self.assertIn(message.clouds_received - handled, (0, 1))
            self.assertEqual(message.clouds_rejected, 0)
        for earlier, message in zip(messages, messages[1:]):
            self.assertGreater(message.header.stamp, earlier.header.stamp)

    def check_latency(self, arrivals, period):
        for (earlier, _), (message, arrival) in zip(arrivals, arrivals[1:]):
            # A cloud waits for the localization before it at most, or is replaced by the one that comes a period later.
            work = (earlier.milliseconds_total + message.milliseconds_total) / 1e3
            self.assertLess(message.milliseconds_latency / 1e3, work + SLACK)
            if period:
                self.assertLess((arrival - message.header.stamp).to_sec(), work + period + SLACK)

    def check_clean_end(self, process):
        self.assertEqual(process.interrupt(), 0, process.output())
        for sign in ABNORMAL_ENDS:
            self.assertNotIn(sign, process.output())

    @measured
    def test_camera_of_100_Hz_and_a_slow_localizer_in_one_manager(self, measurement):
        rospy.set_param('camera/camera', {'rate': 100.0, 'motion': 'orbit', 'frames_ahead': 6})
        with manager() as host:
            nodelets = Nodelets()
            nodelets.load('/camera/camera', 'SimulatedCameraNodelet')
            nodelets.load('/localizer', 'LocalizerNodelet', (('/points', '/camera/depth/points'),))
            frames = Listener('camera/depth/points', PointCloud2)
            frames.wait(timeout=60)  # they are rendered
            frames.close()
            with BusyCores():
                self.measure(measurement, host, '/manager', 40, period=1 / 100)
                self.check_clean_end(host)

    @measured
    def test_clouds_of_1280x1024(self, measurement):
        with BigClouds(rate=30) as clouds, Process('grasp_affordances', 'localizer_node') as node:
            wait_until(lambda: '/localizer/statistics' in str(rospy.get_published_topics()), 'start')
            megabytes = len(clouds.message.data) / 1e6
            with BusyCores():
                # Clouds that are received, wait or are worked on come and go.
                self.measure(measurement, node, '/localizer', 4 * megabytes)
                self.check_clean_end(node)

    @measured
    def test_overloaded_node_works_on_the_newest_cloud_and_counts_the_others(self, measurement):
        rate = 20.0
        rospy.delete_param('localizer')
        with publisher(scene('table'), rate), \
                Process('grasp_affordances', 'localizer_node', '_sampling/samples:=20000', '_threads:=1'):
            listener = Listener('localizer/statistics', LocalizationStatistics)
            last = listener.wait(lambda m: m.clouds_processed == 5, timeout=40)
            arrivals = listener.arrivals()
            listener.close()
        self.assertGreater(last.clouds_dropped, 0)
        handled = last.clouds_processed + last.clouds_dropped + last.clouds_rejected
        self.assertIn(last.clouds_received - handled, (0, 1))
        for (earlier, _), (message, arrival) in zip(arrivals, arrivals[1:]):
            self.assertGreater(message.header.stamp, earlier.header.stamp)
            age = (arrival - message.header.stamp).to_sec()
            # From its arrival here, later than its stamp, to a publication earlier than its arrival at this test.
            self.assertLess(message.milliseconds_latency, age * 1e3)
            with measurement.judged():
                # It came at most one period, and the way through the network, before its work began.
                self.assertLess(age, message.milliseconds_total / 1e3 + 1 / rate + 0.3)


if __name__ == '__main__':
    rospy.init_node('load_test')
    rostest.rosrun('grasp_affordances', 'load', Load)
