"""Conversions in Gazebo's own physics: `make gazebo`. Writes docs/reference/gazebo_runs.md."""

import shutil
import sys
from collections import Counter
from collections.abc import Iterable, Iterator

from benchmarks.gazebo_judging import OUT, SDF_VERSION, SETTINGS, Outcome, Verdict, outcomes
from benchmarks.markdown import table, write
from benchmarks.oracle import judged_files
from tests.corpus.files import CORPUS, MISSING, ROOT
from twinform.testing.oracles import gazebo
from twinform.testing.oracles.gazebo.differing import AT_REST, MOVED

PAGE = ROOT / "docs" / "reference" / "gazebo_runs.md"
MOST_SHOWN = 60
INTRODUCTION = f"""# Conversions in Gazebo's own physics

Made by `make gazebo` with gz-physics 5 and libsdformat 12, those of Gazebo Fortress. What the engines do with each
element is on [another page](gazebo.md).

Every URDF file of the corpus is loaded twice into each engine: as libsdformat reads URDF itself, and as the SDF
{SDF_VERSION} that it is converted to. Every SDF model is loaded as it is, and as libsdformat reads the URDF that it is
converted to. It is *same* if there is no new error line, every joint has the same degrees of freedom, axes and
properties, the mass is the same, links rest within {AT_REST:g}, and after {SETTINGS.steps * SETTINGS.dt:g} s without
control or contact, starting with all joints at {SETTINGS.start:g} rad/s or m/s, links and joints are where they are in
the other to {MOVED:g} of their motion. Of URDF that comes from SDF, where link frames moved onto joints, joints alone
are compared. Bullet has single precision here, and its fixed joints give way: motions are not compared.

Differences of a *known cause* have it in `benchmarks/gazebo_known.toml`. Where libsdformat's lumping of fixed joints
may be the cause, the source is loaded once more with the extension that keeps them."""
_FAULTS = (Verdict.DIFFERENT, Verdict.CRASH)


def main() -> int:
    """Convert, simulate, report, and fail where a robot changed or an engine crashed."""
    if not CORPUS.is_dir() or not gazebo.available():
        print(gazebo.MISSING if CORPUS.is_dir() else MISSING, file=sys.stderr)
        return 1
    shutil.rmtree(OUT, ignore_errors=True)
    found = sorted(outcomes(judged_files()), key=lambda one: (one.engine, one.direction, one.name))
    write(PAGE, INTRODUCTION, *_sections(found))
    faults = [one for one in found if one.verdict in _FAULTS]
    print(_totals(found), f"written to {PAGE.relative_to(ROOT)}; the results are in {OUT.relative_to(ROOT)}", sep="\n")
    print(*(f"{one.engine}: {one.name}: {_first(one)}" for one in faults[:MOST_SHOWN]), sep="\n", file=sys.stderr)
    return 1 if faults else 0


def _sections(found: list[Outcome]) -> Iterator[str]:
    yield "## Totals\n\n" + _totals(found)
    yield "## Known causes\n\n" + _causes(found)
    yield "## Different\n\n" + _listed(one for one in found if one.verdict is Verdict.DIFFERENT)
    yield "## Results that crash an engine\n\n" + _listed(one for one in found if one.verdict is Verdict.CRASH)
    yield "## Neither loads\n\n" + _listed(one for one in found if one.verdict is Verdict.NEITHER)
    loaded = (one for one in found if one.verdict is Verdict.REFUSED and one.ending.startswith("loaded"))
    yield "## Not converted, although the engine loads the source\n\n" + _listed(loaded)


def _totals(found: list[Outcome]) -> str:
    counts = Counter((one.engine.value, one.direction.value, one.verdict) for one in found)
    groups = sorted({key[:2] for key in counts})
    rows = [(*group, *(counts[(*group, verdict)] for verdict in Verdict)) for group in groups]
    return table(["engine", "conversion", *Verdict], rows)


def _causes(found: list[Outcome]) -> str:
    files: dict[tuple[str, str, str], list[str]] = {}
    for one in found:
        for reason in dict.fromkeys(why for _, why in one.differences if why):
            files.setdefault((one.engine.value, one.direction.value, reason), []).append(one.name)
    rows = [(*cause, len(names), names[0]) for cause, names in sorted(files.items(), key=lambda item: -len(item[1]))]
    return table(["engine", "conversion", "cause", "files", "for example"], rows) if rows else "None."


def _first(one: Outcome) -> str:
    unexplained = [str(difference) for difference, why in one.differences if not why]
    return (unexplained[0] if unexplained else one.ending)[:200]


def _listed(found: Iterable[Outcome]) -> str:
    rows = [(one.engine.value, one.direction.value, one.name, _first(one)) for one in found]
    more = f"\n{len(rows) - MOST_SHOWN} more.\n" if len(rows) > MOST_SHOWN else ""
    return table(["engine", "conversion", "file", "what"], rows[:MOST_SHOWN]) + more if rows else "None."


if __name__ == "__main__":
    sys.exit(main())
