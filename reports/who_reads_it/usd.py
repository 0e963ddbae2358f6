"""What do converters to USD lose, by `diff`, and does `diff` find what is planted in their stages?"""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

import twinform
from reports.harness.needs import corpus, need
from reports.harness.sample import Sample, in_turn
from reports.harness.section import Findings, Section
from testbed.corpus.files import CorpusFile, Kind
from testbed.engines.readers.meshless import without_meshes
from testbed.markdown import listing, subsection, table
from testbed.output_files import OUT, kept
from testbed.usd.converters import CONVERTERS, MISSING, NEWEST, Converter, RefusedError, available
from testbed.usd.losses import flat, losses
from twinform.compiler.compare import Difference, DifferenceSeverity

_ROBOTS = 20
_PLANTED = 11
"""Losses in each robot."""
_SECONDS = 900
_FEWEST_JOINTS = 4
_ABOUT = """\
Twenty robots of the corpus, one of each repository in turn: URDF that `check` and urdfdom find no error in, with four
joints or more, and with a box of 0.1 m for each mesh, since the corpus has no meshes. Each is converted by every
release, and

    twinform diff robot.urdf robot.usda

names what is not in the stage as it is in the file. mujoco-usd-converter is given what MuJoCo writes after it has read
the URDF, with links kept apart that fixed joints connect. Carried is what stands only in attributes of `urdf:`, which
no engine reads.

Eleven losses are planted in each robot's stage of urdf-usd-converter, of kinds that are drawn: one change of one prim
each. One is found if `diff` says something of this part, or of the link that it is in or moves, that it did not say of
the stage before."""
_KINDS = {
    "links": r"link:\+?",
    "joints": r"joint:",
    "joints that the file has not": r"joint:\+",
    "frames": r"frame:.*",
    "what joints connect, and how": r"joint:(parent|child|type)",
    "places and axes of joints": r"joint:(pose|axis/xyz|axis/position).*",
    "masses": r"link:inertial/(mass|auto)",
    "centers and inertias": r"link:inertial/.*",
    "collisions": r"link:collision.*",
    "ends of joints": r"joint:axis/limit/(lower|upper)",
    "efforts": r"joint:axis/limit/effort",
    "speeds": r"joint:axis/limit/velocity",
    "damping": r"joint:axis/dynamics/damping",
    "friction": r"joint:axis/dynamics/friction",
    "mimics": r"joint:axis/mimic/.*",
}
"""What is lost, with patterns for what a difference is about; behind that is a plus if only the stage has the part."""
_OTHER = "the motion of links"


@dataclass(frozen=True, slots=True)
class Converted:
    """A robot by every converter: what is lost, or why there is no stage, and which planted losses are found."""

    name: str
    lost: dict[str, frozenset[tuple[str, bool]]] = field(default_factory=dict[str, frozenset[tuple[str, bool]]])
    refused: dict[str, str] = field(default_factory=dict[str, str])
    planted: list[tuple[str, bool]] = field(default_factory=list[tuple[str, bool]])


def measure(sample: Sample) -> Findings:
    """Convert, compare, plant and compare again."""
    files = list(islice(filter(_is_suitable, in_turn(sample.models(Kind.URDF))), _ROBOTS))
    found = sample.outcomes(_judge, files, _failed, seconds=_SECONDS)
    planted = [each for one in found for each in one.planted]
    missed = [f"{kind} is not found" for kind, is_found in planted if not is_found]
    crashed = [f"{one.name}: {one.refused['all']}" for one in found if "all" in one.refused]
    counts = f"{sum(is_found for _, is_found in planted)} of {len(planted)} planted losses are found."
    return Findings(
        [
            subsection("Robots in which something is lost", _losses_table(found)),
            subsection("Files that a converter refuses", _refusals(found)),
            subsection("Planted losses", counts, _planted_table(planted)),
            subsection("The robots", listing(["file"], ((f"`{one.name}`",) for one in found))),
        ],
        counts,
        [*missed, *crashed],
    )


def _failed(file: CorpusFile, why: str) -> Converted:
    return Converted(file.name, refused={"all": why})


def _is_suitable(file: CorpusFile) -> bool:
    if file.row.get("check_urdf") != "ok" or int(file.row.get("joints") or 0) < _FEWEST_JOINTS:
        return False
    return not any(each.is_error for each in twinform.check(without_meshes(file.path.read_bytes())).diagnostics)


def _judge(file: CorpusFile) -> Converted:
    folder = OUT / "usd" / file.name
    urdf = kept(folder / "robot.urdf", without_meshes(file.path.read_bytes()))
    made = Converted(file.name)
    for converter in CONVERTERS:
        try:
            stage = converter.convert(urdf, folder / converter.name.replace(" ", "-"))
            found = twinform.diff(urdf, stage)
        except (RefusedError, twinform.CompileError) as error:
            made.refused[converter.name] = str(error)
            continue
        made.lost[converter.name] = frozenset(map(_kind, found.counted))
        if converter is NEWEST:
            made.planted.extend(_planted(urdf, flat(stage)))
    return made


def _kind(item: Difference) -> tuple[str, bool]:
    """What a difference is about, and whether it is carried."""
    about = f"{item.group}:{item.aspect}{'+' if item.a.text is None and not item.aspect else ''}"
    kind = next((name for name, pattern in _KINDS.items() if re.fullmatch(pattern, about)), _OTHER)
    return kind, item.severity is DifferenceSeverity.CARRIED


def _planted(urdf: Path, text: str) -> list[tuple[str, bool]]:
    before = twinform.diff(urdf, text.encode())
    drawn = islice(losses(text, urdf.parent.name), _PLANTED)
    return [(loss.kind, loss.found_by(twinform.diff(urdf, loss.text.encode()), before)) for loss in drawn]


def _losses_table(found: Sequence[Converted]) -> str:
    columns = [[each.name, *_column(each, found)] for each in CONVERTERS]
    rows = zip(["stages", "the same robot", *_KINDS, _OTHER], *(column[1:] for column in columns), strict=True)
    head = ["lost, or otherwise", *(column[0] for column in columns)]
    return f"In how many robots; behind a plus, in how many only attributes of `urdf:` have it.\n\n{table(head, rows)}"


def _column(converter: Converter, found: Sequence[Converted]) -> Iterator[str]:
    lost = [one.lost[converter.name] for one in found if converter.name in one.lost]
    yield str(len(lost))
    yield str(sum(not each for each in lost))
    for name in (*_KINDS, _OTHER):
        plain, carried = (sum((name, is_carried) in each for each in lost) for is_carried in (False, True))
        yield f"{plain} + {carried}" if carried else str(plain)


def _refusals(found: Sequence[Converted]) -> str:
    met = Counter((name, why) for one in found for name, why in one.refused.items())
    rows = ((count, name, why) for (name, why), count in sorted(met.items()))
    return listing(["robots", "converter", "what it says"], rows)


def _planted_table(planted: Sequence[tuple[str, bool]]) -> str:
    seeded, right = Counter(kind for kind, _ in planted), Counter(kind for kind, is_found in planted if is_found)
    return table(["loss", "planted", "found"], [(kind, seeded[kind], right[kind]) for kind in seeded])


SECTION = Section("usd", _ABOUT, measure, needs=(corpus, need(available, MISSING)))
