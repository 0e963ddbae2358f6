"""What became of edits, as a page and in a few lines, and the verdict of Drake on it."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from lxml import etree

from reports.harness.known import Known, contains
from reports.harness.sample import Sample
from reports.same_robot.drake_verdicts import DRAKE
from reports.text_survives.edit_jobs import MOST_BYTES, Done, Tried
from testbed.edits.judging import Outcome
from testbed.markdown import listing, subsection, table
from twinform.compiler.workers import Failure
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.shared.poses import OFFSET
from twinform.testing import oracles
from twinform.testing.oracles.robot import EngineRobot, View
from twinform.testing.oracles.robot_comparison import chained, read_robot, renamed, verdict_on

KNOWN = Known(Path(__file__).with_name("edits.toml"), contains)
_TOLERANCE = 1e-9
ABOUT = """\
Every model of the corpus that is accepted, and models that Hypothesis makes up, are converted; the converted file is
edited as people edit files, or a built-in pass runs on it; and it is converted on, to the format that it came from. The
robot of the edited file and that of the result have to be the same, by `twinform diff`: once as the edited file is, and
once as those read it who do not know the carriers (the differences found so begin with *plainly*). An edit may instead
be refused, by an error with a line. *Trip 1* to *trip 3* are edits in a row, each of what came of the one before, where
only what differed before the first may differ later. *Wrong* is everything else, *silent* what is wrong without so much
as a warning. One in twenty of those that are the same is shown to Drake as well."""


@dataclass(frozen=True, slots=True)
class Drake:
    """The verdict of Drake on edited files and what became of them; `excused` are differences by their known reason."""

    same: int = 0
    unread: int = 0
    faults: tuple[str, ...] = ()
    excused: Mapping[str, int] = field(default_factory=dict[str, int])


def drake_judged(done: list[Done], sample: Sample) -> Drake:
    """The verdicts of Drake on the files that were kept for it."""
    if not oracles.available(DRAKE):
        return Drake()
    pairs = {one.pair: one for each in done for one in each.tried if one.pair}
    same, unread, faults, excused = 0, 0, list[str](), Counter[str]()
    for pair, answer in sample.run(_judged, list(pairs)):
        if isinstance(answer, Failure) or answer is None:
            unread += 1
        elif answer and (reason := _excuse(pair[0], answer)):
            excused[reason] += 1
        elif answer:
            faults.append(f"{pair[0].parent.name}: {pairs[pair].replay}: {answer}")
        else:
            same += 1
    return Drake(same, unread, tuple(sorted(faults)), excused)


def _excuse(edited: Path, answer: str) -> str:
    """The reason why Drake may answer so about an edited file, if it is a known one."""
    return KNOWN.why("drake", pattern=edited.read_text(encoding="utf-8"), answer=answer)


def _judged(pair: tuple[Path, Path]) -> str | None:
    """What differs, nothing where nothing does, and None where Drake cannot read the edited file or what it was."""
    edited, result = pair
    if _root_is_elsewhere(edited):
        return None
    try:
        before = edited.with_stem("before")
        unedited = verdict_on(read_robot(before, DRAKE), (before, result.with_stem("back")), (DRAKE, DRAKE))
        source = read_robot(edited, DRAKE)
    except oracles.EngineUnreadableError:
        return None
    if not unedited:
        return None
    try:
        found = verdict_on(source, pair, (DRAKE, DRAKE))
    except oracles.EngineUnreadableError as error:
        return f"the result is not read: {error.cause}"
    if not found:
        return found.cause
    if result.suffix == ".sdf" and unedited.alike is oracles.Alike.FRAMES:  # URDF has its links where their joints are
        return _frames(source, result)
    return ""


def _root_is_elsewhere(edited: Path) -> bool:
    """Whether the root, in whose frame Drake gives all positions, has another frame in SDF."""
    robot = etree.fromstring(edited.read_bytes())
    children = {each.get("link") for each in robot.iterfind("joint/child")}
    roots = (each for each in robot.iterfind("link") if each.get("name") not in children)
    return any(each.find(f"{{{NAMESPACE}}}{OFFSET}") is not None for each in roots)


def _frames(source: EngineRobot, result: Path) -> str:
    """Links whose frames are elsewhere, at the same joint positions."""
    seen = read_robot(result, DRAKE, View(reference=source.reference))
    view = View(renamed(source, seen), source.reference, chained(source, seen))
    seen = read_robot(result, DRAKE, view)
    if seen.reference != source.reference or chained(seen, source):
        return ""
    gaps = {
        name: float(abs(before.poses[name] - after.poses[name]).max())
        for before, after in zip(source.samples, seen.samples, strict=True)
        for name in before.poses.keys() & after.poses.keys()
    }
    return "; ".join(f"frame of {name} is {gap:.2g} elsewhere" for name, gap in gaps.items() if gap > _TOLERANCE)


def summary(done: list[Done], failures: list[str], drake: Drake) -> str:
    """The table, and what else is to be known at once."""
    tried = [one for each in done for one in each.tried]
    differing, excused = sum(1 for each in done if each.differing), sum(drake.excused.values())
    models = f"{len(done)} models, {differing} differ unedited; {len(tried)} edits and passes"
    seen = f"{drake.same} same, {drake.unread} not read, {len(drake.faults)} different, {excused} excused"
    return "\n".join((_table(tried), models, f"Drake: {seen}", *drake.faults[:20], *failures))


def sections(done: list[Done], tried: list[Tried], failures: list[str], drake: Drake, seed: int) -> Iterator[str]:
    """The sections of the page."""
    used = [each for each in done if not each.left_out]
    yield f"Seed {seed}: {len(used)} models, {len(tried)} edits and passes."
    yield _table(tried)
    yield f"Drake finds {drake.same} the same and {len(drake.faults)} different; {drake.unread} it does not read."
    yield subsection("Wrong", _faults(tried))
    explained = Counter(reason for one in tried for reason in one.verdict.explained)
    yield "Differences to the file without its carriers that do not count, by why:\n\n" + table(
        ["why", "edits and passes with any"], explained.most_common()
    )
    if drake.excused:
        rows = sorted(drake.excused.items())
        yield "Differences to Drake with a known cause:\n\n" + table(["cause", "edits"], rows)
    if drake.faults:
        yield subsection("Different in Drake", "\n".join(f"- {fault}" for fault in drake.faults))
    refusals = Counter(rule for one in tried if one.verdict.outcome is Outcome.REFUSED for rule in one.verdict.rules)
    yield subsection("Refused, by rule", listing(["rule", "edits"], refusals.most_common()))
    differing = [(each.name, "; ".join(each.differing[:3])) for each in used if each.differing]
    yield subsection("Models that differ before any edit", listing(["model", "what"], differing))
    yield subsection("Models that were left out", _left_out(done))
    yield subsection("Broken promises", "\n".join(failures) or "None.")


def _table(tried: Iterable[Tried]) -> str:
    every = list(tried)
    kinds = sorted({one.kind for one in every}, key=lambda kind: (kind.startswith("pass: "), kind))
    directions = sorted({one.direction for one in every}, reverse=True)
    rows = [
        _row(direction, kind, [one for one in every if one.direction == direction and one.kind == kind])
        for direction in directions
        for kind in kinds
    ]
    totals = [_row(direction, "all", [one for one in every if one.direction == direction]) for direction in directions]
    head = ["direction", "edit", "tried", "same", "same, warned", "refused", "wrong", "silent"]
    return table(head, [row for row in (*rows, *totals) if row[2]])


def _row(direction: str, kind: str, found: list[Tried]) -> tuple[object, ...]:
    counts = Counter(one.verdict.outcome for one in found)
    wrong = counts[Outcome.WRONG] + counts[Outcome.SILENT]
    return (
        direction, kind, len(found), counts[Outcome.SAME], counts[Outcome.WARNED], counts[Outcome.REFUSED], wrong,
        counts[Outcome.SILENT],
    )  # fmt: skip


def _faults(tried: list[Tried]) -> str:
    faults = [one for one in tried if one.verdict.is_fault]
    rows = [
        (one.kind, one.verdict.outcome, f"`{one.replay}`", "; ".join(one.verdict.differences[:2])) for one in faults
    ]
    return listing(["edit", "how", "again with `python -m reports.text_survives.replay`", "what differs"], rows)


def _left_out(done: list[Done]) -> str:
    large = [(each.name, each.left_out) for each in done if each.left_out.startswith("too large")]
    others = Counter(each.left_out for each in done if each.left_out and not each.left_out.startswith("too large"))
    listed = table(["model", "why"], large) if large else ""
    intro = f"Converted files of more than {MOST_BYTES // 1000} kB are not edited:\n\n{listed}\n" if large else ""
    return intro + "\n" + (table(["why", "models"], others.most_common()) if others else "")
