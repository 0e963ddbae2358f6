"""Thread pitch of screw joints, in meters per turn since SDF 1.10."""

import math
from functools import partial
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Document, Joint, rewrite
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.nodes import text_piece
from twinform.schemas import format_value

_SINCE = (1, 10)
_DEFAULT = 1.0
"""Of `thread_pitch` in rad/m, and of `screw_thread_pitch` in m per turn."""


class WriteThreadPitches(VersionPass):
    """Write the pitch of a screw joint in the syntax of the version.

    Changes: 1. in the conversion to 1.10 a pitch that is not written, 1 rad/m, is written, because another one is meant
    without it from there on; 2. with `back`, a `screw_thread_pitch` of s m per turn becomes a `thread_pitch` of -2 pi/s
    rad/m, as does the one that goes without saying.
    Never touches: a `thread_pitch` that is written, which all versions understand.
    """

    name: ClassVar[str] = "write-thread-pitches"
    back: bool = False

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with screws in the syntax of the version."""
        return rewrite(document, Joint, partial(_write_old_pitch, keeper) if self.back else _write_default_pitch)


def _write_default_pitch(joint: Joint) -> Joint:
    if joint.type != "screw" or joint.thread_pitch is not None or joint.screw_thread_pitch is not None:
        return joint
    # Since 1.10 an absent pitch means 1 m per turn by the new element; before, it meant 1 rad/m by
    # the old.
    return joint.copy(thread_pitch=_DEFAULT)


def _write_old_pitch(keeper: VersionKeeper, joint: Joint) -> Joint:
    written = joint.screw_thread_pitch
    if joint.type != "screw" or (written is None and joint.thread_pitch is not None):
        return joint
    pitch = _DEFAULT if written is None else written
    message = f"screw joint {joint.name!r} moves {pitch:g} m per turn"
    # `thread_pitch` counts radians per meter with the opposite sign, `screw_thread_pitch` meters
    # per turn.
    made = -math.tau / pitch if pitch else 0.0
    changed = joint.copy(thread_pitch=made, screw_thread_pitch=None)
    pieces = [] if written is None else [text_piece("screw_thread_pitch", format_value(written))]
    if joint.thread_pitch is not None:
        pieces.append(text_piece("thread_pitch", format_value(joint.thread_pitch)))
    gone = ("thread_pitch",) if joint.thread_pitch is None else ()
    condition = VersionCondition(since=_SINCE, without=gone)
    return keeper.keep(changed, pieces, condition, rules.OTHER_WORDS, message, joint.location, max(1, len(pieces)))
