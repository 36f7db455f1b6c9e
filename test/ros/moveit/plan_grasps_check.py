#!/usr/bin/python3
"""plan_grasps_check.py MOVEIT_GRASPS: what that executable answers to plan_grasps."""

import signal
import subprocess
import sys
import unittest

import rospy
from moveit_msgs.msg import MoveItErrorCodes
from moveit_msgs.srv import GraspPlanning

from grasp_affordances.msg import HandPose, Handle, HandleArray
from helpers import wait_until

NODE = sys.argv.pop()
PARAMETERS = {'gripper_joints': ['finger'], 'open_positions': [0.04], 'closed_positions': [0], 'open_width': 0.08}


def handle(identifier, score, widths):
    result = Handle(id=identifier, score=score)
    result.header.frame_id = 'optical'
    result.pose.orientation.w = 1
    for width in widths:
        hand = HandPose(width=width, score=0.5)
        hand.pose.orientation.w = 1
        result.hand_poses.append(hand)
    return result


class PlanGrasps(unittest.TestCase):
    def setUp(self):
        self.handles = rospy.Publisher('handles', HandleArray, queue_size=1, latch=True)
        self.selected = rospy.Publisher('selected', Handle, queue_size=1, latch=True)
        self.service = rospy.ServiceProxy('plan_grasps', GraspPlanning)
        self.process = None

    def tearDown(self):
        if self.process:
            self.process.send_signal(signal.SIGINT)
            self.assertEqual(self.process.wait(20), 0)
        if rospy.has_param('moveit_grasps'):
            rospy.delete_param('moveit_grasps')

    def start(self, **more):
        rospy.set_param('moveit_grasps', dict(PARAMETERS, **more))
        self.process = subprocess.Popen([NODE])
        self.service.wait_for_service(20)

    def grasps(self, count):
        """Ids of the grasps, once there are that many."""
        answer = []

        def arrived():
            answer[:] = [self.service()]
            return len(answer[0].grasps) == count
        wait_until(arrived, '%d grasps' % count)
        code = MoveItErrorCodes.SUCCESS if count else MoveItErrorCodes.FAILURE
        self.assertEqual(answer[0].error_code.val, code)
        return [grasp.id for grasp in answer[0].grasps]

    def test_grasps_of_all_handles_the_best_first(self):
        self.start()
        self.assertEqual(self.grasps(0), [])
        self.handles.publish(HandleArray(handles=[handle(1, 0.3, [0.05]), handle(2, 0.9, [0.05, 0.06]),
                                                  handle(5, 0.99, [0.2])]))
        self.assertEqual(self.grasps(3), ['2/1', '2/2', '1/1'])
        self.handles.publish(HandleArray())
        self.grasps(0)

    def test_grasps_of_the_selected_handle_only(self):
        self.start(only_selected=True)
        self.handles.publish(HandleArray(handles=[handle(1, 0.3, [0.05])]))
        self.selected.publish(handle(4, 0.5, [0.05]))
        self.assertEqual(self.grasps(1), ['4/1'])
        self.selected.publish(Handle())
        self.grasps(0)

    def test_bad_parameters_are_refused(self):
        for parameters, parts in (({}, ['~gripper_joints']),
                                  (dict(PARAMETERS, gripper_joints='finger'), ['~gripper_joints', 'a list of names']),
                                  (dict(PARAMETERS, open_positions=['wide']), ['~open_positions', 'a list of numbers']),
                                  (dict(PARAMETERS, open_width=-1), ['~open_width', '-1', '[0, 1] m']),
                                  (dict(PARAMETERS, grippers=1), ['~grippers', 'unknown name'])):
            rospy.set_param('moveit_grasps', parameters)
            node = subprocess.run([NODE], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=20)
            self.assertEqual(node.returncode, 1)
            for part in parts:
                self.assertIn(part, node.stdout.decode())


if __name__ == '__main__':
    rospy.init_node('plan_grasps_check')
    unittest.main(warnings='ignore')  # rospy leaves sockets to the garbage collector
