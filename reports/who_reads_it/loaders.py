"""Do the profiles say what the loaders do? Every loader reads the corpus and mutated files, beside its profile."""

import itertools
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from reports.harness.known import Known, contains
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.who_reads_it.loader_verdicts import Difference, Job, Pair, asked, pairs
from testbed.corpus.files import Kind
from testbed.engines.readers import LOADERS, Verdict
from testbed.engines.readers.meshless import without_meshes
from testbed.markdown import cross_table, listing, subsection, table
from testbed.mutated.mutated import Mutated, mutated
from testbed.mutated.versioned import versioned
from testbed.output_files import OUT, kept

KNOWN = Known.beside(__file__, contains)
MUTATED = 2000
_SECONDS = 600
_NEWER = re.compile(rb'<robot[^>]* version="1\.[12]"')
_ABOUT = """\
Every URDF of the corpus, 2,000 mutated ones (files of the corpus with one to four mistakes each, as in
[verdicts](mistakes_found.md#mutated-files-before-the-parsers-of-record)), and 500 that are drawn, of URDF 1.1 and 1.2,
are read by every loader in a process of its own, and assessed by its profile, as `twinform check --for` does it. Each
release that PyPI or the system has is a loader of its own. A box of 0.1 m stands for each mesh, in the text, so that
broken files stay broken: no loader is asked for meshes that are not there.

A loader *refuses* a file where it throws, returns nothing, crashes or comes to no end; it *warns* where it writes a
warning or an error on the terminal and goes on. A pair of a file and a loader *agrees* where both refuse; or neither
does and the loader writes warnings only if the profile has something for it, and the profile has more than a warning
if it writes none; and where the profile says of nothing that it is dropped or read otherwise, all joints that turn or
slide and all of the mass are there. MuJoCo makes what stands still a part of the world, which has no mass; of it, the
mass of what moves has to be there.

Every disagreement has its cause, by what the loader or the profile says and not by file
(`reports/who_reads_it/loaders.toml`). One without a cause is a failure of the command."""


def measure(sample: Sample) -> Findings:
    """Ask all loaders, and hold their answers against the profiles."""
    corpus = [
        Job(f"corpus/{file.name}", _boxed(file.path, Path("corpus", file.name))) for file in sample.models(Kind.URDF)
    ]
    first = (sample.seed - 1) * MUTATED
    seeds = range(first, first + (0 if sample.files else MUTATED), sample.every)
    made = [Job(f"mutated/{seed}", _keep("mutated", mutated(Kind.URDF, seed))) for seed in seeds]
    newer = [Job(f"versions/{each.seed}", _keep("versions", each)) for each in _of_newer_versions(seeds)]
    found, failures = sample.lists(pairs, [*corpus, *made, *newer], seconds=_SECONDS)
    found.sort(key=lambda pair: (pair.loader, pair.name))
    causes = {pair: _cause(pair) for pair in found if pair.difference}
    faults = [
        f"{pair.loader}: {pair.name}: {pair.difference}: {pair.theirs or pair.ours}"[:400]
        for pair, why in causes.items()
        if not why
    ]
    counts = _counts(found)
    return Findings([counts, *_causes(causes), absent()], counts, [*failures, *faults])


def _boxed(path: Path, name: Path) -> Path:
    """A copy of a file without its meshes, under a name that no two files share."""
    return kept(OUT / "loaders" / name.parent / f"{name.stem}.urdf", without_meshes(path.read_bytes()))


def _keep(folder: str, made: Mutated) -> Path:
    return kept(OUT / "loaders" / folder / f"{made.seed}.urdf", without_meshes(made.text))


def _of_newer_versions(seeds: range) -> list[Mutated]:
    """Documents of URDF 1.1 and 1.2, one for each fourth mutated one."""
    drawn = (versioned(seed) for seed in itertools.count(seeds.start))
    newer = (each for each in drawn if _NEWER.search(each.text))
    return list(itertools.islice(newer, len(seeds) // 4))


def _cause(pair: Pair) -> str:
    assert pair.difference is not None
    return KNOWN.why("disagreement", loader=pair.loader, what=pair.difference, theirs=pair.theirs, ours=pair.ours)


def _counts(found: Sequence[Pair]) -> str:
    rows = [
        _row(loader.consumer, loader.reader.version(), [one for one in found if one.loader == loader.consumer])
        for loader in asked()
    ]
    head = ["loader", "version", "files", *Verdict, "agree", "of them"]
    return subsection("Verdicts", table(head, [*rows, _row("all", "", found)]))


def _row(name: str, version: str, found: Sequence[Pair]) -> tuple[object, ...]:
    verdicts = Counter(one.verdict for one in found)
    agree = sum(one.difference is None for one in found)
    share = f"{100 * agree / max(1, len(found)):.2f}%"
    return (name, version, len(found), *(verdicts[each] for each in Verdict), agree, share)


def _causes(causes: dict[Pair, str]) -> Iterator[str]:
    met = ((pair.loader, str(pair.difference)) for pair in causes)
    yield subsection("Disagreements", cross_table(["loader"], met, Difference))
    counts = Counter((pair.loader, str(pair.difference), why or UNEXPLAINED) for pair, why in causes.items())
    rows = ((count, *key) for key, count in sorted(counts.items(), key=lambda item: (-item[1], item[0])))
    yield subsection("By cause", listing(["files", "loader", "what", "cause"], rows))


def absent() -> str:
    """The loaders that are not here, and what they need; empty where all are."""
    missing = [
        f"`{loader.consumer}` is not here: it needs {loader.reader.needs}"
        for loader in LOADERS
        if loader not in asked()
    ]
    return subsection("Not asked", *missing) if missing else ""


SECTION = Section("loaders", _ABOUT, measure, known=KNOWN)
