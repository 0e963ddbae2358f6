"""Passes about what drives the joints: transmissions of ROS 1 and `<ros2_control>` of ROS 2."""
