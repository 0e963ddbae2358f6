"""What becomes of each plugin of Gazebo Classic in the corpus, by `migrate-gazebo-classic`?"""

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TypeVar

import twinform
from reports.fixes_and_passes import transmissions
from reports.fixes_and_passes.classic_blocks import Block, blocks
from reports.fixes_and_passes.classic_judging import MIGRATED, Judged, judged
from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.corpus.examine import rules_of
from testbed.corpus.files import CorpusFile, Kind, corpus_files
from testbed.markdown import frequent, listing, subsection, table
from twinform.compiler.audit import audit
from twinform.diagnostics import Diagnostic, Fate, Severity, rules

KNOWN = Known.beside(__file__)
PIPELINE = "migrate-gazebo-classic{release=harmonic controllers=controllers.yaml},check-plugins{release=harmonic}"
MOST_SHOWN = 60
_SECONDS = 600
_ABOUT = f"""\
Every `<plugin>` whose file begins with `libgazebo` or `libignition` is a *block*. Files that the compiler takes are
converted whole, with the pipeline

    {PIPELINE}

The blocks of all others (fragments of xacro, files of Gazebo before SDF, files with errors elsewhere) are migrated one
by one, each alone in a robot that has the links, joints and the sensor which it names, and with 1 for expressions of
xacro. A block is *migrated*, or *renamed* where it was one of Ignition, or *without a counterpart*, with the reason.
One that is not accounted for fails the command, and so do findings of `check-plugins` about what came out, unless their
reason is in `reports/fixes_and_passes/classic.toml`."""

Key = TypeVar("Key")
_SUBJECT = re.compile(r"plugin (?:'.*?'|None) of (\S+?),? ")
_CHECKED = {
    rules.DEFAULT_SYSTEMS_OFF,
    rules.IGNITION_PLUGIN_NAME,
    rules.MISSING_WORLD_SYSTEM,
    rules.PLUGIN_NOT_IN_RELEASE,
    rules.PLUGIN_PARAMETER_COUNT,
    rules.PLUGIN_PARAMETER_VALUE,
    rules.PLUGIN_REFERENCE,
    rules.UNKNOWN_PLUGIN_PARAMETER,
    rules.UNSUPPORTED_SENSOR,
    rules.WORLD_SYSTEM_NEEDED,
    rules.WRONG_PLUGIN_CLASS,
    rules.WRONG_PLUGIN_SCOPE,
}
"""What `check-plugins` finds."""


class End(StrEnum):
    """What became of a block."""

    MIGRATED = "migrated"
    RENAMED = "renamed"
    WITHOUT = "without a counterpart"
    UNACCOUNTED = "not accounted for"


_ENDS = {
    rules.MIGRATED_PLUGIN: End.MIGRATED,
    rules.IGNITION_NAME: End.RENAMED,
    rules.PLUGIN_WITHOUT_COUNTERPART: End.WITHOUT,
}


@dataclass(slots=True)
class Outcome:
    """What became of the blocks of a file: how often each end and reason, by the file of the plugin."""

    name: str
    whole: bool = False
    refused: str = ""
    ends: Counter[tuple[str, End]] = field(default_factory=Counter[tuple[str, End]])
    reasons: Counter[tuple[str, str]] = field(default_factory=Counter[tuple[str, str]])
    lost: Counter[tuple[str, str]] = field(default_factory=Counter[tuple[str, str]])
    checks: list[str] = field(default_factory=list[str])
    unaccounted: int = 0


def measure(sample: Sample) -> Findings:
    """Migrate every plugin."""
    files = _candidates(sample)
    outcomes = sample.outcomes(judge, files, lambda file, why: Outcome(file.name, checks=[why]), seconds=_SECONDS)
    found = [
        (one.name, fault, KNOWN.why("fault", file=one.name, fault=fault)) for one in outcomes for fault in _faults(one)
    ]
    whole = {one.name for one in outcomes if one.whole}
    read = judged(file for file in files if file.name in whole)
    control, apart = transmissions.section(sample)
    return Findings(
        [*_sections(outcomes, found), _by_libsdformat(read), control],
        _totals(outcomes),
        [
            *(f"{name}: {fault}" for name, fault, why in found if not why),
            *apart,
            *(f"{one.name}: libsdformat: {error}" for one in read for error in one.new),
        ],
    )


def judge(file: CorpusFile) -> Outcome | None:
    """Migrate every block of a file; None where it has none."""
    found = blocks(file.path)
    if not found:
        return None
    if file.path.suffix == ".xacro" or file.kind is Kind.XACRO:
        return _one_by_one(file, found, "a part of xacro")
    checked = twinform.check(file.path, paths=file.paths)
    if checked.document is None or not checked.accepted:
        return _one_by_one(file, found, ", ".join(rules_of(checked.diagnostics)))
    return _judge_whole_file(file, found, str(checked.document.format))


def _judge_whole_file(file: CorpusFile, found: list[Block], language: str) -> Outcome:
    outcome = Outcome(file.name, whole=True)
    conversion = twinform.convert(
        file.path, to="urdf" if language == "urdf" else "sdf", passes=PIPELINE, paths=file.paths
    )
    _count_outcomes(outcome, found, conversion)
    # what a newer version of SDF expresses in another way is not for this page
    plain = (
        audit(conversion.source, conversion.text, conversion.ledger).unaccounted
        if conversion.source is not None
        else ()
    )
    missing = [part for part in plain if "/plugin" in part.location.path or "/sensor" in part.location.path]
    outcome.unaccounted = len(missing)
    return outcome


def _one_by_one(file: CorpusFile, found: list[Block], why: str) -> Outcome:
    outcome = Outcome(file.name, refused=why)
    for block in found:
        try:
            conversion = twinform.convert(
                block.alone, to="urdf" if block.language == "urdf" else "sdf", passes=PIPELINE
            )
        except twinform.CompileError as error:
            outcome.ends[block.filename, End.UNACCOUNTED] += 1
            outcome.checks += [f"line {block.line}: {each.message}" for each in error.diagnostics if each.is_error]
        else:
            _count_outcomes(outcome, [block], conversion)
    return outcome


def _count_outcomes(outcome: Outcome, found: list[Block], conversion: twinform.Conversion) -> None:
    """Count what became of some blocks of a file."""
    wanted, reported = Counter(block.filename for block in found), Counter[str]()
    for entry in conversion.ledger.entries:
        subject = _SUBJECT.match(entry.message)
        if subject is not None and entry.rule in _ENDS:
            reported[subject[1]] += 1
            if subject[1] in wanted:
                outcome.ends[subject[1], _ENDS[entry.rule]] += 1
            if entry.fate is Fate.DROPPED:
                outcome.reasons[subject[1], entry.message.partition(": ")[2]] += 1
    for filename, count in (wanted - reported).items():
        outcome.ends[filename, End.UNACCOUNTED] += count
    for each in conversion.diagnostics:
        if each.rule is rules.PARAMETER_WITHOUT_COUNTERPART:
            name, _, why = each.message.partition(" has no counterpart: ")
            outcome.lost[name.partition(">")[0] + ">", why] += 1
    outcome.checks += [f"{each.rule.name}: {each.message}" for each in conversion.diagnostics if _is_check(each)]


def _is_check(diagnostic: Diagnostic) -> bool:
    return diagnostic.rule in _CHECKED and diagnostic.severity >= Severity.WARNING


def _faults(outcome: Outcome) -> Iterator[str]:
    for (filename, end), count in outcome.ends.items():
        if end is End.UNACCOUNTED:
            yield f"{count} blocks of {filename} are not accounted for"
    if outcome.unaccounted:
        yield f"{outcome.unaccounted} parts of plugins and sensors are in no ledger"
    yield from outcome.checks


def _candidates(sample: Sample) -> list[CorpusFile]:
    kinds = {Kind.URDF, Kind.SDF, Kind.XACRO, Kind.OLD_GAZEBO}
    return sample.of(file for file in corpus_files() if file.kind in kinds and b"lib" in file.path.read_bytes())


def _sections(outcomes: list[Outcome], found: list[tuple[str, str, str]]) -> Iterator[str]:
    yield _totals(outcomes)
    yield subsection("By plugin", _by_plugin(outcomes))
    yield subsection("Without a counterpart, and why", _counted("plugin", [one.reasons for one in outcomes]))
    yield subsection("Parameters that went nowhere, and why", _counted("parameter", [one.lost for one in outcomes]))
    rows = [(name, fault, why or "not known") for name, fault, why in found]
    checked = listing(["file", "finding", "why"], rows, empty="Nothing.")
    yield subsection("What `check-plugins` finds in the results", checked)
    apart = frequent((one.refused, "") for one in outcomes if not one.whole)
    one_by_one = table(["why", "files"], (row[:2] for row in apart))
    yield subsection("Files whose blocks were migrated one by one, and why", one_by_one)


def _by_libsdformat(read: list[Judged]) -> str:
    title = "What libsdformat 12 reports about the results"
    if not read:
        return subsection(title, "It is not here.")
    refused = "refused as SDF before and after, mostly for includes that are not on this machine"
    rows = [
        ("read as SDF, source and result", sum(one.before and one.after for one in read)),
        (refused, sum(not one.before and not one.after for one in read)),
        ("read only after", sum(one.after and not one.before for one in read)),
        ("refused only after, or for another reason", sum(bool(one.new) for one in read)),
    ]
    about = f"It reads Fortress's SDF, so these were migrated with `{MIGRATED}`."
    return subsection(title, about, table(["files that were converted whole", "number"], rows))


def _totals(outcomes: list[Outcome]) -> str:
    whole, apart = ([one for one in outcomes if one.whole is kind] for kind in (True, False))
    head = ["files", "number", "blocks", *End, "accounted for", "with a finding of check-plugins"]
    return table(head, [_row("whole", whole), _row("one by one", apart), _row("all", outcomes)])


def _row(title: str, found: list[Outcome]) -> tuple[object, ...]:
    counts = Counter[End]()
    for (_, end), count in _total(one.ends for one in found).items():
        counts[end] += count
    total = counts.total()
    share = f"{100 * (total - counts[End.UNACCOUNTED]) / total:.1f}%" if total else "100%"
    return (title, len(found), total, *(counts[end] for end in End), share, sum(bool(one.checks) for one in found))


def _by_plugin(outcomes: list[Outcome]) -> str:
    ends = _total(one.ends for one in outcomes)
    totals = {name: sum(ends[name, end] for end in End) for name, _ in ends}
    ordered = sorted(totals.items(), key=lambda item: (-item[1], item[0]))
    return table(["file", "blocks", *End], [(*row, *(ends[row[0], end] for end in End)) for row in ordered])


def _counted(what: str, counters: Iterable[Counter[tuple[str, str]]]) -> str:
    found = [(name, count, why) for (name, why), count in _total(counters).items()]
    rows = sorted(found, key=lambda row: (-row[1], row[0], row[2]))
    return listing([what, "times", "why"], rows, empty="None.", most=MOST_SHOWN)


def _total(counters: Iterable[Counter[Key]]) -> Counter[Key]:
    return sum(counters, Counter[Key]())


SECTION = Section("classic", _ABOUT, measure, known=KNOWN)
