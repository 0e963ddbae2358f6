"""Is it the same robot in Gazebo's own physics, DART and Bullet?"""

import shutil
from collections.abc import Iterable, Iterator

from reports.harness.needs import corpus, gazebo
from reports.harness.sample import Sample, judged_files
from reports.harness.section import Findings, Section
from reports.same_robot.gazebo_verdicts import KNOWN, OUT, SETTINGS, Outcome, Verdict, outcomes
from testbed.engines.gazebo.differing import AT_REST, MOVED
from testbed.markdown import cross_table, example_rows, listing, subsection
from testbed.output_files import SDF_VERSION

MOST_SHOWN = 60
_ABOUT = f"""\
With gz-physics 5 and libsdformat 12, those of Gazebo Fortress. What the engines do with each element is on
[another page](who_reads_it.md#what-gazebos-engines-make-of-sdf).

Every URDF file of the corpus is loaded twice into each engine: as libsdformat reads URDF itself, and as the SDF
{SDF_VERSION} that it is converted to. Every SDF model is loaded as it is, and as libsdformat reads the URDF that it is
converted to. It is *same* if there is no new error line, every joint has the same degrees of freedom, axes and
properties, the mass is the same, links rest within {AT_REST:g}, and after {SETTINGS.steps * SETTINGS.dt:g} s without
control or contact, starting with all joints at {SETTINGS.start:g} rad/s or m/s, links and joints are where they are in
the other to {MOVED:g} of their motion. Of URDF that comes from SDF, where link frames moved onto joints, joints alone
are compared. Bullet has single precision here, and its fixed joints give way: motions are not compared.

Differences of a *known cause* have it in `reports/same_robot/gazebo_runs.toml`. Where libsdformat's lumping of fixed
joints may be the cause, the source is loaded once more with the extension that keeps them."""
_FAULTS = (Verdict.DIFFERENT, Verdict.CRASH)


def measure(sample: Sample) -> Findings:
    """Convert and simulate."""
    shutil.rmtree(OUT, ignore_errors=True)
    files = sample.of(judged_files())
    found = sorted(outcomes(files), key=lambda one: (one.engine, one.direction, one.name))
    faults = [f"{one.engine}: {one.name}: {_first(one)}" for one in found if one.verdict in _FAULTS]
    return Findings(list(_sections(found)), _totals(found), faults)


def _sections(found: list[Outcome]) -> Iterator[str]:
    yield subsection("Totals", _totals(found))
    yield subsection("Known causes", _causes(found))
    yield subsection("Different", _listed(one for one in found if one.verdict is Verdict.DIFFERENT))
    yield subsection("Results that crash an engine", _listed(one for one in found if one.verdict is Verdict.CRASH))
    yield subsection("Neither loads", _listed(one for one in found if one.verdict is Verdict.NEITHER))
    loaded = (one for one in found if one.verdict is Verdict.REFUSED and one.ending.startswith("loaded"))
    yield subsection("Not converted, although the engine loads the source", _listed(loaded))


def _totals(found: list[Outcome]) -> str:
    met = ((one.engine.value, one.direction.value, one.verdict) for one in found)
    return cross_table(["engine", "conversion"], met, Verdict)


def _causes(found: list[Outcome]) -> str:
    causes = (
        ((one.engine.value, one.direction.value, reason), one.name)
        for one in found
        for reason in dict.fromkeys(why for _, why in one.differences if why)
    )
    return listing(["engine", "conversion", "cause", "files", "for example"], example_rows(causes))


def _first(one: Outcome) -> str:
    unexplained = [str(difference) for difference, why in one.differences if not why]
    return (unexplained[0] if unexplained else one.ending)[:200]


def _listed(found: Iterable[Outcome]) -> str:
    rows = [(one.engine.value, one.direction.value, one.name, _first(one)) for one in found]
    return listing(["engine", "conversion", "file", "what"], rows, most=MOST_SHOWN)


SECTION = Section("gazebo_runs", _ABOUT, measure, (corpus, gazebo), KNOWN)
