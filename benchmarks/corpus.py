"""What the compiler makes of every real file: `make corpus`. Writes docs/reference/corpus.md."""

import sys
import time
from collections import Counter
from collections.abc import Iterable
from itertools import groupby

from benchmarks.markdown import table, write
from tests.corpus.examine import MOST_ROBOTS, SDF_VERSION, Examined, examine
from tests.corpus.examine_xacro import Expanded, examine_xacro
from tests.corpus.files import CORPUS, MISSING, ROOT, CorpusFile, Kind, corpus_files, models, xacro_files
from twinform.testing.workers import Failure, run

PAGE = ROOT / "docs" / "reference" / "corpus.md"
MOST_SHOWN = 40
INTRODUCTION = f"""# What the compiler makes of real files

Made by `make corpus`; only the seconds differ from run to run.

Every URDF and SDF file of the corpus is read (*well-formed* says what a strict XML parser thinks of it, *accepted*
that `twinform check` finds no error), converted to the other format (URDF to SDF {SDF_VERSION}; of a file with several
models the first {MOST_ROBOTS}, one by one), and written again in its own format and version. *Identical* means that a
comparison of XML trees, which knows nothing of the compiler, finds the text equal to the file but for white space,
comments, the spelling of numbers and the order of unlike siblings.

Every `.xacro` file is *expanded* without arguments, with the packages around it in the corpus and no others, then
checked and converted likewise. Most are libraries of macros, which are no robots by themselves, or need packages that
the corpus does not have."""

Outcome = tuple[CorpusFile, Examined]


def main() -> int:
    """Examine, report, and fail where a promise is broken."""
    if not CORPUS.is_dir():
        print(MISSING, file=sys.stderr)
        return 1
    start = time.perf_counter()
    outcomes = sorted(_outcomes(), key=lambda outcome: outcome[0].name)
    macros = sorted(_macros(), key=lambda each: each.name)
    seconds = time.perf_counter() - start
    write(PAGE, INTRODUCTION, *_sections(outcomes, macros, seconds))
    print(_totals(outcomes, seconds), _xacro_totals(macros), f"written to {PAGE.relative_to(ROOT)}", sep="\n")
    faults = [f"{name}: {fault}" for name, fault in _faults(outcomes, macros)]
    print(*faults[:MOST_SHOWN], sep="\n", file=sys.stderr)
    print(f"{len(faults)} broken promises", file=sys.stderr)
    return 1 if faults else 0


def _outcomes() -> Iterable[Outcome]:
    for file, result in run(_examine, models()):
        if isinstance(result, Failure):
            result = Examined(file.name, well_formed=False, faults=(result.cause,))  # noqa: PLW2901
        yield file, result


def _examine(file: CorpusFile) -> Examined:
    return examine(file.path, file.name)


def _macros() -> Iterable[Expanded]:
    for file, result in run(_examine_xacro, xacro_files()):
        yield Expanded(file.name, faults=(result.cause,)) if isinstance(result, Failure) else result


def _examine_xacro(file: CorpusFile) -> Expanded:
    return examine_xacro(file.path, file.name)


def _faults(outcomes: list[Outcome], macros: list[Expanded]) -> Iterable[tuple[str, str]]:
    for one in (*(found for _, found in outcomes), *macros):
        yield from ((one.name, fault) for fault in one.faults)


def _sections(outcomes: list[Outcome], macros: list[Expanded], seconds: float) -> Iterable[str]:
    found = [outcome for _, outcome in outcomes]
    yield "## Totals\n\n" + _totals(outcomes, seconds)
    yield "## xacro\n\n" + _xacro_totals(macros)
    yield "## xacro files refused, by rule\n\n" + _by_rule((one.refused_by, one.name) for one in macros)
    yield "## By repository\n\n" + _by_repository(outcomes)
    yield "## Files refused, by rule\n\n" + _by_rule((one.refused_by, one.name) for one in found)
    yield "## Files accepted and not converted, by rule\n\n" + _by_rule(
        (one.not_converted_by, one.name) for one in found
    )
    yield "## Files refused that another reader accepts\n\n" + _stricter_than_others(outcomes)
    yield "## Files not identical\n\n" + _listed((one.name, one.difference) for one in found if one.difference)
    yield "## Broken promises\n\n" + _listed(_faults(outcomes, macros))


def _totals(outcomes: list[Outcome], seconds: float) -> str:
    kinds = Counter(file.kind for file in corpus_files())
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


_COLUMNS = ("files", "well-formed", "accepted", "converted", "identical", "seconds")


def _row(title: str, found: list[Examined]) -> tuple[object, ...]:
    return (
        title,
        len(found),
        sum(one.well_formed for one in found),
        sum(one.accepted for one in found),
        sum(one.converted for one in found),
        sum(one.identical for one in found),
        f"{sum(one.seconds for one in found):.1f}",
    )


def _by_repository(outcomes: list[Outcome]) -> str:
    groups = groupby(outcomes, key=lambda outcome: outcome[0].repository)
    rows = (_row(repository, [found for _, found in group]) for repository, group in groups)
    return table(["repository", *_COLUMNS], rows)


def _by_rule(refusals: Iterable[tuple[tuple[str, ...], str]]) -> str:
    """A file counts under each rule that stopped it, and is shown under the first."""
    counts: Counter[str] = Counter()
    examples: dict[str, str] = {}
    for rules, name in refusals:
        counts.update(rules)
        for rule in rules:
            examples.setdefault(rule, name)
    rows = (
        (rule, count, examples[rule]) for rule, count in sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    )
    return table(["rule", "files", "for example"], rows) if counts else "None."


def _stricter_than_others(outcomes: list[Outcome]) -> str:
    parts: list[str] = []
    for reader, column in (("urdfdom 3.0.1", "check_urdf"), ("libsdformat 12.3", "libsdformat12")):
        good = [outcome for outcome in outcomes if outcome[0].row.get(column) == "ok"]
        refused = [found for _, found in good if not found.accepted]
        parts.append(f"{reader} accepts {len(good)} of these files; {len(refused)} of them are refused here.")
        parts.append(_by_rule((one.refused_by, one.name) for one in refused))
        parts.append(_listed((one.name, ", ".join(one.refused_by)) for one in refused))
    return "\n\n".join(part.strip() for part in parts)


def _listed(rows: Iterable[tuple[str, str]]) -> str:
    rows = list(rows)
    more = f"\n{len(rows) - MOST_SHOWN} more.\n" if len(rows) > MOST_SHOWN else ""
    return table(["file", "what"], rows[:MOST_SHOWN]) + more if rows else "None."


if __name__ == "__main__":
    sys.exit(main())
