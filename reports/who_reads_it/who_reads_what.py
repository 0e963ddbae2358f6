"""Who reads what? Small files, each with one feature of URDF or SDF, before every consumer in every release."""

from collections import Counter
from collections.abc import Iterator, Sequence

import twinform
from reports.harness.known import Known, contains
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.who_reads_it.feature_cells import VERDICTS, Cell, as_json, cells, changes, columns, read_cells
from reports.who_reads_it.feature_pages import CELLS, FOLDER, pages
from reports.who_reads_it.loaders import absent
from testbed.generated_files import marked, write
from testbed.markdown import listing, subsection, table
from twinform.profiles.features import features

KNOWN = Known.beside(__file__, contains)
_SECONDS = 600
_MOST_SHOWN = 60
_ABOUT = """\
Each [feature](../reference/who_reads_what/README.md) is a file of about ten lines. The loaders that are here read it,
as they read [the corpus](#what-loaders-do-and-what-their-profiles-say); Gazebo's DART builds and steps what libsdformat
read of SDF, 50 times. A loader *refuses*, or it *differs*: joints that move, masses or shapes are not those of the
file; or it *warns*, or *reads* it without a word. A consumer that is not here, and any other release of it, has the
verdict of its profile by the rows for that release, which were read in its sources. A cell has the worse of what was
seen and of what the profile says is dropped or read otherwise; a refusal was always seen. What a profile says of every
robot is said of the plain one alone.

A run compares the verdicts with those in `docs/reference/who_reads_what/cells.json`, prints what changed, and writes
them and the pages. What a profile does not say has its cause (`reports/who_reads_it/who_reads_what.toml`)."""


def measure(sample: Sample) -> Findings:
    """Ask all consumers, compare with the last run, and write the cells and the pages where all was asked."""
    every = features()
    asked_about = sample.of(every.values())
    found, failures = sample.lists(cells, asked_about, seconds=_SECONDS)
    found.sort(key=lambda cell: (cell.feature, [column.name for column in columns()].index(cell.consumer)))
    names = {each.name for each in asked_about}
    changed = [*changes((cell for cell in read_cells(CELLS) if cell.feature in names), found)]
    if len(asked_about) == len(every):
        text = as_json(found, every)
        twinform.write_atomically(CELLS, text)
        write(marked({FOLDER / name: page for name, page in pages(text).items()}))
    causes = {cell: _cause(cell) for cell in found if cell.disagrees}
    faults = [
        f"{each.feature}: {each.consumer}: {each.disagrees}: {each.message}" for each in causes if not causes[each]
    ]
    counts = _counts(found)
    summary = "\n".join([counts, *changed[:_MOST_SHOWN], f"{len(changed)} cells changed since the last run"])
    return Findings([counts, *_causes(causes), absent()], summary, [*failures, *faults])


def _cause(cell: Cell) -> str:
    return KNOWN.why(
        "disagreement", feature=cell.feature, consumer=cell.consumer, what=cell.disagrees, message=cell.message
    )


def _counts(found: Sequence[Cell]) -> str:
    rows = [
        _count(column.name, column.source, [each for each in found if each.consumer == column.name])
        for column in columns()
    ]
    head = ["consumer", "how it is known", "cells", *VERDICTS, "measured", "as the profile says", "by source"]
    return subsection("Cells", table(head, [*rows, _count("all", "", found)]))


def _count(name: str, source: str, found: Sequence[Cell]) -> tuple[object, ...]:
    verdicts = Counter(each.verdict for each in found)
    measured = [each for each in found if each.measured]
    agree = sum(not each.disagrees for each in measured)
    return (
        name,
        source,
        len(found),
        *(verdicts[each] for each in VERDICTS),
        len(measured),
        agree,
        len(found) - len(measured),
    )


def _causes(causes: dict[Cell, str]) -> Iterator[str]:
    counts = Counter((each.consumer, each.disagrees, why or UNEXPLAINED) for each, why in causes.items())
    rows = ((count, *key) for key, count in sorted(counts.items(), key=lambda item: (-item[1], item[0])))
    yield subsection("What the profiles do not say", listing(["cells", "consumer", "what", "cause"], rows))


SECTION = Section("who_reads_what", _ABOUT, measure, needs=(), known=KNOWN)
