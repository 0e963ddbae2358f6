"""Finds the files that a model names: URIs, ROS packages, Gazebo Fuel, the folders around a file."""
