"""One robot, what it is converted to, and what libsdformat 12 makes of both."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from tempfile import TemporaryDirectory

import twinform
from testbed.corpus.examine import rules_of
from testbed.corpus.files import CorpusFile, Kind
from testbed.corpus.there_and_back import SDF_VERSION, robots
from testbed.equipment.differences import Difference, differences
from testbed.equipment.saying import Said
from testbed.markdown import without_names
from twinform.diagnostics import Ledger, LedgerEntry
from twinform.testing.oracles.libsdformat import RobotRow, describe, models_of

_QUOTED = re.compile(r"'([^']*)'")
_NAMED = re.compile(r"\[@name='([^']*)'\]")


class Verdict(StrEnum):
    """What became of the equipment of a robot."""

    SAME = "same"
    SAID = "as the conversion says"
    DIFFERENT = "different"
    RESULT = "result not readable"
    REFUSED = "not converted"


@dataclass(frozen=True, slots=True)
class Outcome:
    """A robot, how many parts of it were compared, and what differs; `silent` is what the conversion does not say."""

    name: str
    verdict: Verdict
    parts: int = 0
    cause: str = ""
    found: tuple[Difference, ...] = ()
    silent: tuple[Difference, ...] = ()


def judge(file: CorpusFile) -> tuple[Outcome, ...]:
    """What became of every robot of a file, or of the first few; none where libsdformat reads none."""
    checked = twinform.check(file.path, paths=file.paths)
    if checked.document is None or not checked.accepted:
        return ()
    if file.kind is Kind.URDF:
        return (judged_urdf(file),)
    _, rows = models_of(file.path, file.paths)
    among = {row["name"]: row for row in rows}
    named = (
        (robot, robot.rpartition("::")[2] if robot else next(iter(among), "")) for robot in robots(checked.document)
    )
    return tuple(judged_sdf(file, robot, among[name]) for robot, name in named if name in among)


def judged_sdf(
    file: CorpusFile, robot: str | None, before: RobotRow, read: Callable[[Path], RobotRow] = describe
) -> Outcome:
    """What became of a robot of an SDF file; `before` is what `read` finds in it."""
    name, parts = f"{file.name} {robot or ''}".strip(), _parts(before)
    try:
        conversion = twinform.convert(file.path, to="urdf", model=robot, paths=file.paths)
        after = _result(conversion, "robot.urdf", read)
    except twinform.CompileError as error:
        return Outcome(name, Verdict.REFUSED, parts, ", ".join(rules_of(error.diagnostics)))
    except RuntimeError as error:
        return Outcome(name, Verdict.RESULT, parts, str(error)[:200])
    return _outcome(name, before, after, lambda found: _is_listed(found, conversion.ledger))


def judged_urdf(file: CorpusFile, read: Callable[[Path], RobotRow] = describe) -> Outcome:
    """What became of a URDF, which is the robot afterwards here, as libsdformat lumps links there."""
    before = read(file.path)
    try:
        conversion = twinform.convert(file.path, to="sdf", sdf_version=SDF_VERSION, paths=file.paths)
        after = _result(conversion, "robot.sdf", read)
    except twinform.CompileError as error:
        return Outcome(file.name, Verdict.REFUSED, _parts(before), ", ".join(rules_of(error.diagnostics)))
    except RuntimeError as error:
        return Outcome(file.name, Verdict.RESULT, _parts(before), str(error)[:200])
    return _outcome(file.name, after, before, Said.by(conversion).explains)


def _result(conversion: twinform.Conversion, name: str, read: Callable[[Path], RobotRow]) -> RobotRow:
    with TemporaryDirectory() as folder:
        output = Path(folder, name)
        output.write_text(conversion.text, encoding="utf-8")
        return read(output)


def _outcome(name: str, before: RobotRow, after: RobotRow, is_said: Callable[[Difference], bool]) -> Outcome:
    found = tuple(differences(before, after))
    silent = tuple(each for each in found if not is_said(each))
    verdict = Verdict.DIFFERENT if silent else Verdict.SAID if found else Verdict.SAME
    return Outcome(name, verdict, _parts(before), str(silent[0]) if silent else "", found, silent)


def _parts(robot: RobotRow) -> int:
    """How many parts there are to compare: what sets a value, sensors and plugins."""
    shapes = [shape for link in robot["links"] for shape in link["shapes"]]
    setting = sum(bool(row["values"]) for row in (robot, *robot["links"], *shapes))
    return setting + len(robot["sensors"]) + len(robot["plugins"])


def _is_listed(found: Difference, ledger: Ledger) -> bool:
    """Whether an entry of the ledger is about the value, about something in it, or about the part around it."""
    return any(
        _covers(entry.location.path, found) or _is_followed(entry, found) or _is_replaced(entry, found)
        for entry in ledger.entries
    )


def _is_replaced(entry: LedgerEntry, found: Difference) -> bool:
    """Whether a shape of the URDF stands for one that URDF lacks: its name, as libsdformat makes it, has that one's."""
    names = _NAMED.split(entry.location.path)[1::2]
    if entry.rule.name != "replaced-shape" or len(names) < 2 or len(found.parts) < 2:
        return False
    if found.kind == "sensor":  # one of contacts feels the ends of a capsule by their own names
        return found.path.startswith("/sensor/contact/collision")
    return found.parts[-2].endswith(names[-2]) and names[-1] in found.parts[-1]


def _is_followed(entry: LedgerEntry, found: Difference) -> bool:
    """Whether a plugin names what has another name in URDF, which it follows."""
    if entry.rule.name != "renamed" or found.kind != "plugin":
        return False
    return any(f"={name} " in f"{found.path} " for name in _QUOTED.findall(entry.message))


def _covers(path: str, found: Difference) -> bool:
    *names, rest = _NAMED.split(path)
    wanted = [name for part in found.parts for name in part.split("::")]
    if names[1::2][-len(wanted) :] != wanted:
        return False
    here = ["plugin"] if found.kind == "plugin" else _steps(found.path)  # whose path is all that is in it
    steps = zip(_steps(without_names(rest)), here, strict=False)
    return all(one == other for one, other in steps)


def _steps(path: str) -> list[str]:
    return [step for step in path.split("/") if step]
