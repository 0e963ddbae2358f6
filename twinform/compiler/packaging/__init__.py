"""Packages: a model with all its files in a folder, as Gazebo or ROS 2 wants it.

`collecting.py` finds the files, and `package.py` says where each goes, has the result and writes it.
`kinds.py` lists the kinds of packages.
"""
