"""The real files of the corpus, summed: this tree beside an older one."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from benchmarks import inputs
from benchmarks.before import Call, Figures, compare, figures_table
from benchmarks.targets import Part, Target, at_most
from testbed.corpus.files import CorpusFile, Kind
from testbed.markdown import subsection

LOAD_LIMIT, CONVERT_LIMIT = 0.6, 0.6
_LOADS = {Kind.URDF: "load URDF", Kind.SDF: "load SDF"}
_CONVERSIONS = {Kind.URDF: "URDF to SDF", Kind.SDF: "SDF to URDF"}
_LEFT_OUT = """\
Not measured: `make bench BEFORE=CHECKOUT` takes the folder of an older checkout, such as one that
`git worktree add --detach ../before COMMIT` makes, and lets both trees take turns with every real file."""
_ABOUT = """\
Every real file, by this tree and by an older checkout in turns, each in a process of its own. The time of a file is the
least of its turns; files that one of both refuses are left out of the sums."""


def measure(checkout: Path | None, every: int, times: int) -> Part:
    """Let both checkouts take turns with the corpus."""
    title = "Real files"
    files = inputs.corpus(every)
    if checkout is None or not files:
        why = _LEFT_OUT if checkout is None else "The corpus is not here."
        return Part(subsection(title, why), list(targets({})))
    figures = compare([call for file in files for call in _calls(file)], checkout, times)
    return Part(subsection(title, _ABOUT, figures_table(figures)), list(targets(figures)))


def _calls(file: CorpusFile) -> Iterator[Call]:
    yield Call(_LOADS[file.kind], file.path, "load")
    target = "sdf" if file.kind is Kind.URDF else "urdf"
    yield Call(_CONVERSIONS[file.kind], file.path, options={"to": target})


def targets(figures: Mapping[str, Figures]) -> Iterator[Target]:
    """What the figures of this part are held to."""
    loads = _ratios(figures, list(_LOADS.values()))
    yield at_most("load, real files, in times of the older tree", LOAD_LIMIT, loads)
    for name in _CONVERSIONS.values():
        yield at_most(f"{name}, real files, in times of the older tree", CONVERT_LIMIT, _ratios(figures, [name]))


def _ratios(figures: Mapping[str, Figures], names: Sequence[str]) -> list[float | None]:
    """The sum of now over that of before; nothing where there is no figure."""
    before, now = (sum(figures[name].seconds[tree] for name in names if name in figures) for tree in ("before", "now"))
    return [now / before] if before else []
