"""Are meshes that passes have changed as near to the old ones as was asked for, and how much cheaper are they?"""

import statistics
from collections import Counter
from collections.abc import Iterable, Sequence

from reports.fixes_and_passes.mesh_files import chosen
from reports.fixes_and_passes.mesh_runs import COLLISIONS, LIMITS, PIPELINES, Outcome, Task, all_judged
from reports.harness.known import Known
from reports.harness.needs import need
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from testbed.markdown import listing, subsection, table
from twinform.compiler.workers import Failure
from twinform.testing import oracles

KNOWN = Known.beside(__file__)
_SLACK = 1.0 + 1e-6
_SECONDS = 900.0
_MEMORY = 4300.0
_EACH = 8
"""One of so many meshes is taken apart: that takes minutes for some."""
_ABOUT = """\
Meshes of robots that come with PyBullet, Drake and example-robot-data (`pip install -e '.[robots]'`), those that assimp
is tested with (Debian's `assimp-testmodels`), and of folders that are given as ARGS: of every format that is read, and
from the smallest to the largest. Each is put into a model,
alone, and the model through one pass. What comes out is judged by assimp, which reads both files, and by Coal: 5,000
points are drawn on each surface, and it measures how far they are from the other one. They share no code with the
passes. MuJoCo reads what is written too."""
_HEAD = (
    "pass", "meshes", "changed", "stay", "triangles before", "after", "farthest that was met", "asked for", "median s",
    "most s", "most MB",
)  # fmt: skip
_STEPS = {
    "simplify": "Collisions as primitives and hulls",
    "parts": "Collisions as convex parts",
    "decimate": "Visuals",
    "convert": "Conversions to OBJ",
}


def measure(sample: Sample) -> Findings:
    """Run all passes on all meshes."""
    files = sample.of(chosen(sample.inputs))
    usual = tuple(step for step in PIPELINES if step != "parts")
    tasks = [Task(file, tuple(PIPELINES) if at % _EACH == 0 else usual) for at, file in enumerate(files)]
    found = [
        each for task, result in sample.run(all_judged, tasks, seconds=_SECONDS) for each in _outcomes(task, result)
    ]
    found.sort(key=lambda each: (each.step, each.format, each.name))
    faults = [f"{each.step} {each.name}: {why}" for each in found if (why := _fault(each)) and not _known(each, why)]
    formats = Counter(file.format for file in files)
    counts = ", ".join(f"{count} {kind.upper()}" for kind, count in sorted(formats.items()))
    summary = f"{len(files)} meshes: {counts}\n\n{_totals(found)}"
    sections = [summary, _kinds(found), *(subsection(title, _rows(found, step)) for step, title in _STEPS.items())]
    return Findings([*sections, _explained(found)], summary, faults)


def _outcomes(task: Task, result: list[Outcome] | Failure) -> list[Outcome]:
    if isinstance(result, Failure):
        return [Outcome(task.file.name, task.file.format, task.steps[0], fault=result.cause)]
    return result


def _fault(each: Outcome) -> str:
    """What is wrong with an outcome; empty if nothing."""
    if each.fault:
        return each.fault
    if each.judged > _SLACK * LIMITS[each.step]:
        return f"{each.judged:.2g} of the diagonal off, and {LIMITS[each.step]:g} was asked for"
    if not all(each.readers.values()):
        return f"not read, or elsewhere, by {', '.join(name for name, good in each.readers.items() if not good)}"
    return f"{each.megabytes:.0f} MB" if each.megabytes > _MEMORY else ""


def _known(each: Outcome, why: str) -> str:
    return KNOWN.why(each.step, each.name, fault=why)


def _totals(found: Sequence[Outcome]) -> str:
    return table(_HEAD, [_total(step, [each for each in found if each.step == step]) for step in _STEPS])


def _total(step: str, own: Sequence[Outcome]) -> tuple[object, ...]:
    changed = [each for each in own if each.changed]
    times = [each.seconds for each in own] or [0.0]
    judged_right = [each for each in changed if not each.fault and not _known(each, _fault(each))]
    return (
        f"`{PIPELINES[step]}`", len(own), len(changed), len(own) - len(changed), sum(each.before for each in changed),
        sum(each.after for each in changed), f"{max((each.judged for each in judged_right), default=0):.2g}",
        f"{LIMITS[step]:g}", f"{statistics.median(times):.1f}", f"{max(times):.0f}",
        f"{max((each.megabytes for each in own), default=0):.0f}",
    )  # fmt: skip


def _kinds(found: Sequence[Outcome]) -> str:
    counts = Counter(each.how for each in found if each.step in COLLISIONS and each.changed)
    stay = Counter(_why(each) for each in found if not each.changed)
    return subsection(
        "What collisions become, and why meshes stay",
        table(("becomes", "collisions"), _most(counts)),
        listing(("why it stays", "meshes"), _most(stay)),
    )


def _most(counts: Counter[str]) -> list[tuple[str, int]]:
    """The most frequent first."""
    return sorted(counts.items(), key=lambda pair: (-pair[1], pair[0]))


def _why(each: Outcome) -> str:
    words = each.said[0].partition(" stays as it is: ")[2] if each.said else each.fault or "nothing has to be done"
    for name in ("(", ":"):
        words = words.replace(name, " ")
    if "nothing cheaper" in words:
        return "nothing cheaper is within the distance"
    if "cannot be used" in words:
        return f"it cannot be used: {words.rpartition('used')[2].strip()}"
    return words


def _rows(found: Iterable[Outcome], step: str) -> str:
    rows = [_row(each) for each in found if each.step == step and each.changed]
    return listing(("mesh", "triangles", "after", "becomes", "met", "s", "MB"), rows)


def _row(one: Outcome) -> tuple[object, ...]:
    costs = f"{one.judged:.2g}", f"{one.seconds:.1f}", f"{one.megabytes:.0f}"
    return (f"`{one.name}`", one.before, one.after, one.how, *costs)


def _explained(found: Iterable[Outcome]) -> str:
    wrong = [(each, why) for each in found if (why := _fault(each))]
    rows = [(each.step, f"`{each.name}`", why, _known(each, why) or UNEXPLAINED) for each, why in wrong]
    return subsection("What a judge sees otherwise", listing(("pass", "mesh", "what", "why"), rows))


_coal = need(lambda: oracles.available("pinocchio"), "Coal is not here: pip install '.[engines]'")
SECTION = Section("meshes", _ABOUT, measure, (_coal,), KNOWN)
