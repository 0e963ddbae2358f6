"""The transmissions of the corpus as ros2_control, and back, and there again."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import twinform
from reports.harness.sample import Sample
from testbed.corpus.files import CorpusFile, Kind
from testbed.markdown import subsection, table
from twinform.compiler.audit import audit
from twinform.diagnostics import Diagnostic, rules

THERE, BACK = "ros2-control-from-transmissions", "transmissions-from-ros2-control"


@dataclass(frozen=True, slots=True)
class Transmissions:
    """What became of the transmissions of a file; `same` is whether there, back and there is there."""

    name: str
    converted: int
    stay: Counter[str]
    foreign: Counter[str]
    unaccounted: int
    same: bool


def section(sample: Sample) -> tuple[str, list[str]]:
    """The section of the page, and what is at fault."""
    found = list(_all_transmissions(sample))
    stay, foreign = Counter[str](), Counter[str]()
    for one in found:
        stay, foreign = stay + one.stay, foreign + one.foreign
    rows = [
        ("robots with transmissions", len(found)),
        ("transmissions in a `<ros2_control>`", sum(one.converted for one in found)),
        *((f"that stay, or stay as well: {why}", count) for why, count in sorted(stay.items())),
        *((f"reported with a warning: {why}", count) for why, count in sorted(foreign.items())),
        ("parts that nothing accounts for", sum(one.unaccounted for one in found)),
        ("robots that are the same there, back and there", sum(1 for one in found if one.same)),
    ]
    faults = [f"{one.name}: {one.unaccounted} parts unaccounted" for one in found if one.unaccounted]
    faults += [f"{one.name}: transmissions differ after the round trip" for one in found if not one.same]
    about = f"Every accepted URDF file with a `<transmission>`, through `{THERE}`, `{BACK}` and `{THERE}` again."
    return subsection("Transmissions as ros2_control", about, table(["what", "number"], rows)), faults


def _all_transmissions(sample: Sample) -> Iterator[Transmissions]:
    for file in sample.models(Kind.URDF):
        if b"<transmission" in file.path.read_bytes():
            transmissions = _transmissions_of(file)
            if transmissions is not None:
                yield transmissions


def _transmissions_of(file: CorpusFile) -> Transmissions | None:
    checked = twinform.check(file.path, paths=file.paths)
    if checked.document is None or not checked.accepted:
        return None
    there = twinform.convert(file.path, to="urdf", passes=THERE, paths=file.paths)
    again = twinform.convert(there.text.encode(), to="urdf", passes=f"{BACK},{THERE}")
    missing = audit(there.source, there.text, there.ledger).unaccounted if there.source is not None else ()
    foreign = (rules.FOREIGN_TRANSMISSION, rules.FOREIGN_HARDWARE_INTERFACE)
    return Transmissions(
        name=file.name,
        converted=sum(1 for each in there.diagnostics if each.rule is rules.CONVERTED_TRANSMISSION),
        stay=Counter(map(_why, (each for each in there.diagnostics if each.rule is rules.UNCONVERTED_TRANSMISSION))),
        foreign=Counter(each.rule.name for each in there.diagnostics if each.rule in foreign),
        unaccounted=len(missing),
        same=again.text == there.text,
    )


def _why(diagnostic: Diagnostic) -> str:
    """The reason without the names in it."""
    reason = diagnostic.message.partition(": ")[2]
    for quoted in reason.split("'")[1::2]:
        reason = reason.replace(f"'{quoted}'", "...")
    return reason
