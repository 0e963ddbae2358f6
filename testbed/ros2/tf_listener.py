# pyright: basic, reportMissingImports=false
"""Run by the system's Python, which has ROS 1: prints the frames on /tf and /tf_static for positions of joints."""

import json
import sys
import time

import rospy
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

_PATIENCE = 20.0


def main(positions, count):
    """Publish the positions until so many frames have come, or patience ends."""
    found = {}

    def take(message):
        for each in message.transforms:
            at, turned = each.transform.translation, each.transform.rotation
            rotation = (turned.w, turned.x, turned.y, turned.z)
            found[each.child_frame_id] = (each.header.frame_id, (at.x, at.y, at.z), rotation)

    rospy.init_node("listener", anonymous=True, disable_signals=True)
    for topic in ("/tf", "/tf_static"):
        rospy.Subscriber(topic, TFMessage, take)
    publisher = rospy.Publisher("/joint_states", JointState, queue_size=1)
    end = time.monotonic() + _PATIENCE
    while len(found) < count and time.monotonic() < end:
        message = JointState(name=list(positions), position=list(positions.values()))
        message.header.stamp = rospy.Time.now()
        publisher.publish(message)
        time.sleep(0.02)
    sys.stdout.write(json.dumps(found))


main(json.loads(sys.argv[1]), int(sys.argv[2]))
