"""Passes on joint limits and joint actuation: limits, transmissions of ROS 1, and `<ros2_control>` of ROS 2."""
