"""What has to hold for edits of a converted file: what stands in it is what counts."""

from collections.abc import Iterable

from testbed.edits.edit import Edit, apply_all
from testbed.edits.edited_file import Language
from testbed.edits.judging import judge_edits, unedited


def assert_edits_win(converted: bytes, edits: Iterable[Edit], *, to: Language | None = None) -> None:
    """The edited file and what it is converted to are the same robot, or the edited file is refused with a line.

    It is the same robot also for those who do not know our carriers. The edited file is converted `to` a language, or
    else to the other of URDF and SDF.
    """
    every = tuple(edits)
    verdict = judge_edits(unedited(converted, to), every, apply_all(every, converted))
    history = "\n".join(map(str, every))
    assert not verdict.is_fault, "\n".join((f"{verdict.outcome} after {history}:", *verdict.differences[:20]))
