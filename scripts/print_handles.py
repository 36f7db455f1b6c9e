#!/usr/bin/env python3
"""print_handles.py HANDLES POINTS BAG: prints a grasp_affordances/HandleArray of the topic HANDLES as tables and leaves
the cloud that it was found in, a sensor_msgs/PointCloud2 of the topic POINTS, in a bag file."""

import queue
import sys

import message_filters
import rosbag
import rospy
from grasp_affordances.msg import HandleArray
from sensor_msgs.msg import PointCloud2

MOST_ROWS = 20


def receive(handles_topic, points_topic):
    """The first array and cloud with one stamp."""
    received = queue.Queue()
    synchronizer = message_filters.TimeSynchronizer([message_filters.Subscriber(handles_topic, HandleArray),
                                                     message_filters.Subscriber(points_topic, PointCloud2)], 30)
    synchronizer.registerCallback(lambda *messages: received.put(messages))
    try:
        return received.get(timeout=60)
    except queue.Empty:
        sys.exit('no handles on %s in 60 s' % handles_topic)


def approach(orientation):
    """The x axis of a hand's frame, in which it moves forward."""
    x, y, z, w = orientation.x, orientation.y, orientation.z, orientation.w
    return 1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)


def print_handles(handles):
    print('%3s  %25s  %20s  %10s  %10s  %5s  %6s  %10s'
          % ('id', 'centroid [m]', 'axis', 'radius [m]', 'length [m]', 'score', 'shells', 'hand poses'))
    for handle in handles:
        c, a = handle.centroid, handle.axis
        print('%3d  %7.3f  %7.3f  %7.3f  %6.2f %6.2f %6.2f  %10.3f  %10.3f  %5.2f  %6d  %10d'
              % (handle.id, c.x, c.y, c.z, a.x, a.y, a.z, handle.radius, handle.length, handle.score,
                 len(handle.shells), len(handle.hand_poses)))


def print_best_hand_poses(handles):
    print('Best hand pose of each')
    print('%3s  %25s  %20s  %10s  %5s' % ('id', 'position [m]', 'approach', 'width [m]', 'score'))
    for handle in handles:
        for hand in handle.hand_poses[:1]:
            p = hand.pose.position
            print('%3d  %7.3f  %7.3f  %7.3f  %6.2f %6.2f %6.2f  %10.3f  %5.2f'
                  % (handle.id, p.x, p.y, p.z, *approach(hand.pose.orientation), hand.width, hand.score))


def main():
    handles_topic, points_topic, file = sys.argv[1:]
    rospy.init_node('print_handles', anonymous=True)
    message, cloud = receive(handles_topic, points_topic)
    with rosbag.Bag(file, 'w') as bag:
        bag.write(points_topic, cloud, cloud.header.stamp)

    handles = message.handles
    print('%d handles in frame %s' % (len(handles), message.header.frame_id))
    print_handles(handles[:MOST_ROWS])
    if len(handles) > MOST_ROWS:
        print('... and %d more' % (len(handles) - MOST_ROWS))
    print_best_hand_poses(handles[:MOST_ROWS])
    return 0 if handles else 1


if __name__ == '__main__':
    sys.exit(main())
