#!/usr/bin/env python3
"""print_shells.py TOPIC: waits for one grasp_affordances/CylindricalShellArray and prints it as a table."""

import sys

import rospy
from grasp_affordances.msg import CylindricalShellArray


def main():
    rospy.init_node("print_shells", anonymous=True)
    message = rospy.wait_for_message(sys.argv[1], CylindricalShellArray, timeout=60)
    print("%d cylindrical shells in frame %s" % (len(message.shells), message.header.frame_id))
    print("%26s  %21s  %10s  %10s" % ("centroid [m]", "axis", "radius [m]", "length [m]"))
    for shell in message.shells:
        c, a = shell.centroid, shell.axis
        print("%8.3f %8.3f %8.3f  %6.2f %6.2f %6.2f  %10.3f  %10.3f"
              % (c.x, c.y, c.z, a.x, a.y, a.z, shell.inner_radius, shell.length))
    return 0 if message.shells else 1


if __name__ == "__main__":
    sys.exit(main())
