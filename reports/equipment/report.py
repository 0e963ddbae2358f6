"""Sensors and plugins as libsdformat 12 finds them in SDF, and in the URDF that is made of it.

It reads a robot in SDF, and the URDF that we make of it, which it turns into SDF as Gazebo does. It reports where every
sensor is and what is in it; its own descriptions of both are compared.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from lxml import etree

import twinform
from reports.harness.known import Known
from reports.harness.needs import corpus, libsdformat
from reports.harness.pages import section, table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample, is_good
from tests.corpus.examine import rules_of
from tests.corpus.files import CorpusFile, Kind
from tests.corpus.there_and_back import robots
from twinform.schemas import XmlElement
from twinform.testing.oracles.libsdformat.library import RobotRow, describe
from twinform.testing.oracles.libsdformat.robot import pose_matrix
from twinform.testing.oracles.robot import Matrix

KNOWN = Known.beside(__file__)
CUT_OFF = 1e-5
"""The tolerance for poses, in m and as entries of a rotation: libsdformat keeps six digits where it lumps links."""
_ABOUT = f"""\
Every SDF file of the corpus with one model, with sensors or plugins, that libsdformat 12 takes without an error, is
converted to URDF. libsdformat 12 reads both, and turns the URDF into SDF as Gazebo does. A sensor has to be there again
with its name, type and content, at the same place of the world (robot at its zero position; tolerance {CUT_OFF:g}, as
libsdformat writes six digits of a pose where it lumps links), a plugin with its content, in the same kind of element.
Numbers are compared as numbers, and the order of elements does not count, nor do carriers of our own namespace."""


class Verdict(StrEnum):
    """What became of the equipment of a file."""

    SAME = "same"
    DIFFERENT = "different"
    RESULT = "result not readable"
    REFUSED = "not converted"


@dataclass(frozen=True, slots=True)
class Outcome:
    """A file, how many sensors and plugins it has, and what became of them."""

    name: str
    verdict: Verdict
    sensors: int = 0
    plugins: int = 0
    cause: str = ""


@dataclass(frozen=True, slots=True)
class _Sensor:
    """What has to be the same of a sensor; `pose` is that in the world."""

    key: tuple[str, ...]
    pose: Matrix


def measure(sample: Sample) -> Findings:
    """Convert, read, and compare."""
    files = filter(is_good, sample.models(Kind.SDF))
    outcomes = sample.outcomes(judge, files, lambda file, why: Outcome(file.name, Verdict.RESULT, cause=why))
    reasons = {one.name: KNOWN.why("known", one.name) for one in outcomes if one.verdict is not Verdict.SAME}
    bad = [one for one in outcomes if one.verdict in {Verdict.DIFFERENT, Verdict.RESULT} and not reasons[one.name]]
    faults = [f"{one.name}: {one.verdict}: {one.cause}" for one in bad]
    sections = list(_sections(outcomes, reasons))
    return Findings(sections, sections[0], faults)


def judge(file: CorpusFile) -> Outcome | None:
    """What became of the sensors and plugins of a file; None where it has none, or several models."""
    checked = twinform.check(file.path)
    if checked.document is None or not checked.accepted or robots(checked.document) != [None]:
        return None
    try:
        before = describe(file.path)
    except RuntimeError:  # it is an include that leads nowhere, or has no model
        return None
    count = len(before["sensors"]), len(before["plugins"])
    if not any(count):
        return None
    try:
        text = twinform.convert(file.path, to="urdf", paths=file.paths).text
    except twinform.CompileError as error:
        return Outcome(file.name, Verdict.REFUSED, *count, ", ".join(rules_of(error.diagnostics)))
    with TemporaryDirectory() as folder:
        output = Path(folder, "robot.urdf")
        output.write_text(text, encoding="utf-8")
        try:
            missing = list(differences(before, describe(output)))
        except RuntimeError as error:
            return Outcome(file.name, Verdict.RESULT, *count, str(error)[:200])
    return Outcome(file.name, Verdict.DIFFERENT if missing else Verdict.SAME, *count, "; ".join(missing)[:400])


def differences(before: RobotRow, after: RobotRow) -> Iterator[str]:
    """What only one of the two has, and sensors that have moved."""
    here, there = list(_sensors(before)), list(_sensors(after))
    yield from _only(Counter(one.key[:2] for one in here), Counter(one.key[:2] for one in there))
    for key in dict.fromkeys(one.key for one in here):
        named = [one for one in there if one.key[:2] == key[:2]]
        equal = [one for one in named if one.key == key]
        if named and not equal:
            differing = sorted({*key[2:]} ^ {*named[0].key[2:]})
            yield f"sensor {key[0]} has other content: {', '.join(differing)[:160]}"
        for one in (one for one in here if one.key == key):
            if equal and (far := min(float(np.abs(one.pose - other.pose).max()) for other in equal)) > CUT_OFF:
                yield f"sensor {key[0]} has moved by {far:.2g}"
    yield from _only(Counter(_plugins(before)), Counter(_plugins(after)))


def _only(here: Counter[tuple[str, ...]], there: Counter[tuple[str, ...]]) -> Iterator[str]:
    yield from (f"lost: {' '.join(key)[:120]}" for key in here - there)
    yield from (f"added: {' '.join(key)[:120]}" for key in there - here)


def _sensors(robot: RobotRow) -> Iterator[_Sensor]:
    frame = pose_matrix(robot["pose"])
    for row in robot["sensors"]:
        yield _Sensor((row["name"], row["kind"], *_content(row["text"])), frame @ pose_matrix(row["pose"]))


def _plugins(robot: RobotRow) -> Iterator[tuple[str, ...]]:
    for row in robot["plugins"]:
        yield (row["inside"], *_content(row["text"]))


def _content(text: str) -> list[str]:
    """Every attribute and text of some XML with its path, sorted."""
    # where libsdformat writes a prefix that it does not declare, the parser goes on
    root = etree.fromstring(text.encode(), etree.XMLParser(recover=True, remove_comments=True))
    return sorted(_leaves(root, ""))


def _leaves(element: XmlElement, around: str) -> Iterator[str]:
    path = f"{around}/{element.tag}"
    yield f"{path}={_spelt(element.text or '')}"
    yield from (f"{path}@{name}={_spelt(str(value))}" for name, value in element.items())
    for child in element:
        if not str(child.tag).startswith("tf:"):  # a carrier, which Gazebo passes over
            yield from _leaves(child, path)


def _spelt(text: str) -> str:
    return " ".join(map(_number, text.split()))


def _number(text: str) -> str:
    try:
        return f"{float(text) + 0.0:.10g}"
    except ValueError:
        return text


def _sections(outcomes: list[Outcome], reasons: dict[str, str]) -> Iterator[str]:
    rows = [
        (verdict, len(one), sum(each.sensors for each in one), sum(each.plugins for each in one))
        for verdict in Verdict
        if (one := [each for each in outcomes if each.verdict is verdict])
    ]
    yield table(["verdict", "files", "sensors", "plugins"], rows)
    others = [one for one in outcomes if one.verdict is not Verdict.SAME]
    if others:
        why = ((one.name, one.verdict, reasons[one.name] or one.cause) for one in others)
        yield section("What is not the same, and why", table(["file", "verdict", "why"], why))


_TITLE = "Sensors and plugins of SDF, in the URDF that Gazebo reads"
REPORT = Report("equipment", _TITLE, _ABOUT, measure, (corpus, libsdformat), KNOWN)
