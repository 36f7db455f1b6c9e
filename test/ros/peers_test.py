#!/usr/bin/python3
"""Peers that behave badly: callers that vanish, calls while the nodelet is unloaded, bursts of clouds of all kinds of
malformedness."""

import copy
import math
import struct
import threading
import time
import unittest

import numpy
import rosgraph
import rospy
import rostest
from sensor_msgs.msg import PointCloud2, PointField

from grasp_affordances.msg import CylindricalShellArray, LocalizationStatistics
from grasp_affordances.srv import Localize, LocalizeNext, LocalizeNextRequest, LocalizeRequest
from helpers import (ABNORMAL_ENDS, TIME_FACTOR, Listener, Nodelets, Process, cloud, coordinates, manager,
                     others_subscribed_to, published, publisher, scene, serialized, wait_until)
from raw_peers import RawCaller, connections_to

SLACK = 3 * TIME_FACTOR  # s, of a busy machine
HUGE = 2 ** 32 - 1


def changed(message, **fields):
    result = copy.deepcopy(message)
    for name, value in fields.items():
        setattr(result, name, value)
    return result


def with_fields(message, *fields):
    """`fields`: (name, offset, datatype, count) of each."""
    return changed(message, fields=[PointField(*field) for field in fields])


def unusable(good):
    """Clouds that hold no coordinates or contradict themselves."""
    f32, f64 = PointField.FLOAT32, PointField.FLOAT64
    x, y, z = (('xyz'[i], 4 * i, f32, 1) for i in range(3))
    return {'big-endian': changed(good, is_bigendian=True),
            'no fields': with_fields(good),
            'no x': with_fields(good, y, z),
            'no y': with_fields(good, x, z),
            'no z': with_fields(good, x, y),
            'integers': with_fields(good, ('x', 0, PointField.INT32, 1), y, z),
            'an unknown type': with_fields(good, ('x', 0, 77, 1), y, z),
            'a field beyond the point': with_fields(good, x, y, ('z', 10, f32, 1)),
            'a field far beyond the point': with_fields(good, x, y, ('z', HUGE - 1, f32, 1)),
            'doubles beyond the point': with_fields(good, x, y, ('z', 8, f64, 1)),
            'row step too small': changed(good, row_step=good.row_step - 1, data=good.data + b'\0'),
            'row step 0': changed(good, row_step=0, data=good.data + b'\0'),
            'row step huge': changed(good, row_step=HUGE, data=good.data + b'\0'),
            'point step 0': changed(good, point_step=0),
            'point step huge': changed(good, point_step=HUGE),
            'data too short': changed(good, data=good.data[:-1]),
            'no data': changed(good, data=b''),
            'width huge': changed(good, width=HUGE),
            'all huge': changed(good, width=HUGE, height=HUGE, point_step=HUGE, row_step=HUGE)}


def points(values, like):
    data = numpy.asarray(values, numpy.float32)
    return changed(like, width=data.shape[1], height=data.shape[0], point_step=12, row_step=12 * data.shape[1],
                   data=data.tobytes())


def strange(table):
    """Clouds that are well-formed, of points as no camera sends them."""
    xyz = numpy.array(coordinates(table), numpy.float32).reshape(table.height, table.width, 3)
    small = xyz[::8, ::8]
    like = with_fields(table, *(('xyz'[i], 4 * i, PointField.FLOAT32, 1) for i in range(3)))
    random = numpy.random.default_rng(1)
    extremes = numpy.float32([numpy.inf, -numpy.inf, 1e30, -1e30, 1e-42, 3e38, 0, numpy.nan])
    return {'empty': points(numpy.zeros((1, 0, 3)), like),
            'nothing measured': points(numpy.full(small.shape, numpy.nan), like),
            'zeros': points(numpy.zeros(small.shape), like),
            'zeros where nothing was measured': points(numpy.nan_to_num(xyz), like),
            'equal points': points(numpy.full(small.shape, 0.5), like),
            'behind the sensor': points(-small, like),
            'turned out of the optical frame': points(xyz[..., [2, 0, 1]] * [1, -1, -1], like),
            'on one line': points(numpy.multiply.outer(numpy.linspace(0.1, 2, 300), [[0, 0, 1]]), like),
            'extremes': points(random.choice(extremes, small.shape), like),
            'extremes among points': points(numpy.where(random.random(xyz.shape) < 0.01, random.choice(
                extremes, xyz.shape), xyz), like)}


def finite(message):
    """Whether all poses and vectors of shells are, but for the normals where the place of the sensor is not known."""
    def numbers(part, names='xyz'):
        return [getattr(part, name) for name in names]
    return all(math.isfinite(number) for shell in message.shells for number in (
        numbers(shell.centroid) + numbers(shell.axis) + numbers(shell.pose.position) +
        numbers(shell.pose.orientation, 'xyzw'))) and all(
        len({math.isfinite(number) for number in numbers(shell.normal)}) == 1 for shell in message.shells)


class Peers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = published('table')

    def setUp(self):
        if rospy.has_param('localizer'):
            rospy.delete_param('localizer')

    def check_clean_end(self, process):
        start = time.monotonic()
        self.assertEqual(process.interrupt(), 0, process.output())
        self.assertLess(time.monotonic() - start, 2 + SLACK)
        for sign in ABNORMAL_ENDS:
            self.assertNotIn(sign, process.output())

    def test_callers_that_vanish(self):
        request = serialized(LocalizeRequest(cloud=self.table))
        waiting = serialized(LocalizeNextRequest(timeout=3600))
        with Process('grasp_affordances', 'localizer_node') as node:
            for service in ('localize', 'trigger'):
                rospy.wait_for_service('localizer/' + service, 20)
            localize = rospy.ServiceProxy('localizer/localize', Localize)
            trigger = rospy.ServiceProxy('localizer/trigger', LocalizeNext)

            def check_answers():
                self.assertTrue(localize(cloud=self.table).success)
                with publisher(scene('table'), rate=10):
                    answer = trigger(timeout=20)
                self.assertTrue(answer.success, answer.message)

            check_answers()
            wait_until(lambda: not others_subscribed_to('/points'), 'end of the subscription')
            addresses = {name: rosgraph.Master(rospy.get_name()).lookupService('/localizer/' + name)
                         for name in ('localize', 'trigger')}
            before = connections_to(addresses['localize'])

            def caller(name):
                return RawCaller(addresses[name], '/localizer/' + name)

            for leave in (RawCaller.close, RawCaller.reset):
                for size in (0, 1000, len(request) // 2):  # in the middle of the request
                    vanishing = caller('localize')
                    vanishing.send(struct.pack('<I', len(request)) + request[:size])
                    leave(vanishing)
                for delay in (0.0, 0.01, 0.1):  # while it is answered
                    vanishing = caller('localize')
                    vanishing.ask(request)
                    time.sleep(delay)
                    leave(vanishing)
                vanishing = caller('trigger')  # while it waits for a cloud
                vanishing.ask(waiting)
                time.sleep(0.1)
                leave(vanishing)
                vanishing = caller('localize')  # one that asks and never reads, while others are answered
                vanishing.ask(request)
                # The call that waits for a cloud is given one, though nobody waits for the answer any more.
                check_answers()
                leave(vanishing)
            wait_until(lambda: connections_to(addresses['localize']) <= before, 'end of the connections')
            self.check_clean_end(node)

    def test_calls_while_the_nodelet_is_unloaded(self):
        stopping = threading.Event()
        answered, longest = [0, 0], [0.0, 0.0]

        def call(i, name, kind, **request):
            while not stopping.is_set():
                start = time.monotonic()
                try:
                    rospy.ServiceProxy('localizer/' + name, kind)(**request)
                    answered[i] += 1
                except (rospy.ServiceException, rospy.exceptions.ROSException,
                        rospy.exceptions.ROSInternalException):  # the connection has ended
                    stopping.wait(0.01)
                longest[i] = max(longest[i], time.monotonic() - start)

        calls = [threading.Thread(target=call, args=(0, 'localize', Localize), kwargs={'cloud': self.table}),
                 threading.Thread(target=call, args=(1, 'trigger', LocalizeNext), kwargs={'timeout': 60})]
        with publisher(scene('table'), rate=10), manager() as host:
            nodelets = Nodelets()
            for thread in calls:
                thread.daemon = True
                thread.start()
            for _ in range(8):
                seen = list(answered)
                nodelets.load('/localizer', 'LocalizerNodelet')
                wait_until(lambda: all(now > then for now, then in zip(answered, seen)), 'answers')
                start = time.monotonic()
                nodelets.unload('/localizer')
                self.assertLess(time.monotonic() - start, 2 + SLACK)
            stopping.set()
            for thread in calls:
                thread.join(2 + SLACK)
                self.assertFalse(thread.is_alive())
            self.assertLess(max(longest), 2 + SLACK)
            self.check_clean_end(host)

    def test_bursts_of_bad_clouds(self):
        with Process('grasp_affordances', 'localizer_node') as node:
            outputs = {name: Listener('localizer/' + name, kind) for name, kind in
                       (('statistics', LocalizationStatistics), ('shells', CylindricalShellArray))}
            for listener in outputs.values():
                self.addCleanup(listener.close)
            clouds = rospy.Publisher('points', PointCloud2, queue_size=100)
            wait_until(lambda: clouds.get_num_connections() == 1, 'connection')
            good = cloud(width=64, height=48)
            published_clouds, rejected, expected = 0, 0, None
            refused = unusable(good)
            for name, bad in {**refused, **strange(self.table)}.items():
                for i in range(5):
                    bad.header.stamp = rospy.Time.now()
                    clouds.publish(bad)
                    if i == 0:  # else a slow node may find it superseded
                        time.sleep(0.1 * TIME_FACTOR)
                table = copy.copy(self.table)
                table.header = copy.copy(self.table.header)
                table.header.stamp = rospy.Time.now()
                clouds.publish(table)
                published_clouds += 6
                statistics = outputs['statistics'].wait(lambda m: m.header.stamp == table.header.stamp)
                found = outputs['shells'].wait(lambda m: m.header.stamp == table.header.stamp)
                self.assertGreater(len(found.shells), 50, name)
                # Of what came before it nothing is left in what a good cloud gives.
                now = [serialized(shell) for shell in found.shells]
                expected = expected or now
                self.assertEqual(now, expected, name)
                self.assertLessEqual(statistics.clouds_received, published_clouds, name)
                self.assertEqual(statistics.clouds_received, statistics.clouds_processed + statistics.clouds_dropped +
                                 statistics.clouds_rejected, name)
                self.assertEqual(statistics.clouds_rejected > rejected, name in refused, name)
                rejected = statistics.clouds_rejected
            self.assertTrue(all(finite(message) for message in outputs['shells'].messages()))
            self.assertEqual(node.interrupt(), 0, node.output())
            for sign in ABNORMAL_ENDS[:-1]:  # the rejections are errors
                self.assertNotIn(sign, node.output())


if __name__ == '__main__':
    rospy.init_node('peers_test')
    rostest.rosrun('grasp_affordances', 'peers', Peers)
