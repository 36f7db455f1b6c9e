#!/usr/bin/python3
"""Parameters that change at run time, of the localizer and of the one with several cameras."""

import threading
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.msg import Config
from sensor_msgs.msg import PointCloud2

from grasp_affordances.msg import CylindricalShellArray, LocalizationStatistics
from helpers import ABNORMAL_ENDS, Listener, Process, coordinates, publisher, scene, serialized, wait_until

TIMEOUT = 20


def localizer(*parameters):
    return Process('grasp_affordances', 'localizer_node', *parameters)


def client(node='localizer'):
    return Client(node + '/reconfigure', timeout=TIMEOUT)


def clear_parameters():
    for name in ('localizer', 'multi_camera'):
        if rospy.has_param(name):
            rospy.delete_param(name)


class Reconfigure(unittest.TestCase):
    def setUp(self):
        clear_parameters()

    def tearDown(self):
        clear_parameters()

    def test_values_are_those_that_the_node_was_started_with(self):
        with localizer('_preset:=paper', '_hand/capture_radius:=0.1234567890123', '_sampling/seed:=7',
                       '_estimation/estimator:=pca'):
            values = client().get_configuration()
        self.assertEqual(values['hand_capture_radius'], 0.1234567890123)
        self.assertEqual(values['sampling_seed'], 7)
        self.assertEqual(values['estimation_estimator'], 'pca')
        self.assertEqual(values['occlusion_max_points_in_front'], 20)  # of the preset
        self.assertEqual(values['shell_measure_length'], False)
        self.assertNotIn('preset', values)

    def test_a_restart_begins_with_the_parameters_of_the_node(self):
        with localizer('_sampling/samples:=500'):
            self.assertEqual(client().update_configuration({'sampling_samples': 600})['sampling_samples'], 600)
        self.assertEqual(rospy.get_param('localizer/reconfigure/sampling_samples'), 600)
        with localizer() as node:
            self.assertEqual(client().get_configuration()['sampling_samples'], 500)
            self.assertEqual(node.interrupt(), 0, node.output())

    def test_changes_hold_from_the_next_cloud_on(self):
        with localizer('_sampling/samples:=500'), publisher(scene('table'), rate=5):
            tuner = client()
            statistics = Listener('localizer/statistics', LocalizationStatistics)
            self.assertEqual(statistics.wait().sampled, 500)
            tuner.update_configuration({'sampling_samples': 700, 'threads': 1})
            changed = statistics.wait(lambda m: m.sampled != 500)
            self.assertEqual((changed.sampled, changed.threads), (700, 1))
            tuner.update_configuration({'estimation_estimator': 'normals', 'sampling_seed': 3000000000.0})
            changed = statistics.wait(lambda m: m.estimator != 'taubin')
            self.assertEqual((changed.estimator, changed.seed, changed.sampled), ('normals', 3000000000, 700))

            # Nothing on the table is thinner than 4 mm.
            tuner.update_configuration({'hand_capture_radius': 0.002, 'estimation_estimator': 'taubin'})
            shells = Listener('localizer/shells', CylindricalShellArray)
            changed = statistics.wait(lambda m: m.shells == 0)
            self.assertIn('No handle', changed.explanation)
            shells.close()
            statistics.close()

    def test_changes_during_frames(self):
        """What is published for a cloud is what one configuration gives, whenever it changes."""
        configurations = ({'sampling_samples': 3000, 'estimation_estimator': 'taubin', 'hand_capture_radius': 0.026,
                           'shell_min_length': 0.03},
                          {'sampling_samples': 5000, 'estimation_estimator': 'pca', 'hand_capture_radius': 0.035,
                           'shell_min_length': 0.05})
        with localizer() as node, publisher(scene('table'), rate=20):
            tuner = client()
            shells = Listener('localizer/shells', CylindricalShellArray)
            statistics = Listener('localizer/statistics', LocalizationStatistics)

            def outcome(message):
                """Of a frame, but for times and the numbers of clouds."""
                return (message.sampled, message.estimator, message.shells, message.handles, message.no_shell,
                        message.too_short)

            def results(count):
                """Both, of so many of the clouds that come from now on."""
                start = rospy.Time.now()

                def answers():
                    return [m for m in statistics.messages() if m.header.stamp > start]
                statistics.wait(lambda _: len(answers()) >= count, timeout=60)
                found = []
                for answer in answers()[:count]:
                    message = shells.wait(lambda m: m.header.stamp == answer.header.stamp)
                    found.append((outcome(answer), [serialized(shell) for shell in message.shells]))
                return found

            expected = []
            for configuration in configurations:
                tuner.update_configuration(configuration)
                results(2)  # the first of them may have begun before
                expected.append(results(1)[-1])
            self.assertNotEqual(expected[0], expected[1])
            stopping = threading.Event()

            def change():
                while not stopping.is_set():
                    for configuration in configurations:
                        tuner.update_configuration(configuration)

            changer = threading.Thread(target=change, daemon=True)
            changer.start()
            mixed = results(30)
            stopping.set()
            changer.join(20)
            for result in mixed:
                self.assertIn(result, expected)
            self.assertEqual([result in mixed for result in expected], [True, True])
            for listener in (shells, statistics):
                listener.close()
            self.assertEqual(node.interrupt(), 0, node.output())
            for sign in ABNORMAL_ENDS:
                self.assertNotIn(sign, node.output())

    def test_region(self):
        with localizer(), publisher(scene('table'), rate=5):
            tuner = client()
            points = Listener('points', PointCloud2)
            listener = Listener('localizer/shells', CylindricalShellArray)
            xyz = coordinates(points.wait())
            points.close()
            found = listener.wait().shells
            x = [xyz[shell.point_index][0] for shell in found]
            middle = (min(x) + max(x)) / 2
            tuner.update_configuration({'workspace_min_x': middle})
            inside = listener.wait(lambda m: all(xyz[shell.point_index][0] >= middle - 1e-6 for shell in m.shells))
            self.assertGreater(len(inside.shells), 0)
            self.assertLess(min(x), middle)
            listener.close()

    def test_bad_combinations_are_put_back(self):
        with localizer() as node:
            tuner = client()
            before = tuner.get_configuration()
            updates = Listener('localizer/reconfigure/parameter_updates', Config)
            for bad, text in (({'shell_min_length': 0.2, 'shell_max_length': 0.1}, 'shell/max_length: 0.1 is below'),
                              ({'workspace_min_x': 0.5, 'workspace_max_x': 0.25}, 'workspace/max_x: 0.25 is not above'),
                              ({'estimation_estimator': 'taubing'}, 'taubing'),
                              ({'sampling_seed': 1.5}, 'sampling/seed: 1.5'),
                              ({'hand_capture_radius': float('nan')}, 'hand/capture_radius: nan')):
                count = len(updates.messages())
                answer = tuner.update_configuration(bad)
                for name in bad:
                    self.assertEqual(answer[name], before[name])
                wait_until(lambda text=text: any(
                    'ERROR' in line and 'put back' in line and text in line for line in node.output().splitlines()), text)
                updates.wait(lambda m, count=count: len(updates.messages()) > count)
            self.assertEqual(tuner.get_configuration(), before)
            for name in ('shell_min_length', 'workspace_max_x'):
                self.assertEqual(rospy.get_param('localizer/reconfigure/' + name), before[name])
            # Good values in the same call as bad ones are not taken either, and then alone they are.
            tuner.update_configuration({'sampling_samples': 9, 'shell_min_length': 0.4})
            self.assertEqual(tuner.get_configuration(), before)
            self.assertEqual(tuner.update_configuration({'sampling_samples': 9})['sampling_samples'], 9)
            updates.close()
            self.assertEqual(node.interrupt(), 0, node.output())
            for sign in ABNORMAL_ENDS[:-1]:  # the refusals are errors
                self.assertNotIn(sign, node.output())

    def test_numbers_beyond_their_range_are_moved_into_it(self):
        with localizer():
            values = client().update_configuration({'hand_capture_radius': 7.0, 'sampling_samples': 0})
            self.assertEqual((values['hand_capture_radius'], values['sampling_samples']), (0.5, 1))

    def test_several_cameras(self):
        with Process('grasp_affordances', 'multi_camera_node', '_target_frame:=camera_depth_optical_frame',
                     '_sync_slop:=1', '_sampling/samples:=500', 'points_1:=points', 'points_2:=points'), \
                publisher(scene('table'), rate=5):
            tuner = client('multi_camera')
            statistics = Listener('multi_camera/statistics', LocalizationStatistics)
            self.assertEqual(statistics.wait().sampled, 500)
            tuner.update_configuration({'sampling_samples': 700})
            self.assertEqual(statistics.wait(lambda m: m.sampled != 500).sampled, 700)
            statistics.close()


if __name__ == '__main__':
    rospy.init_node('reconfigure_test')
    rostest.rosrun('grasp_affordances', 'reconfigure', Reconfigure)
