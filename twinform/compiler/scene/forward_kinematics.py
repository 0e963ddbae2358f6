"""Where the links of a document are at given joint positions."""

from collections.abc import Mapping, Sequence

from twinform.compiler.scene.build_scene import build_scene
from twinform.ir import Document
from twinform.ir.model import look_up
from twinform.ir.transform import Transform


def forward_kinematics(
    document: Document, positions: Mapping[str, float | Sequence[float]] | None = None
) -> dict[str, Transform]:
    """The frame of each link in the world, by the names that links and joints have in SDF (`model::link` in a world).

    Positions are in rad or m by the name of a joint; one with several degrees of freedom takes a sequence. Joints that
    are not named are at zero, and those that mimic another one are where that puts them. Limits are not looked at.

    Raises:
        KeyError: there is no such joint.
        ValueError: a joint has fewer degrees of freedom.
    """
    kinematics = build_scene(document).kinematics()
    values = dict[tuple[str, int], float]()
    for name, position in (positions or {}).items():
        joint = look_up(kinematics.joints, name, "joint")
        given = position if isinstance(position, Sequence) else (position,)
        if len(given) > len(joint.degrees):
            message = f"{joint.type} joint {name!r} takes at most {len(joint.degrees)} positions, not {len(given)}"
            raise ValueError(message)
        values |= {(name, degree): value for degree, value in enumerate(given)}
    return kinematics.poses(values)
