"""Trips of a file between the formats, with edits before each: a fault may only show on the way after next."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

from testbed.edits.edit import Edit
from testbed.edits.edited_file import EditedFile
from testbed.edits.judging import Converted, Verdict, edits_carriers, judge_edits, unedited

TRIPS = 3
Draw = Callable[[bytes], tuple[tuple[Edit, ...], bytes]]
"""Edits of a file, and its text after them."""


@dataclass(frozen=True, slots=True)
class Trip:
    """A converted file, the edits of it, and what became of them."""

    before: Converted
    edits: tuple[Edit, ...]
    edited: bytes
    verdict: Verdict


def trips(before: Converted, draws: Iterable[Draw]) -> Iterator[Trip]:
    """Edit a converted file, convert it, edit the result, and so on, until an edit is refused or does not win.

    Only what differed before the first edit may differ later. Whoever edits a carrier changes what comes back, so that
    is where the trips end.

    Raises:
        CompileError: a result cannot be converted on.
    """
    for draw in draws:
        edits, edited = draw(before.text)
        verdict = judge_edits(before, edits, edited)
        yield Trip(before, edits, edited, verdict)
        if verdict.result is None or verdict.is_fault or edits_carriers(edits):
            return
        after = unedited(verdict.result.encode(), EditedFile(before.text).language)
        before = replace(
            after,
            differing=after.differing & before.differing,
            differing_when_back=after.differing_when_back & before.differing_when_back,
        )
