"""A feature before every consumer, release by release: what each was seen to do, or what its profile says."""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from reports.who_reads_it.loader_verdicts import asked, difference, is_whole, recalled
from testbed.engines import gazebo
from testbed.engines.gazebo.differing import short
from testbed.engines.readers import Loader, Reading, Verdict
from twinform.compiler.advising import assess_file
from twinform.compiler.input.load_options import LoadOptions
from twinform.profiles import Assessment, Effect, Profile, ProfileRow, every_release
from twinform.profiles.features import PLAIN, Feature, features

READS, WARNS, DIFFERS, REFUSES = VERDICTS = ("reads", "warns", "differs", "refuses")
"""The verdicts of cells, from the best to the worst."""
_OF_LOADERS = {Verdict.ACCEPTS: READS, Verdict.WARNS: WARNS, Verdict.REFUSES: REFUSES}
_OF_ROWS = {Effect.WARNS: WARNS, Effect.DROPS: DIFFERS, Effect.MISREADS: DIFFERS, Effect.REFUSES: REFUSES}
_COUNTING = frozenset({"urdfdom", "gazebo", "dart", "yourdfpy", "urdf-parser-py"})
"""Loaders that keep visuals and collisions, and tell how many."""
_SHAPE = re.compile(r"<(?:visual|collision)[ >/]")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_ELSEWHERE = re.compile(r"\S*/(?=site-packages/|bazel-out/|out/readers/)")
_LONGEST = 200
_STEPS = 50


@dataclass(frozen=True, slots=True)
class Column:
    """A consumer in one of its releases, and the loader that is asked for that, if it is here."""

    profile: Profile
    loader: Loader | None = None

    @property
    def name(self) -> str:
        """The name of the profile with the release, as `--for` takes it."""
        return f"{self.profile.name}@{self.profile.release.name}"

    @property
    def source(self) -> str:
        """How it is known what the consumer does: the version that was asked, or where its rows were read."""
        if self.loader is not None:
            return f"asked: {self.loader.reader.version()}"
        release = self.profile.release
        if release.source:
            return f"by its profile: {release.source}"
        return f"by its profile, which was tested with {release.seen}" if release.seen else "by its profile"


@dataclass(frozen=True, slots=True)
class Cell:
    """What a consumer makes of a feature.

    `measured` is what its loader was seen to do, empty where none was asked, `message` its first line about it, `kept`
    what it has where that differs, and `rows` what the profile says. `disagrees` is how the two differ.
    """

    feature: str
    consumer: str
    verdict: str
    measured: str = ""
    message: str = ""
    kept: str = ""
    rows: tuple[str, ...] = ()
    disagrees: str = ""


@cache
def columns() -> tuple[Column, ...]:
    """All consumers, in each of their releases."""
    loaders = {each.consumer: each for each in asked()}
    found = (Column(each) for each in every_release())
    return tuple(replace(each, loader=loaders.get(each.name)) for each in found)


def cells(feature: Feature) -> list[Cell]:
    """The cells of a feature: one for each consumer that reads its format."""
    pairs = zip(columns(), assessments(feature), strict=True)
    known = ((column, each) for column, each in pairs if each.reads and (each.judgments or each.profile.is_complete))
    return [cell_of(feature, column, each) for column, each in known]


def assessments(feature: Feature) -> list[Assessment]:
    """What the profile of each column says of a feature; what it says of every robot is left to the plain one."""
    told = assess_file(feature.path, [column.profile for column in columns()], LoadOptions())
    if feature.name == PLAIN:
        return [*told]
    return [
        replace(each, judgments=tuple(one for one in each.judgments if one.row not in said))
        for each, said in zip(told, _said_of_every_robot(), strict=True)
    ]


@cache
def _said_of_every_robot() -> list[list[ProfileRow]]:
    return [[judgment.row for judgment in each.judgments] for each in assessments(features()[PLAIN])]


def cell_of(feature: Feature, column: Column, told: Assessment) -> Cell:
    """What a consumer makes of a feature: its loader is asked, if there is one."""
    rows = tuple(dict.fromkeys(f"{each.row.effect}: {each.row.about}" for each in told.judgments))
    by_rows = max((_OF_ROWS[each.row.effect] for each in told.judgments), key=VERDICTS.index, default=READS)
    if column.loader is None:
        return Cell(feature.name, column.name, by_rows, rows=rows)
    reading = _ask(column.loader, feature.path)
    measured = _verdict_of(feature, column.loader, reading)
    verdict = measured if REFUSES in {measured, by_rows} else max(measured, by_rows, key=VERDICTS.index)
    disagrees = difference(feature.path, column.loader, reading, told)
    message = next(iter(reading.error.splitlines() or column.loader.remarks(reading)), "")
    message = _ELSEWHERE.sub("", message)[:_LONGEST].strip()
    kept = _summarize(reading) if measured == DIFFERS else ""
    return Cell(feature.name, column.name, verdict, measured, message, kept, rows, disagrees or "")


def _ask(loader: Loader, path: Path) -> Reading:
    """What a loader reads; Gazebo's engine is asked about SDF, too, which libsdformat alone would take."""
    reading = recalled().ask(loader.reader, path)
    if loader.profile != "gazebo" or path.suffix != ".sdf" or not reading.ok:
        return reading
    run = gazebo.simulate([path], settings=gazebo.Settings(steps=_STEPS, folders=(path.parent,)))[path.resolve()]
    if not run.done:
        return replace(reading, error=f"DART {run.outcome} at {run.stage}: {'; '.join(run.console.errors)}")
    lines = [f"Error [DART]: {line}" for line in run.console.errors if line not in reading.output]
    stiff = [joint for joint in run.joints if joint.kind != "fixed" and not joint.freedom]
    kept = reading.kept and replace(
        reading.kept,
        joints=tuple(name for name in reading.kept.joints if name not in {short(each.name) for each in stiff}),
    )
    return replace(reading, output="\n".join([reading.output, *lines]), kept=kept)


def _verdict_of(feature: Feature, loader: Loader, reading: Reading) -> str:
    """The verdict of a loader; it differs where joints that move, masses or shapes are not those of the file."""
    verdict = _OF_LOADERS[loader.verdict(reading)]
    if verdict == REFUSES or reading.kept is None:
        return verdict
    shapes = len(_SHAPE.findall(_COMMENT.sub("", feature.text)))
    counted = loader.profile not in _COUNTING or reading.kept.shapes == shapes or "<include" in feature.text
    return verdict if counted and is_whole(feature.path, loader, reading.kept) else DIFFERS


def _summarize(reading: Reading) -> str:
    """What a reader keeps, such as `links a, b; joints j; 2 kg; 1 shape`."""
    if not reading.ok or reading.kept is None:
        return ""
    kept = reading.kept
    parts = [f"links {', '.join(kept.links)}" if kept.links else "no link"]
    parts += [f"joints {', '.join(kept.joints)}" if kept.joints else "no joint", f"{kept.mass:.6g} kg"]
    parts += [f"{kept.shapes} shape{'' if kept.shapes == 1 else 's'}"] if kept.shapes is not None else []
    return "; ".join(parts)


def as_json(found: Iterable[Cell], every: Mapping[str, Feature]) -> str:
    """The document of `cells.json`, with a line for each consumer, feature and cell."""
    consumers = (
        {
            "name": each.name,
            "title": each.profile.title,
            "release": each.profile.release.name,
            "also": [*each.profile.release.also],
            "formats": [*each.profile.formats],
            "measured": each.loader is not None,
            "source": each.source,
        }
        for each in columns()
    )
    known = (
        {"name": each.name, "format": each.format, "title": each.title, "question": each.question, "file": each.text}
        for each in every.values()
    )
    parts = {"consumers": consumers, "features": known, "cells": map(_row, found)}
    return "{\n" + ",\n".join(f'"{name}": [\n{_lines(rows)}\n]' for name, rows in parts.items()) + "\n}\n"


def _row(cell: Cell) -> dict[str, Any]:
    return {name: value for name, value in asdict(cell).items() if value}


def _lines(rows: Iterable[Mapping[str, Any]]) -> str:
    return ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows)


def read_cells(path: Path) -> list[Cell]:
    """The cells of an earlier run; none where there is no such file."""
    if not path.is_file():
        return []
    rows: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [replace(Cell(**row), rows=tuple(row.get("rows", ()))) for row in rows]


def changes(before: Iterable[Cell], now: Iterable[Cell]) -> Iterator[str]:
    """What changed from one run to the next: cells that are new or gone, and those with another verdict."""
    old, new = ({(each.feature, each.consumer): each for each in found} for found in (before, now))
    for key in sorted(old.keys() | new.keys()):
        was, now_ = (found[key].verdict if key in found else "not there" for found in (old, new))
        if was != now_:
            yield f"{key[0]}: {key[1]}: {was} -> {now_}"
        elif old[key].measured != new[key].measured:
            yield f"{key[0]}: {key[1]}: seen: {old[key].measured or 'not asked'} -> {new[key].measured or 'not asked'}"
