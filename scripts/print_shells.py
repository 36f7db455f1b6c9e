#!/usr/bin/env python3
"""print_shells.py SHELLS POINTS BAG: prints a grasp_affordances/CylindricalShellArray of the topic SHELLS as a table and
leaves the cloud that it was found in, a sensor_msgs/PointCloud2 of the topic POINTS, in a bag file."""

import queue
import sys

import message_filters
import rosbag
import rospy
from grasp_affordances.msg import CylindricalShellArray
from sensor_msgs.msg import PointCloud2

MOST_ROWS = 20


def receive(shells_topic, points_topic):
    """The first array and cloud with one stamp."""
    received = queue.Queue()
    synchronizer = message_filters.TimeSynchronizer([message_filters.Subscriber(shells_topic, CylindricalShellArray),
                                                     message_filters.Subscriber(points_topic, PointCloud2)], 30)
    synchronizer.registerCallback(lambda *messages: received.put(messages))
    try:
        return received.get(timeout=60)
    except queue.Empty:
        sys.exit('no shells on %s in 60 s' % shells_topic)


def main():
    shells_topic, points_topic, file = sys.argv[1:]
    rospy.init_node('print_shells', anonymous=True)
    message, cloud = receive(shells_topic, points_topic)
    with rosbag.Bag(file, 'w') as bag:
        bag.write(points_topic, cloud, cloud.header.stamp)

    print('%d cylindrical shells in frame %s' % (len(message.shells), message.header.frame_id))
    print('%26s  %21s  %10s  %10s' % ('centroid [m]', 'axis', 'radius [m]', 'length [m]'))
    for shell in message.shells[:MOST_ROWS]:
        c, a = shell.centroid, shell.axis
        print('%8.3f %8.3f %8.3f  %6.2f %6.2f %6.2f  %10.3f  %10.3f'
              % (c.x, c.y, c.z, a.x, a.y, a.z, shell.inner_radius, shell.length))
    if len(message.shells) > MOST_ROWS:
        print('... and %d more' % (len(message.shells) - MOST_ROWS))
    return 0 if message.shells else 1


if __name__ == '__main__':
    sys.exit(main())
