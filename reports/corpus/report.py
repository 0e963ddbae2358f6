"""What the compiler makes of every real file."""

import time
from collections import Counter
from collections.abc import Iterable
from itertools import groupby

from reports.corpus.astray import COLUMNS as COLUMNS_OF_ASTRAY
from reports.corpus.astray import by_place
from reports.harness.known import Known
from reports.harness.pages import frequent, listing, section, table
from reports.harness.report import UNEXPLAINED, Findings, Report
from reports.harness.sample import Sample
from tests.corpus.examine import Examined, examine
from tests.corpus.examine_xacro import Expanded, examine_xacro
from tests.corpus.files import CorpusFile, Kind, corpus_files, xacro_files
from tests.corpus.there_and_back import MOST_ROBOTS, SDF_VERSION
from twinform.compiler.workers import Failure

KNOWN = Known.beside(__file__)
MOST_SHOWN = 40
MOST_REFUSED = 0.02
"""The share of the files that another reader accepts which may be refused here."""
_READERS = (("urdfdom 3.0.1", "check_urdf"), ("libsdformat 12.3", "libsdformat12"))
_ABOUT = f"""\
Only the seconds differ from run to run.

Every URDF and SDF file of the corpus is read (*well-formed* says what a strict XML parser thinks of it, *accepted*
that `twinform check` finds no error), converted to the other format (URDF to SDF {SDF_VERSION}; of a file with several
models the first {MOST_ROBOTS}, one by one; includes only where there are no others), and written again in its own
format and version. *Identical* means that a comparison of XML trees, which knows nothing of the compiler, finds the
text equal to the file but for white space, comments, the spelling of numbers and the order of unlike siblings.
*Unaccounted* are elements and attributes that `convert --audit` finds neither in the result nor in the ledger. *Home*
means that the result of the conversion was converted back, to the version of the source, and that it is the same robot
by `twinform diff` and has the same [normal form](../explanation/there_and_back.md) as the source: every name, attribute
and text that is not the spelling of a default is back, and nothing else has come along. Of a world, the source is the
model alone, with what it includes.

Files that others accept and that are refused here, and accepted ones that are not converted, each have their reason in
`reports/corpus/known.toml`; one without is a broken promise.

Every `.xacro` file is *expanded* without arguments, with the packages around it in the corpus and no others, then
checked and converted, too. Most are libraries of macros, which are no robots by themselves, or need packages that
the corpus does not have."""

Outcome = tuple[CorpusFile, Examined]


def measure(sample: Sample) -> Findings:
    """Examine every file."""
    start = time.perf_counter()
    outcomes = sorted(_outcomes(sample), key=lambda outcome: outcome[0].name)
    macros = sorted(_macros(sample), key=lambda each: each.name)
    totals = _totals(sample, outcomes, time.perf_counter() - start)
    faults = list(_faults(outcomes, macros))
    return Findings(
        [section("Totals", totals), *_sections(outcomes, macros, faults)],
        f"{totals}\n{_xacro_totals(macros)}",
        [f"{name}: {fault}" for name, fault in faults],
    )


def _outcomes(sample: Sample) -> Iterable[Outcome]:
    for file, result in sample.run(examine, sample.models()):
        if isinstance(result, Failure):
            result = Examined(file.name, well_formed=False, faults=(result.cause,))  # noqa: PLW2901
        yield file, result


def _macros(sample: Sample) -> Iterable[Expanded]:
    for file, result in sample.run(_examine_xacro, sample.of(xacro_files())):
        yield Expanded(file.name, faults=(result.cause,)) if isinstance(result, Failure) else result


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
    yield section("xacro", _xacro_totals(macros))
    yield section("xacro files refused, by rule", _by_rule((one.refused_by, one.name) for one in macros))
    yield section("By repository", _by_repository(outcomes))
    yield section("Files refused, by rule", _by_rule((one.refused_by, one.name) for one in found))
    yield section("Files accepted and not converted", _not_converted(found))
    yield section("Files refused that another reader accepts", _stricter_than_others(outcomes))
    yield section("Files not identical", _listed((one.name, one.difference) for one in found if one.difference))
    yield section("What does not come home, by kind", _not_home(found))
    yield section("Broken promises", _listed(faults))


def _totals(sample: Sample, outcomes: list[Outcome], seconds: float) -> str:
    kinds = Counter(file.kind for file in sample.of(corpus_files()))
    aside = ", ".join(f"{count} {kind}" for kind, count in kinds.items() if kind not in {Kind.URDF, Kind.SDF})
    rows = [_row(kind, [found for file, found in outcomes if file.kind is kind]) for kind in (Kind.URDF, Kind.SDF)]
    rows.append(_row("both", [found for _, found in outcomes]))
    text = f"{sum(kinds.values())} files; of other kinds: {aside}. Wall time {seconds:.0f} s."
    return text + "\n\n" + table(["format", *_COLUMNS], rows)


def _xacro_totals(macros: list[Expanded]) -> str:
    groups = groupby(macros, key=lambda one: one.name.split("/", 1)[0])
    rows = [_xacro_row(repository, list(group)) for repository, group in groups]
    columns = ("files", "expanded", "accepted", "converted", "seconds")
    return table(["repository", *columns], [*rows, _xacro_row("all", macros)])


def _xacro_row(title: str, found: list[Expanded]) -> tuple[object, ...]:
    return (
        title,
        len(found),
        sum(one.expanded for one in found),
        sum(one.accepted for one in found),
        sum(one.converted for one in found),
        f"{sum(one.seconds for one in found):.1f}",
    )


_COLUMNS = ("files", "well-formed", "accepted", "converted", "unaccounted", "home", "identical", "seconds")


def _row(title: str, found: list[Examined]) -> tuple[object, ...]:
    return (
        title,
        len(found),
        sum(one.well_formed for one in found),
        sum(one.accepted for one in found),
        sum(one.converted for one in found),
        sum(len(one.unaccounted) for one in found),
        sum(one.home for one in found),
        sum(one.identical for one in found),
        f"{sum(one.seconds for one in found):.1f}",
    )


def _by_repository(outcomes: list[Outcome]) -> str:
    groups = groupby(outcomes, key=lambda outcome: outcome[0].repository)
    rows = (_row(repository, [found for _, found in group]) for repository, group in groups)
    return table(["repository", *_COLUMNS], rows)


def _by_rule(refusals: Iterable[tuple[tuple[str, ...], str]]) -> str:
    """A file counts under each rule that stopped it."""
    return listing(
        ["rule", "files", "for example"], frequent((rule, name) for rules, name in refusals for rule in rules)
    )


def _not_converted(found: list[Examined]) -> str:
    nothing = sum(one.without_robot for one in found)
    text = f"{nothing} files hold no model: lights, actors, physics; there is nothing to convert."
    groups: dict[str, list[Examined]] = {}
    for one in sorted(found, key=lambda one: one.not_converted_by):
        if one.not_converted_by:
            why = why_not_converted(KNOWN, one.name, one.not_converted_by) or UNEXPLAINED
            groups.setdefault(why, []).append(one)
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


def _not_home(found: list[Examined]) -> str:
    rows = by_place((one.name, one.astray) for one in found)
    return listing(COLUMNS_OF_ASTRAY, rows, empty="Nothing.", most=MOST_SHOWN)


def _listed(rows: Iterable[tuple[str, str]]) -> str:
    return listing(["file", "what"], rows, most=MOST_SHOWN)


REPORT = Report("corpus", "What the compiler makes of real files", _ABOUT, measure, known=KNOWN)
