#!/usr/bin/env python3
"""Prints the best handle that a localizer knows and the hand pose to grasp it with: an example of a client.

Exit status: 0: a handle was found; 1: none was, and a line on standard error says why; 2: usage."""

import argparse
import sys
import time

import rosgraph
import rospy
from grasp_affordances.msg import HandleArray
from grasp_affordances.srv import BestHandle


def parsed_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--node', default='/localizer', help='the localizer (%(default)s)')
    parser.add_argument('--select', action='store_true', help='select the handle: it is published on NODE/selected')
    parser.add_argument('--timeout', type=float, default=10.0, help='seconds to wait for a handle (%(default)g)')
    return parser.parse_args(rospy.myargv()[1:])


def best_handle(node, select, timeout):
    """The answer of NODE/best as soon as it knows a handle; (None, why not) after the timeout, by the wall clock."""
    end = time.monotonic() + timeout
    # A lazy localizer works only while somebody listens.
    listener = rospy.Subscriber(node + '/handles', HandleArray, lambda message: None, queue_size=1)
    best = rospy.ServiceProxy(node + '/best', BestHandle)
    try:
        rospy.wait_for_service(best.resolved_name, timeout)
        while True:
            answer = best(select=select)
            if answer.success:
                return answer, ''
            if time.monotonic() > end:
                return None, answer.message
            time.sleep(0.1)
    except (rospy.ROSException, rospy.ServiceException) as error:
        return None, '%s (is there a localizer named %s?)' % (error, node)
    finally:
        listener.unregister()


def text(answer):
    handle, pose = answer.handle, answer.hand_pose.pose
    p, q = pose.position, pose.orientation
    return '\n'.join((
        'handle %d, score %.2f, radius %.3f m, length %.3f m' % (handle.id, handle.score, handle.radius, handle.length),
        'frame %s, stamp %d.%09d, age %.1f s'
        % (answer.hand_pose.header.frame_id, answer.hand_pose.header.stamp.secs, answer.hand_pose.header.stamp.nsecs,
           answer.age),
        'hand pose: position %.3f %.3f %.3f m, orientation (x y z w) %.4f %.4f %.4f %.4f'
        % (p.x, p.y, p.z, q.x, q.y, q.z, q.w),
        'opening %.3f m, score of the pose %.2f' % (handle.hand_poses[0].width, handle.hand_poses[0].score)))


def main():
    arguments = parsed_arguments()
    if not rosgraph.is_master_online():  # init_node() would wait for ever
        print('pick_best.py: no ROS master at %s' % rosgraph.get_master_uri(), file=sys.stderr)
        return 1
    rospy.init_node('pick_best', anonymous=True, disable_signals=True)
    answer, reason = best_handle(arguments.node.rstrip('/'), arguments.select, arguments.timeout)
    if answer is None:
        print('pick_best.py: no handle in %g s: %s' % (arguments.timeout, reason), file=sys.stderr)
        return 1
    print(text(answer))
    return 0


if __name__ == '__main__':
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(1)
