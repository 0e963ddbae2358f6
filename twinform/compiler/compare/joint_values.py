"""The values of joints by type: which of them count, in which unit, and where limits are infinite."""

import math
from collections.abc import Mapping
from dataclasses import replace

from twinform.compiler.compare.compared_robot import Leaf, Leaves
from twinform.compiler.compare.compared_values import Numbers, Text, Value
from twinform.ir import Joint
from twinform.ir.defaults import MULTIPLIER, UNLIMITED
from twinform.ir.motion import WITH_TWO_AXES, WITHOUT_AXIS

_OF_TYPES: Mapping[str, frozenset[str]] = {
    "gearbox_ratio": frozenset({"gearbox"}),
    "gearbox_reference_body": frozenset({"gearbox"}),
    "screw_thread_pitch": frozenset({"screw"}),
    "thread_pitch": frozenset({"screw"}),
}
"""Values that mean something for joints of some types alone."""
_SLIDES = frozenset({"prismatic"})
_UNITS: Mapping[str, tuple[str, str]] = {
    "limit/lower": ("rad", "m"),
    "limit/upper": ("rad", "m"),
    "limit/effort": ("N*m", "N"),
    "limit/velocity": ("rad/s", "m/s"),
    "limit/stiffness": ("N*m/rad", "N/m"),
    "limit/dissipation": ("N*m*s/rad", "N*s/m"),
    "dynamics/damping": ("N*m*s/rad", "N*s/m"),
    "dynamics/friction": ("N*m", "N"),
    "dynamics/spring_reference": ("rad", "m"),
    "dynamics/spring_stiffness": ("N*m/rad", "N/m"),
}
"""Units of what turns and of what slides."""
_ENDS = frozenset({"limit/lower", "limit/upper"})
_STRENGTHS = frozenset({"limit/effort", "limit/velocity"})


def joint_type(joint: str) -> str:
    """The type of a joint as SDF before 1.6 calls it: continuous is revolute without limits."""
    return "revolute" if joint == "continuous" else joint


def joint_leaves(joint: Joint, leaves: Leaves) -> Leaves:
    """The values of a joint that mean something, in units and without stand-ins for infinity."""
    found = {path: _read(path, leaf, joint.type) for path, leaf in leaves.items() if _counts(path, joint.type)}
    if joint.type == "continuous":
        # A continuous joint turns without end, whatever its <limit> says; URDF cannot express such
        # ends, and they are carried.
        found = {path: leaf for path, leaf in found.items() if path.removeprefix("axis/") not in _ENDS}
    return _with_mimic(_with_pitch(found))


def _counts(path: str, type: str) -> bool:
    if path in _OF_TYPES:
        return type in _OF_TYPES[path]
    if path.startswith("axis2"):
        return type in WITH_TWO_AXES
    return type not in WITHOUT_AXIS or not path.startswith("axis")


def _read(path: str, leaf: Leaf, type: str) -> Leaf:
    key = path.partition("/")[2]
    if not path.startswith("axis") or not isinstance(leaf.value, Numbers):
        return leaf
    unit = _UNITS.get(key, ("", ""))[type in _SLIDES]
    return replace(leaf, value=_number(key, leaf.value, unit), default=_number(key, leaf.default, unit))


def _number(key: str, value: Value | None, unit: str) -> Value | None:
    if not isinstance(value, Numbers) or len(value.values) != 1:
        return value
    (number,) = value.values
    if key in _ENDS and abs(number) >= UNLIMITED:
        number = math.copysign(math.inf, number)
    # SDF takes a negative effort or velocity for no limit.
    if key in _STRENGTHS and (number < 0 or number >= UNLIMITED):
        number = math.inf
    return Numbers((number,), unit or value.unit)


def _with_pitch(leaves: dict[str, Leaf]) -> dict[str, Leaf]:
    """The older pitch of a screw, in rad/m and left-handed, as the newer one, in m/rev and right-handed."""
    old = leaves.pop("thread_pitch", None)
    if (
        old is not None
        and "screw_thread_pitch" not in leaves
        and isinstance(old.value, Numbers)
        and old.value.values[0]
    ):
        pitch = Numbers((-2 * math.pi / old.value.values[0],), "m/rev")
        leaves["screw_thread_pitch"] = replace(old, value=pitch, default=None)
    return leaves


def _with_mimic(leaves: dict[str, Leaf]) -> dict[str, Leaf]:
    """The reference of a mimic as a part of its offset: m (q - r) + o is m q + (o - m r)."""
    for axis in ("axis", "axis2"):
        reference = leaves.pop(f"{axis}/mimic/reference", None)
        if f"{axis}/mimic/@joint" not in leaves:
            continue
        leaves.setdefault(f"{axis}/mimic/@axis", Leaf(Text("axis"), where=leaves[f"{axis}/mimic/@joint"].where))
        multiplier, offset = (leaves.get(f"{axis}/mimic/{name}") for name in ("multiplier", "offset"))
        total = number_of(offset, 0.0) - number_of(multiplier, MULTIPLIER) * number_of(reference, 0.0)
        where = (offset or reference or leaves[f"{axis}/mimic/@joint"]).where
        leaves[f"{axis}/mimic/offset"] = Leaf(Numbers((total,), floor=1.0), Numbers((0.0,)), where)
    return leaves


def number_of(leaf: Leaf | None, default: float) -> float:
    """The number of a leaf, or its default."""
    return leaf.value.values[0] if leaf is not None and isinstance(leaf.value, Numbers) else default
