"""Companion files of a robot, which name its links and joints: SRDF, and parameters of controllers, MoveIt and Nav2.

`name_places.py` has the one table of where which kind of name stands, for checks and for renames.
"""
