"""One file before every loader and its profile: what each does with it, and where the two differ."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from pathlib import Path

from lxml import etree

from testbed.engines.readers import LOADERS, Kept, Loader, Reading, Verdict
from testbed.engines.readers.recalled import Recalled
from testbed.output_files import OUT
from twinform.compiler.advising import assess_file
from twinform.compiler.input.load_options import LoadOptions
from twinform.profiles import Assessment, Effect, Judgment, parse
from twinform.schemas import XmlElement

_MOVING = frozenset({"revolute", "continuous", "prismatic"})
_LOSING = frozenset({Effect.DROPS, Effect.MISREADS})
_WORLDLY = frozenset({"mujoco"})
"""Loaders that make what stands still a part of the world, which has no mass: what moves has to be there."""
_LIGHT = 1e-6
"""Masses that differ by less than this part of them are the same: some loaders keep single precision."""


class Difference(StrEnum):
    """How a loader and its profile differ about a file."""

    THEY_REFUSE = "it refuses, the profile does not"
    WE_REFUSE = "the profile refuses, it does not"
    THEY_REMARK = "it warns, the profile has nothing"
    WE_REMARK = "the profile warns, it does not"
    KEPT = "it keeps less, the profile has nothing"


@dataclass(frozen=True, slots=True)
class Job:
    """A file, and a name for it."""

    name: str
    path: Path


@dataclass(frozen=True, slots=True)
class Pair:
    """A file before one loader: its verdict, what it says, what the profile says, and how the two differ."""

    name: str
    loader: str
    verdict: Verdict
    theirs: str
    ours: str
    difference: Difference | None


@cache
def recalled() -> Recalled:
    """The readings that are known already."""
    return Recalled(OUT / "loaders" / "readings.sqlite")


@cache
def asked() -> tuple[Loader, ...]:
    """The loaders that are here."""
    return tuple(loader for loader in LOADERS if loader.reader.present())


def pairs(job: Job) -> list[Pair]:
    """The file before every loader that reads its format."""
    loaders = [loader for loader in asked() if job.path.suffix in loader.reader.formats]
    profiles = parse(",".join(loader.consumer for loader in loaders))
    assessed = assess_file(job.path, profiles, LoadOptions())
    return [_pair(job, *each) for each in zip(loaders, assessed, strict=True)]


def _pair(job: Job, loader: Loader, assessment: Assessment) -> Pair:
    reading = recalled().ask(loader.reader, job.path)
    verdict = loader.verdict(reading)
    theirs = reading.error or " / ".join(loader.remarks(reading))
    ours = " / ".join(
        f"{each.row.effect}: {each.finding.rule.name}: {each.finding.message}" for each in _worst(assessment)
    )
    return Pair(job.name, loader.consumer, verdict, theirs, ours, difference(job.path, loader, reading, assessment))


def _worst(assessment: Assessment) -> Iterator[Judgment]:
    for effect in Effect:
        yield from assessment.by(effect)


def difference(path: Path, loader: Loader, reading: Reading, assessment: Assessment) -> Difference | None:
    """How a loader and its profile differ about a file; None where they agree."""
    verdict, effects = loader.verdict(reading), {each.row.effect for each in assessment.judgments}
    refused = not assessment.reads or Effect.REFUSES in effects
    if refused != (verdict is Verdict.REFUSES):
        return Difference.WE_REFUSE if refused else Difference.THEY_REFUSE
    if refused:
        return None
    if verdict is Verdict.WARNS and not effects:
        return Difference.THEY_REMARK
    if verdict is Verdict.ACCEPTS and effects == {Effect.WARNS}:
        return Difference.WE_REMARK
    if reading.kept is not None and not effects & _LOSING and not is_whole(path, loader, reading.kept):
        return Difference.KEPT
    return None


def is_whole(path: Path, loader: Loader, kept: Kept) -> bool:
    """Whether all joints that move are there, and all of the mass where the file has one for every link."""
    found = _contents(path)
    if not found.joints <= {*kept.joints, *(name.rpartition("::")[2] for name in kept.joints)}:
        return False
    if loader.profile in _WORLDLY:  # and bodies without an inertial get the mass of their shapes
        return kept.mass >= found.moving * (1 - _LIGHT) or not math.isfinite(found.moving)
    return found.mass is None or _is_same(kept.mass, found.mass)


def _is_same(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=_LIGHT) or (math.isnan(one) and math.isnan(other))


@dataclass(frozen=True, slots=True)
class _Contents:
    """The joints of a file that turn or slide, its mass, and the part of that which moves; None and 0 if unreadable."""

    joints: frozenset[str]
    mass: float | None
    moving: float


@cache
def _contents(path: Path) -> _Contents:
    root = etree.parse(path, etree.XMLParser(recover=True)).getroot()
    if path.suffix == ".sdf":
        return _contents_of_sdf(root)
    joints = frozenset(joint.get("name", "") for joint in root.findall("joint") if joint.get("type") in _MOVING)
    masses: dict[str, float] = {}
    try:
        for link in root.findall("link"):
            mass = link.find("inertial/mass")
            masses[link.get("name", "")] = 0.0 if mass is None else float(mass.get("value", ""))
    except ValueError:
        return _Contents(joints, None, 0.0)
    still = _standing_still(root, masses)
    return _Contents(joints, sum(masses.values()), sum(mass for name, mass in masses.items() if name not in still))


def _contents_of_sdf(root: XmlElement) -> _Contents:
    joints = frozenset(joint.get("name", "") for joint in root.iter("joint") if joint.get("type") != "fixed")
    masses = [link.findtext("inertial/mass") for link in root.iter("link")]
    if root.find(".//include") is not None:
        return _Contents(joints, None, 0.0)
    try:
        # a link without a mass has 1 kg in SDF
        return _Contents(joints, sum(1.0 if mass is None else float(mass) for mass in masses), 0.0)
    except ValueError:
        return _Contents(joints, None, 0.0)


def _standing_still(root: XmlElement, links: Iterable[str]) -> set[str]:
    """The links above which is no joint, or fixed ones alone."""
    above: dict[str, tuple[str, str]] = {}
    for joint in root.findall("joint"):
        parent, child = joint.find("parent"), joint.find("child")
        if parent is not None and child is not None:
            above[child.get("link", "")] = (joint.get("type", ""), parent.get("link", ""))
    still = {name for name in links if name not in above}
    while new := {name for name, (kind, parent) in above.items() if kind == "fixed" and parent in still} - still:
        still |= new
    return still
