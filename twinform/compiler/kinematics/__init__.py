"""How the links of a robot move with its joints."""

from twinform.compiler.kinematics.degrees import degrees_of, range_of
from twinform.compiler.kinematics.moving import Kinematics, Positions
from twinform.compiler.kinematics.placed_joints import Degree, Leader, PlacedJoint

__all__ = ["Degree", "Kinematics", "Leader", "PlacedJoint", "Positions", "degrees_of", "range_of"]
