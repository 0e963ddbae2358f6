"""Is anything left that Gazebo refuses, freezes, drops or ends with after `convert --for gazebo`?"""

import shutil
from collections import Counter
from collections.abc import Iterator

from reports.harness.needs import corpus, gazebo
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.who_reads_it.gazebo_faults import KNOWN, OUT, PROFILE, SETTINGS, Fault, Finding, Made, outcomes
from testbed.markdown import example_rows, frequent, listing, subsection, table

_ABOUT = f"""\
Every URDF and SDF file of the corpus is converted with `convert --for {PROFILE} --to sdf`, without its meshes,
loaded by libsdformat 12 into DART and Bullet of gz-physics 5, those of Gazebo Fortress, and stepped for
{SETTINGS.steps * SETTINGS.dt:g} s with all joints at {SETTINGS.start:g} rad/s or m/s.

Nothing may be refused, and no engine may end. A joint that moves in the source has to be in the result and to have a
degree of freedom in the engine; links and masses have to be there. What an engine cannot do has to be reported by the
conversion itself, as a finding or an entry of the ledger about that part: such are counted by the rule. Other causes
stand in `reports/who_reads_it/gazebo_ready.toml`."""
_MOST_SHOWN = 60


def measure(sample: Sample) -> Findings:
    """Convert and simulate."""
    shutil.rmtree(OUT, ignore_errors=True)
    made, found = outcomes(sample.models())
    faults = [f"{each.engine}: {each.name}: {each.fault}: {each.what[:200]}" for each in found if not each.why]
    return Findings(list(_sections(made, found)), _totals(made, found), faults)


def _sections(made: dict[str, Made], found: list[Finding]) -> Iterator[str]:
    yield subsection("Totals", _totals(made, found))
    yield subsection("Reported, or known", _causes(found))
    rows = [(each.engine, each.name, each.fault.value, each.what[:200]) for each in found if not each.why]
    yield subsection("Without a cause", listing(["engine", "file", "fault", "what"], rows, most=_MOST_SHOWN))
    yield subsection("Not converted", _refused(made))


def _totals(made: dict[str, Made], found: list[Finding]) -> str:
    counts = Counter((each.fault, bool(each.why)) for each in found)
    rows: list[tuple[str, int]] = [
        ("files", len(made)),
        ("not converted, with an error", sum(one.path is None for one in made.values())),
        ("converted", sum(one.path is not None for one in made.values())),
        ("of these with a change of the physics in the ledger", sum(not one.is_physics_kept for one in made.values())),
        ("of these with nothing that any engine minds", _clean(made, found)),
    ]
    rows += [(f"{fault}: reported or known", counts[fault, True]) for fault in Fault]
    rows += [(f"{fault}: **without a cause**", counts[fault, False]) for fault in Fault]
    return table(["", "number"], rows)


def _clean(made: dict[str, Made], found: list[Finding]) -> int:
    return len({name for name, one in made.items() if one.path} - {each.name for each in found})


def _causes(found: list[Finding]) -> str:
    causes = {((each.engine or "all", each.fault.value, each.why), each.name): None for each in found if each.why}
    return listing(["engine", "fault", "cause", "files", "for example"], example_rows(causes))


def _refused(made: dict[str, Made]) -> str:
    refused = ((name, next(iter(one.told), "")) for name, one in made.items() if not one.path)
    rules = ((first.partition(":")[0], name) for name, first in refused)
    return listing(["first error", "files", "for example"], frequent(rules))


SECTION = Section("gazebo_ready", _ABOUT, measure, (corpus, gazebo), KNOWN)
