"""Passes on joint actuation: transmissions of ROS 1 and `<ros2_control>` of ROS 2."""
