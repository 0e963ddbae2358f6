"""Scenes: what there is to see of a model or world, and where it is at any joint positions."""

from twinform.compiler.kinematics import Degree, Kinematics, Leader, Positions
from twinform.compiler.scene.build_scene import build_scene, forward_kinematics
from twinform.compiler.scene.scene import (
    Frustum,
    Ray,
    Role,
    Scene,
    SceneFrame,
    SceneJoint,
    SceneLink,
    SceneSensor,
    SceneShape,
)

__all__ = [
    "Degree",
    "Frustum",
    "Kinematics",
    "Leader",
    "Positions",
    "Ray",
    "Role",
    "Scene",
    "SceneFrame",
    "SceneJoint",
    "SceneLink",
    "SceneSensor",
    "SceneShape",
    "build_scene",
    "forward_kinematics",
]
