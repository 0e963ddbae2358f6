"""Which differences count between an edited file, without its carriers, and what it is converted to.

Carriers add to what a reader sees: then the file and its result differ before any edit, and after an edit in the same
way. What counts is a difference of another kind, or of the same kind with another value: there a carrier overrules what
was written.
"""

import re
from enum import Enum

from testbed.edits.edited_file import EditedFile
from testbed.edits.reasons import reason
from twinform.compiler.compare import Difference


class Plainly(Enum):
    """Which differences to the file without carriers count.

    `ALL`; `ADDITIONS_TOO`, also what only the result has, as where something was deleted; `SKELETON`, masses, joints
    and places alone, since a pass may bring carriers of its own; `NONE`: who edits a carrier wants it to count.
    """

    ALL = "all"
    ADDITIONS_TOO = "additions too"
    SKELETON = "skeleton"
    NONE = "none"


_NAME = re.compile(r"'[^']*'")
_UNIT = re.compile(r"(?<=[0-9]) [A-Za-z][A-Za-z0-9*/^]*$")
_SKELETON = {"link": ("inertial",), "joint": ("parent", "child", "type", "pose", "axis/xyz"), "kinematics": ("",)}


def plain_key(found: Difference) -> tuple[str | None, ...]:
    """What differs and how, in whatever part: carriers go with their parts, into other links and under other names."""
    aspect = _NAME.sub("", found.aspect)
    if found.group == "kinematics":
        return found.group, aspect
    return found.group, aspect, *(_value(written.text or "") for written in (found.a, found.b))


def _value(text: str) -> str:
    """What was reported, without names and without the unit, which changes with the type of a joint."""
    return _UNIT.sub("", _NAME.sub("", text))


def explained(found: Difference, plainly: Plainly, edited: EditedFile) -> str | None:
    """Why a difference to the file without carriers does not count; None where it does."""
    if plainly is Plainly.NONE:
        return "a carrier itself was edited, which is to count"
    if known := reason(found, edited):
        return known
    if plainly is Plainly.SKELETON:
        in_skeleton = found.aspect and found.aspect.startswith(_SKELETON.get(found.group, ()))
        return None if in_skeleton else "a pass may bring carriers: masses, joints and places count alone"
    if plainly is Plainly.ADDITIONS_TOO and found.group != "frame":
        return None
    return "only the result has it: carriers add to the file" if found.a.text is None else None
