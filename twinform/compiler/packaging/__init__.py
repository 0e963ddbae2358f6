"""Packages: a model with all its files, as Gazebo or ROS 2 wants it in a folder.

`collecting.py` finds the files, `layout.py` says where each goes, `package.py` is the result, and `writing.py` puts it
on the disk. There is a room for each kind of package.
"""
