"""Language server: findings, completion, hover, navigation and edits of URDF, SDF and xacro files in editors.

`wiring.py` connects it to pygls and lists the requests; `protocol.py` and `serving.py` handle the messages.
"""
