"""Does `twinform diff` see every changed value, and no other spelling?"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.corpus.files import ROOT, CorpusFile
from testbed.markdown import frequent, listing, subsection, table
from testbed.respellings import Respelling, respellings
from testbed.value_mutants import MISSED, Mutant, mutants
from twinform.compiler.compare import DifferenceSeverity

_EACH = 2
"""Values that are changed in one file; other spellings are half as many."""
_SECONDS = 120
_LARGEST = 20_000
"""In bytes: each change of a file is a comparison of all of it."""
_MOST_SHOWN = 40
_SEVERITIES = tuple(map(str, DifferenceSeverity))
_ABOUT = f"""\
In every URDF and SDF file of the corpus of at most {_LARGEST:,} bytes, and in the case files, {_EACH} values are
changed, one at a time: a number to another one, a flag, a name, a word, the parameter of a plugin, each at another kind
of place. Changes that `check` refuses are made anew. `twinform diff` compares the file with the changed one: it has to
find a difference or a note, or the place is in [the list of what is not compared](../reference/not_compared.md). Then
the file is spelled in another way, in which it says the same, and nothing may be found."""


@dataclass(frozen=True, slots=True)
class Job:
    """A file, and the folders in which its includes are searched for."""

    name: str
    path: Path
    paths: tuple[Path, ...]
    seed: int


def measure(sample: Sample) -> Findings:
    """Change values in all of them."""
    found, failures = sample.lists(judge, _jobs(sample), seconds=_SECONDS)
    changed = [each for each in found if isinstance(each, Mutant)]
    spelled = [each for each in found if isinstance(each, Respelling)]
    missed = [each for each in changed if each.verdict == MISSED]
    seen = [each for each in spelled if each.found]
    totals = "\n\n".join((_of_values(changed), _of_spellings(spelled)))
    listed = [each for each in changed if each.verdict not in (*_SEVERITIES, MISSED)]
    places = listing(
        ["what is not compared", "changes", "for example"],
        frequent((each.verdict, each.place) for each in listed),
        most=_MOST_SHOWN,
    )
    faults = [*(f"missed: {each.name}" for each in missed), *(f"seen: {each.name}" for each in seen), *failures]
    return Findings([totals, subsection("Changes that make no difference", places)], totals, faults)


def judge(job: Job) -> list[Mutant | Respelling]:
    """Some changes of one file, and other spellings."""
    made = mutants(job.path, _EACH, job.seed, job.paths)
    return [*made, *respellings(job.path, _EACH // 2, job.seed, job.paths)]


def _jobs(sample: Sample) -> Iterator[Job]:
    for file in sample.models():
        if file.path.stat().st_size <= _LARGEST:
            yield Job(file.name, file.path, _folders(file), sample.seed)
    cases = ROOT / "tests/cases"
    files = sorted(each for each in cases.rglob("*") if each.suffix in {".urdf", ".sdf"})
    for path in [] if sample.files else files[:: sample.every]:
        yield Job(path.relative_to(ROOT).as_posix(), path, (path.parent,), sample.seed)


def _folders(file: CorpusFile) -> tuple[Path, ...]:
    return (file.path.parent, *file.paths)


def _of_values(found: list[Mutant]) -> str:
    counts = Counter(each.verdict for each in found)
    listed = sum(count for verdict, count in counts.items() if verdict not in (*_SEVERITIES, MISSED))
    row = (len(found), *(counts[each] for each in _SEVERITIES), listed, counts[MISSED])
    return table(("changed values", *_SEVERITIES, "not compared, as listed", MISSED), [row])


def _of_spellings(found: list[Respelling]) -> str:
    tried, seen = Counter(each.kind for each in found), Counter(each.kind for each in found if each.found)
    rows = [(kind, tried[kind], seen[kind]) for kind in sorted(tried)]
    return table(("other spellings", "tried", "seen"), [*rows, ("all", tried.total(), seen.total())])


SECTION = Section("changed_values", _ABOUT, measure)
