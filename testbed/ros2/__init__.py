"""Packages of ROS 2 before catkin, CMake, launch files and ROS."""
