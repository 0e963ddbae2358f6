"""Declaring the rotation format of poses that are quaternions in URDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Model, Pose, bits_of, rewrite
from twinform.passes.framework.pass_base import ModelPass

_QUATERNION = "quat_xyzw"


class DeclareQuaternions(ModelPass):
    """Declare the notation of poses that are written as quaternions.

    Changes: the `rotation_format` of every pose that has a `quat_xyzw`.
    Never touches: other poses.
    Diagnostics: none.
    """

    name: ClassVar[str] = "declare-quaternions"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with quaternions that declare their format."""
        return rewrite(model, Pose, _declare_format, having=bits_of(Pose, _QUATERNION))


def _declare_format(pose: Pose) -> Pose:
    if pose.quat_xyzw is None or pose.rotation_format is not None:
        return pose
    return pose.copy(rotation_format=_QUATERNION, rpy=None)
