"""The catalogue against the sources of Gazebo: `make systems SOURCES=PATH,...` writes docs/reference/systems.md.

Each path is a checkout of gz-sim (ign-gazebo) or of gz-sensors (ign-sensors) of one release, such as
`git worktree add ../gz-sim8 gz-sim8` makes it. Nothing of their text is kept: names, types, defaults and topics are
facts, and only these are compared.
"""

import re
import sys
import tomllib
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from benchmarks.markdown import table, write
from benchmarks.sensors_reading import COMPARED, sensors_in
from benchmarks.systems_judging import Difference, is_of_sim, of_sensors, of_systems
from benchmarks.systems_reading import systems_in
from tests.corpus.files import ROOT
from twinform.passes.plugins.catalogue import LATEST, releases, sensors, systems

PAGE = ROOT / "docs" / "reference" / "systems.md"
MISSING = "no sources: say SOURCES=PATH,... with checkouts of gz-sim and gz-sensors, one for each release"
INTRODUCTION = """# The catalogue against the sources of Gazebo

Made by `make systems SOURCES=...` from checkouts of gz-sim and gz-sensors, by the words that their C++ reads elements,
attributes and defaults with. Compared are, for every system: the parameters by name (wherever they stand in the
plugin), whether they are elements or attributes, the kinds of their values, their defaults, the words of topics and
the messages; for every sensor: the suffix of its default topic, what is published beside it, and the messages.
Releases say which systems they have.

*=* is without a difference, a number counts differences that are explained below; *-* is a release that has none."""
_KNOWN = Path(__file__).with_name("systems_known.toml")
_PROJECT = re.compile(r"project\s*\(\s*(?:gz|ignition)-(sim|gazebo|sensors)\d*\s+VERSION\s+(\d+)\.([\d.]+)")


@dataclass(frozen=True, slots=True)
class Checkout:
    """The sources of one version: `part` is `sim` or `sensors`."""

    path: Path
    part: str
    version: int
    full: str


def main(words: list[str]) -> int:
    """Compare, report, and fail where something is not explained."""
    paths = [Path(word) for each in words for word in each.split(",") if word]
    if not paths:
        print(MISSING)
        return 0
    checkouts = list(map(checkout, paths))
    found = differences(checkouts)
    if not found:
        print("none of these is gz-sim of a release in the catalogue", file=sys.stderr)
        return 1
    known: dict[str, str] = tomllib.loads(_KNOWN.read_text(encoding="utf-8"))["known"]
    unexplained = [(one, release) for release, many in found.items() for one in many if not why(one, known)]
    unused = _unused(found, known) if len(found) > len(releases()) else []
    write(PAGE, INTRODUCTION, *_sections(found, known, checkouts))
    for one, names in _by_difference(unexplained).items():
        print(f"{one.key}: here {one.here or '-'}, there {one.there or '-'} ({', '.join(names)})", file=sys.stderr)
    print(*(f"explained, and not there: {key}" for key in unused), sep="\n", file=sys.stderr)
    print(f"{sum(map(len, found.values()))} differences, {len(unexplained)} without a reason; see {PAGE.name}")
    return 1 if unexplained or unused else 0


def checkout(path: Path) -> Checkout:
    """The checkout in a folder.

    Raises:
        SystemExit: it is none of gz-sim or gz-sensors.
    """
    build = path / "CMakeLists.txt"
    found = _PROJECT.search(build.read_text(encoding="utf-8")) if build.is_file() else None
    if found is None:
        raise SystemExit(f"{path} is no checkout of gz-sim or gz-sensors")
    return Checkout(path, found[1].replace("gazebo", "sim"), int(found[2]), f"{found[2]}.{found[3]}")


def differences(checkouts: list[Checkout]) -> dict[str, list[Difference]]:
    """The differences by release, oldest first."""
    found: dict[str, list[Difference]] = {}
    for name, version in _sims().items():
        sim, beside = (_has(checkouts, part, version) for part in ("sim", "sensors"))
        if sim is not None:
            found[name] = list(of_systems(systems_in(sim.path), name))
        if sim is not None and beside is not None:
            found[name] += of_sensors(dict(sensors_in(sim.path, beside.path)), name)
    return found


def _sims() -> dict[str, int]:
    """The versions of gz-sim by release; gz-sensors has the same, and the development branch the next one."""
    found = {name: release.sim for name, release in releases().items()}
    return found | {LATEST: max(found.values()) + 1}


def _has(checkouts: list[Checkout], part: str, version: int) -> Checkout | None:
    return next((each for each in checkouts if (each.part, each.version) == (part, version)), None)


def why(difference: Difference, known: dict[str, str]) -> str:
    """Why a difference is right; empty where nobody has looked at it."""
    return next((reason for key, reason in known.items() if fnmatchcase(difference.key, key)), "")


def _unused(found: dict[str, list[Difference]], known: dict[str, str]) -> list[str]:
    keys = {one.key for many in found.values() for one in many}
    return [pattern for pattern in known if not any(fnmatchcase(key, pattern) for key in keys)]


def _by_difference(found: Iterable[tuple[Difference, str]]) -> dict[Difference, list[str]]:
    names: defaultdict[Difference, list[str]] = defaultdict(list)
    for one, release in found:
        names[one].append(release)
    return dict(sorted(names.items()))


def _sections(found: dict[str, list[Difference]], known: dict[str, str], checkouts: list[Checkout]) -> Iterator[str]:
    versions = sorted(checkouts, key=lambda each: (each.part, each.version))
    yield "Read: " + ", ".join(f"gz-{each.part} {each.full}" for each in versions) + "."
    yield "## Systems\n\n" + _matrix(
        found, {kind.name: kind.releases for kind in systems().values() if is_of_sim(kind)}
    )
    read = {name for name, release in _sims().items() if _has(checkouts, "sensors", release)}
    of_sensors = {f"sensor {type_}": sensors()[type_].releases & read for type_ in COMPARED}
    yield "## Sensors\n\n" + _matrix(found, of_sensors)
    every = _by_difference((one, release) for release, many in found.items() for one in many)
    rows = [
        (one.owner, one.kind, one.what, one.here or "-", one.there or "-", ", ".join(names), why(one, known) or "**?**")
        for one, names in every.items()
    ]
    head = ["of", "what", "name", "catalogue", "source", "releases", "why"]
    yield "## Explained differences\n\n" + table(head, rows)


def _matrix(found: dict[str, list[Difference]], owners: dict[str, frozenset[str]]) -> str:
    rows = [
        (owner, *(_cell(owner, many) if release in have else "-" for release, many in found.items()))
        for owner, have in sorted(owners.items())
    ]
    return table(["", *found], rows)


def _cell(owner: str, found: list[Difference]) -> str:
    return str(sum(one.owner == owner for one in found) or "=")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
