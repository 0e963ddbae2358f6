"""Scenes: what there is to see of a model or world, and where it is at any joint positions."""

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
    "Frustum",
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
