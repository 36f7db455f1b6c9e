#!/usr/bin/python3
"""A fixed scene and seed give the recorded shells, through the whole ROS graph.

After a change that is meant to change results: `rostest grasp_affordances golden.test regenerate:=true` records the
shells of today, to be looked at and committed.
"""

import json
import os
import unittest

import rospy
import rostest

from grasp_affordances.msg import CylindricalShellArray
from helpers import Listener, publisher, scene

GOLDEN = os.path.join(os.path.dirname(os.path.realpath(__file__)), 'golden', 'table_seed_1.json')
VECTORS = ('centroid', 'axis', 'normal')
NUMBERS = ('inner_radius', 'thickness', 'length', 'curvature', 'observed_free')
COUNTS = ('points_inside', 'points_in_gap', 'point_index')


def values(shell):
    vectors = {name: [getattr(getattr(shell, name), coordinate) for coordinate in 'xyz'] for name in VECTORS}
    return {**vectors, **{name: getattr(shell, name) for name in NUMBERS + COUNTS}}


class Golden(unittest.TestCase):
    def test_shells(self):
        listener = Listener('localizer/shells', CylindricalShellArray)
        with publisher(scene('table')):
            shells = [values(shell) for shell in listener.wait().shells]
        if rospy.get_param('~regenerate', False):
            with open(GOLDEN, 'w') as file:
                file.write('[' + ',\n '.join(json.dumps(shell) for shell in shells) + ']\n')

        with open(GOLDEN) as file:
            golden = json.load(file)
        self.assertGreater(len(golden), 0)
        self.assertEqual([shell['point_index'] for shell in shells], [shell['point_index'] for shell in golden])
        for shell, recorded in zip(shells, golden):
            for name in VECTORS:
                for value, expected in zip(shell[name], recorded[name]):
                    self.assertAlmostEqual(value, expected, delta=1e-6, msg=name)
            for name in NUMBERS:
                # Curvature, in 1/m, is of the order of 100.
                self.assertAlmostEqual(shell[name], recorded[name], delta=1e-6 * max(1, abs(recorded[name])), msg=name)
            for name in COUNTS:
                self.assertEqual(shell[name], recorded[name], name)


if __name__ == '__main__':
    rospy.init_node('golden_test')
    rostest.rosrun('grasp_affordances', 'golden', Golden)
