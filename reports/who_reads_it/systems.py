"""Is the catalog of plugins right? Checkouts of gz-sim and gz-sensors are given as ARGS.

Each input is a checkout of gz-sim (ign-gazebo) or of gz-sensors (ign-sensors) of one release, such as
`git worktree add ../gz-sim8 gz-sim8` makes it. Nothing of their text is kept: names, types, defaults and topics are
facts, and only these are compared.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.who_reads_it.catalog_differences import Difference, is_of_sim, of_sensors, of_systems
from reports.who_reads_it.sensor_sources import COMPARED, sensors_in
from reports.who_reads_it.system_sources import systems_in
from testbed.markdown import grouped, subsection, table
from twinform.passes.plugins.catalog import LATEST, releases, sensors, systems

MISSING = "no sources: give ARGS='PATH ...' with checkouts of gz-sim and gz-sensors, one for each release"
KNOWN = Known.beside(__file__)
_ABOUT = """\
With `ARGS="PATH ..."` for checkouts of gz-sim and gz-sensors, by the names that their C++ reads elements, attributes
and defaults with. Compared are, for every system: the parameters by name (wherever they stand in the plugin), whether
they are elements or attributes, the kinds of their values, their defaults, the parts of topics and the messages; for
every sensor: the suffix of its default topic, what is published beside it, and the messages. Releases list their
systems.

*=* is without a difference, a number counts differences that are explained below; *-* is a release that has none."""
_PROJECT = re.compile(r"project\s*\(\s*(?:gz|ignition)-(sim|gazebo|sensors)\d*\s+VERSION\s+(\d+)\.([\d.]+)")


@dataclass(frozen=True, slots=True)
class Checkout:
    """The sources of one version: `part` is `sim` or `sensors`."""

    path: Path
    part: str
    version: int
    full: str


def measure(sample: Sample) -> Findings:
    """Compare the checkouts with the catalog.

    Raises:
        SystemExit: there is none of a release in the catalog.
    """
    checkouts = [checkout(Path(path)) for path in sample.inputs]
    found = differences(checkouts)
    if not found:
        raise SystemExit("none of these is gz-sim of a release in the catalog" if checkouts else MISSING)
    unexplained = [(one, release) for release, many in found.items() for one in many if not why(one)]
    return Findings(
        list(_sections(found, checkouts)),
        f"{sum(map(len, found.values()))} differences",
        [
            f"{one.key}: here {one.here or '-'}, there {one.there or '-'} ({', '.join(names)})"
            for one, names in _by_difference(unexplained).items()
        ],
    )


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


def why(difference: Difference) -> str:
    """Why a difference is right; empty where nobody has examined it."""
    return KNOWN.why("known", difference.key)


def _by_difference(found: Iterable[tuple[Difference, str]]) -> dict[Difference, list[str]]:
    return dict(sorted(grouped(found).items()))


def _sections(found: dict[str, list[Difference]], checkouts: list[Checkout]) -> Iterator[str]:
    versions = sorted(checkouts, key=lambda each: (each.part, each.version))
    yield "Read: " + ", ".join(f"gz-{each.part} {each.full}" for each in versions) + "."
    kinds = {kind.name: kind.releases for kind in systems().values() if is_of_sim(kind)}
    yield subsection("Systems", _matrix(found, kinds))
    read = {name for name, release in _sims().items() if _has(checkouts, "sensors", release)}
    of_sensors = {f"sensor {type_}": sensors()[type_].releases & read for type_ in COMPARED}
    yield subsection("Sensors", _matrix(found, of_sensors))
    every = _by_difference((one, release) for release, many in found.items() for one in many)
    rows = [
        (one.owner, one.kind, one.what, one.here or "-", one.there or "-", ", ".join(names), why(one) or "**?**")
        for one, names in every.items()
    ]
    head = ["of", "what", "name", "catalog", "source", "releases", "why"]
    yield subsection("Explained differences", table(head, rows))


def _matrix(found: dict[str, list[Difference]], owners: dict[str, frozenset[str]]) -> str:
    rows = [
        (owner, *(_cell(owner, many) if release in have else "-" for release, many in found.items()))
        for owner, have in sorted(owners.items())
    ]
    return table(["", *found], rows)


def _cell(owner: str, found: list[Difference]) -> str:
    return str(sum(one.owner == owner for one in found) or "=")


SECTION = Section("systems", _ABOUT, measure, needs=(), known=KNOWN)
