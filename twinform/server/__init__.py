"""Language server: findings, completion, hover, navigation and edits of URDF, SDF and xacro files in editors.

`wiring.py` connects it to pygls, which is imported nowhere else but for the types of the protocol.
"""
