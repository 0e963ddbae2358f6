"""Packages: a model with all its files in a folder, as Gazebo or ROS 2 wants it.

`collecting.py` finds the files, `layout.py` says where each goes, and `package.py` has the result and writes it.
`kinds.py` lists the kinds of packages.
"""
