"""Corpus files that were converted for Gazebo, in its physics: what is refused, frozen, left out or ended with."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import cast

from lxml import etree

import twinform
from reports.harness.known import Known
from testbed import output_files
from testbed.corpus.files import CorpusFile
from testbed.engines import gazebo
from testbed.output_files import kept
from twinform.compiler.workers import Failure, run
from twinform.schemas import XmlElement

OUT = output_files.OUT / "gazebo_ready"
KNOWN = Known(Path(__file__).with_name("gazebo_ready.toml"))
PROFILE = "gazebo@fortress"
SETTINGS = gazebo.Settings(steps=200, dt=0.001, start=0.5)
ENGINES = (gazebo.PhysicsEngine.DART, gazebo.PhysicsEngine.BULLET)
_MOVING = frozenset({"revolute", "continuous", "prismatic", "screw", "universal", "revolute2", "ball", "gearbox"})
_ENGINES = ("rare-joint-type", "two-parents", "kinematic-loop")
"""Rules about what engines do with joints, before others that only have the name of the joint."""
_FIRST_ALONE = ("several-at-top", "repeated-element: <model>")
_LIGHT = 1e-6
"""Masses that differ by less than this part of them are the same: Bullet has single precision."""


class Fault(StrEnum):
    """What must not happen to a file that was converted for Gazebo."""

    REFUSED = "refused"
    ENDED = "ended with"
    FROZEN = "a joint is held fast or left out"
    GONE = "a joint of the source is not in the result"
    DROPPED = "a link is left out"
    LIGHTER = "mass is left out"


@dataclass(frozen=True, slots=True)
class Robot:
    """What a text has: its joints that move and its links, by their own names, and the mass of all links in kg."""

    moving: frozenset[str]
    links: frozenset[str]
    mass: float
    nested: frozenset[str]
    """The links and joints that are in a model in a model, and joints that name one of these."""


@dataclass(frozen=True, slots=True)
class Made:
    """A conversion: the path of the result, None where there is none, and all that was said about it."""

    path: Path | None
    told: tuple[str, ...]
    source: Robot | None = None
    result: Robot | None = None
    is_physics_kept: bool = True


@dataclass(frozen=True, slots=True)
class Finding:
    """A fault in an engine; `why` says what the conversion reported about it, or why it is right, if it is known."""

    name: str
    engine: str
    fault: Fault
    what: str
    why: str


def outcomes(sample: Iterable[CorpusFile]) -> tuple[dict[str, Made], list[Finding]]:
    """Convert every file, and ask every engine that is here about each result."""
    results = run(_converted, list(sample), processes=2)
    made = {file.name: result for file, result in results if not isinstance(result, Failure)}
    found = [
        Finding(file.name, "", Fault.REFUSED, str(each), "") for file, each in results if isinstance(each, Failure)
    ]
    found += [each for name, one in made.items() if one.path for each in _find_losses(name, one)]
    for engine in filter(gazebo.available, ENGINES):
        seen = gazebo.simulate((one.path for one in made.values() if one.path), engine, SETTINGS)
        for name, one in made.items():
            if one.path:
                found += _findings(name, engine, one, seen[one.path.resolve()])
    return made, found


def _converted(file: CorpusFile) -> Made:
    try:
        made = twinform.convert(file.path, to="sdf", profiles=PROFILE, paths=file.paths, expand_includes=True)
    except twinform.CompileError as error:
        return Made(None, tuple(f"{each.rule.name}: {each.message}" for each in error.diagnostics if each.is_error))
    entries = made.ledger.entries
    path = kept(OUT / f"{file.name}.sdf", made.text)
    told = (*(f"{each.rule.name}: {each.message}" for each in made.diagnostics), *(each.message for each in entries))
    robots = _robot(file.path.read_bytes()), _robot(made.text.encode())
    return Made(path, told, *robots, not any(each.change for each in entries))


def _robot(text: bytes) -> Robot:
    """What is written in a text, by lxml alone; numbers that are none weigh nothing."""
    parser = etree.XMLParser(recover=True, huge_tree=True)
    root = cast("XmlElement | None", etree.fromstring(text, parser)) if text.strip() else None
    if root is None:
        return Robot(frozenset(), frozenset(), 0.0, frozenset())
    for static in [each for each in root.iter("static") if (each.text or "").strip() in {"1", "true"}]:
        if (model := static.getparent()) is not None and (above := model.getparent()) is not None:
            above.remove(model)
    for other in [each for each in root.iter() if _is_no_physics(each)]:
        other.clear()
    joints = (each.get("name", "") for each in root.iter("joint") if each.get("type") in _MOVING and len(each))
    links = [each for each in root.iter("link") if each.get("name")]
    default = 0.0 if root.tag == "robot" else 1.0
    inside = root.xpath("//model//model/link | //model//model/joint | //model/joint[contains(., '::')]")
    names = frozenset(each.get("name", "") for each in links)
    mass = sum(_mass(each, default) for each in links)
    return Robot(frozenset(joints), names, mass, frozenset(each.get("name", "") for each in inside))


def _is_no_physics(element: XmlElement) -> bool:
    """Whether what is inside is no part of a robot: plugins, actors, states, and what is of another namespace."""
    name = element.tag if isinstance(element.tag, str) else ""
    return element.getparent() is not None and (name in {"plugin", "actor", "state"} or ":" in name or "{" in name)


def _mass(link: XmlElement, default: float) -> float:
    element = link.find("inertial/mass")
    if element is None:
        return default
    text = element.get("value") or element.text or ""
    try:
        return float(text)
    except ValueError:
        return 0.0


def _find_losses(name: str, made: Made) -> Iterator[Finding]:
    """What is in the source and not in the result, or in the result with another mass."""
    source, result = made.source, made.result
    if source is None or result is None:
        return
    for joint in sorted({_unscoped(each) for each in source.moving} - {_unscoped(each) for each in result.moving}):
        yield _finding(name, "", Fault.GONE, f"joint {joint}", made)
    if made.is_physics_kept and result.mass < source.mass * (1 - _LIGHT):
        yield _finding(name, "", Fault.LIGHTER, f"{source.mass:g} kg become {result.mass:g} kg", made)


def _findings(name: str, engine: str, made: Made, seen: gazebo.Simulation) -> Iterator[Finding]:
    if seen.outcome is gazebo.Outcome.REFUSED:
        yield _finding(name, engine, Fault.REFUSED, "; ".join(seen.errors), made)
    elif not seen.done:
        yield _finding(name, engine, Fault.ENDED, f"{seen.stage}: {'; '.join(seen.console.errors)}", made)
    else:
        yield from (_finding(name, engine, *each, made) for each in _shortcomings(made, seen))


def _shortcomings(made: Made, seen: gazebo.Simulation) -> Iterator[tuple[Fault, str]]:
    for joint in seen.joints:
        if joint.kind != "fixed" and not joint.freedom:
            yield Fault.FROZEN, f"joint {_unscoped(joint.name)}: {joint.kind}"
    there = {_unscoped(link.name) for link in seen.links}
    for link in sorted(made.result.links - there if made.result else ()):
        yield Fault.DROPPED, f"link {link}"
    weighed = [link.mass for link in seen.links if link.mass is not None]
    if made.result and weighed and sum(weighed) < made.result.mass * (1 - _LIGHT):
        yield Fault.LIGHTER, f"{made.result.mass:g} kg are {sum(weighed):g} kg"


def _unscoped(name: str) -> str:
    return name.rpartition("::")[2]


def _finding(name: str, engine: str, fault: Fault, what: str, made: Made) -> Finding:
    known = KNOWN.why("known", file=name, engine=engine, fault=fault, what=what)
    return Finding(name, engine, fault, what, known or _reported(engine, fault, what, made))


def _reported(engine: str, fault: Fault, what: str, made: Made) -> str:
    """What the conversion itself said about the joint or link, by the rule; empty where it was silent."""
    part = re.fullmatch(r"(?:joint|link) (.*?)(?:: \w+)?", what)
    if engine is gazebo.PhysicsEngine.BULLET and fault in {Fault.DROPPED, Fault.FROZEN, Fault.LIGHTER}:
        nested = any(each.startswith("nested-in-engine") for each in made.told)
        if nested and (part is None or (made.result and part[1] in made.result.nested)):
            return "reported: nested-in-engine"
    if fault in {Fault.DROPPED, Fault.LIGHTER} and any(each.startswith(_FIRST_ALONE) for each in made.told):
        return "reported: several-at-top"
    if fault is Fault.LIGHTER and any(each.startswith("world-link") for each in made.told):
        return "reported: world-link"
    if fault is Fault.FROZEN and any(each.startswith("kinematic-loop") for each in made.told):
        return "reported: kinematic-loop"
    if part is None or fault in {Fault.REFUSED, Fault.ENDED, Fault.LIGHTER}:
        return ""
    about = next((each for each in made.told if each.startswith(_ENGINES) and repr(part[1]) in each), "")
    about = about or next((each for each in made.told if repr(part[1]) in each), "")
    return f"reported: {about.partition(':')[0]}" if about else ""
