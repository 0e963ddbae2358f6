"""What does the compiler make of every real file, and what does not come back?"""

import re
import time
from collections import Counter
from collections.abc import Iterable, Sequence

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.text_survives.mismatches import COLUMNS as MISMATCH_COLUMNS
from reports.text_survives.mismatches import by_path
from testbed.corpus.examine import Examined, examine
from testbed.corpus.examine_xacro import Expanded, examine_xacro
from testbed.corpus.files import CorpusFile, Kind, corpus_files, xacro_files
from testbed.corpus.there_and_back import MOST_ROBOTS, SDF_VERSION
from testbed.markdown import frequent, grouped, listing, subsection, table

KNOWN = Known.beside(__file__)
MOST_SHOWN = 40
MOST_REFUSED = 0.02
"""The share of the files that another reader accepts which may be refused here."""
_READERS = (("urdfdom 3.0.1", "check_urdf"), ("libsdformat 12.3", "libsdformat12"))
_ABOUT = f"""\
Only the seconds differ from run to run.

Every URDF and SDF file of the corpus is read (*well-formed* is the verdict of a strict XML parser, *accepted*
that `twinform check` finds no error), converted to the other format (URDF to SDF {SDF_VERSION}; of a file with several
models the first {MOST_ROBOTS}, one by one; includes only where there are no others), and written again in its own
format and version. *Identical* means that a comparison of XML trees, which knows nothing of the compiler, finds the
text equal to the file but for white space, comments, the spelling of numbers and the order of unlike siblings.
*Unaccounted* are elements and attributes that `convert --audit` finds neither in the result nor in the ledger. *There
and back* means that the result was converted back, to the version of the source, and that it is the same robot by
`twinform diff` and has the same [normal form](../explanation/there_and_back.md) as the source: every name, attribute
and text that is not the spelling of a default is back, and nothing else has come along. Of a world, the source is the
model alone, with what it includes.

Files that others accept and that are refused here, and accepted ones that are not converted, each have their reason in
`reports/text_survives/corpus.toml`; one without is a broken promise.

Every `.xacro` file is *expanded* without arguments, with the packages around it in the corpus and no others, then
checked and converted, too. Most are libraries of macros, which are no robots by themselves, or need packages that
the corpus does not have."""

Outcome = tuple[CorpusFile, Examined]


def measure(sample: Sample) -> Findings:
    """Examine every file."""
    start = time.perf_counter()
    files = {file.name: file for file in sample.models()}
    found = sample.outcomes(examine, files.values(), _broken)
    outcomes = [(files[one.name], one) for one in found]
    expanded = sample.of(xacro_files())
    macros = sample.outcomes(_examine_xacro, expanded, lambda file, why: Expanded(file.name, faults=(why,)))
    totals = _totals(sample, outcomes, time.perf_counter() - start)
    faults = list(_faults(outcomes, macros))
    return Findings(
        [subsection("Totals", totals), *_sections(outcomes, macros, faults)],
        f"{totals}\n{_xacro_totals(macros)}",
        [f"{name}: {fault}" for name, fault in faults],
    )


def _broken(file: CorpusFile, why: str) -> Examined:
    return Examined(file.name, faults=(why,))


def _examine_xacro(file: CorpusFile) -> Expanded:
    return examine_xacro(file.path, file.name)


def _faults(outcomes: list[Outcome], macros: list[Expanded]) -> Iterable[tuple[str, str]]:
    for one in (*(found for _, found in outcomes), *macros):
        yield from ((one.name, fault) for fault in one.faults)
    for _, one in outcomes:
        if one.not_converted_by and not why_not_converted(KNOWN, one.name, one.not_converted_by):
            yield one.name, f"not converted and not explained: {', '.join(one.not_converted_by)}"
    for reader, column in _READERS:
        good, refused = _refused(outcomes, column)
        if len(refused) > MOST_REFUSED * good:
            yield reader, f"accepts {good} files, of which {len(refused)} are refused"
        yield from ((one.name, f"{reader} accepts it") for one in refused if not KNOWN.why("refused", one.name))


def _refused(outcomes: list[Outcome], column: str) -> tuple[int, list[Examined]]:
    """How many files another reader accepts, and those of them that are refused here."""
    good = [found for file, found in outcomes if file.row.get(column) == "ok"]
    return len(good), [found for found in good if not found.accepted]


def why_not_converted(known: Known, name: str, rules: tuple[str, ...]) -> str:
    """Why it is right not to convert a file; empty where it, and one of the rules, is not explained."""
    if own := known.why("not_converted", name):
        return own
    reasons = [known.why("not_converted_rules", rule) for rule in rules]
    return "; ".join(reasons) if all(reasons) else ""


def _sections(outcomes: list[Outcome], macros: list[Expanded], faults: list[tuple[str, str]]) -> Iterable[str]:
    found = [outcome for _, outcome in outcomes]
    yield subsection("xacro", _xacro_totals(macros))
    yield subsection("xacro files refused, by rule", _by_rule((one.refused_by, one.name) for one in macros))
    yield subsection("By repository", _by_repository(outcomes))
    yield subsection("Files refused, by rule", _by_rule((one.refused_by, one.name) for one in found))
    yield subsection("Files accepted and not converted", _not_converted(found))
    yield subsection("Files refused that another reader accepts", _stricter_than_others(outcomes))
    yield subsection("Files not identical", _listed((one.name, one.difference) for one in found if one.difference))
    yield subsection("What does not come back, by kind", _mismatches(found))
    yield subsection("Broken promises", _listed(faults))


def _totals(sample: Sample, outcomes: list[Outcome], seconds: float) -> str:
    kinds = Counter(file.kind for file in sample.of(corpus_files()))
    aside = ", ".join(f"{count} {kind}" for kind, count in kinds.items() if kind not in {Kind.URDF, Kind.SDF})
    groups = [(kind, [found for file, found in outcomes if file.kind is kind]) for kind in (Kind.URDF, Kind.SDF)]
    both = ("both", [found for _, found in outcomes])
    text = f"{sum(kinds.values())} files; of other kinds: {aside}. Wall time {seconds:.0f} s."
    return text + "\n\n" + _counts("format", (*groups, both), _COLUMNS)


def _xacro_totals(macros: list[Expanded]) -> str:
    groups = grouped((one.name.split("/", 1)[0], one) for one in macros)
    return _counts("repository", (*groups.items(), ("all", macros)), _XACRO_COLUMNS)


_COLUMNS = ("well-formed", "accepted", "converted", "unaccounted", "there and back", "identical")
_XACRO_COLUMNS = ("expanded", "accepted", "converted")


def _counts(first: str, groups: Iterable[tuple[str, Sequence[Examined | Expanded]]], columns: Sequence[str]) -> str:
    """A row for each group: how many files have what a column counts, or how many of such things all have."""
    rows = (_row(title, found, columns) for title, found in groups)
    return table([first, "files", *columns, "seconds"], rows)


def _row(title: str, found: Sequence[Examined | Expanded], columns: Sequence[str]) -> tuple[object, ...]:
    values = [[getattr(one, re.sub("[- ]", "_", column)) for one in found] for column in columns]
    counts = (sum(value if isinstance(value, bool) else len(value) for value in each) for each in values)
    return (title, len(found), *counts, f"{sum(one.seconds for one in found):.1f}")


def _by_repository(outcomes: list[Outcome]) -> str:
    groups = grouped((file.repository, found) for file, found in outcomes)
    return _counts("repository", groups.items(), _COLUMNS)


def _by_rule(refusals: Iterable[tuple[tuple[str, ...], str]]) -> str:
    """A file counts under each rule that stopped it."""
    return listing(
        ["rule", "files", "for example"], frequent((rule, name) for rules, name in refusals for rule in rules)
    )


def _not_converted(found: list[Examined]) -> str:
    nothing = sum(one.without_robot for one in found)
    text = f"{nothing} files hold no model: lights, actors, physics; there is nothing to convert."
    stopped = sorted((one for one in found if one.not_converted_by), key=lambda one: one.not_converted_by)
    groups = grouped((why_not_converted(KNOWN, one.name, one.not_converted_by) or UNEXPLAINED, one) for one in stopped)
    rows = [
        (", ".join(group[0].not_converted_by), len(group), group[0].name, why)
        for why, group in sorted(groups.items(), key=lambda item: -len(item[1]))
    ]
    return text + "\n\n" + table(["rules", "files", "for example", "why that is right"], rows)


def _stricter_than_others(outcomes: list[Outcome]) -> str:
    parts: list[str] = []
    for reader, column in _READERS:
        good, refused = _refused(outcomes, column)
        share = f"{len(refused) / max(good, 1):.1%}"
        parts.append(f"{reader} accepts {good} of these files; {len(refused)} of them, {share}, are refused here.")
        rows = [(one.name, ", ".join(one.refused_by), KNOWN.why("refused", one.name) or UNEXPLAINED) for one in refused]
        parts.append(listing(["file", "rule", "why that is right"], rows, empty=""))
    return "\n\n".join(part.strip() for part in parts if part)


def _mismatches(found: list[Examined]) -> str:
    rows = by_path((one.name, one.mismatches) for one in found)
    return listing(MISMATCH_COLUMNS, rows, empty="Nothing.", most=MOST_SHOWN)


def _listed(rows: Iterable[tuple[str, str]]) -> str:
    return listing(["file", "what"], rows, most=MOST_SHOWN)


SECTION = Section("corpus", _ABOUT, measure, known=KNOWN)
