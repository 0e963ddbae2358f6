"""Are files the same robots after `check --fix`, and how much does it fix?"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from testbed.corpus.files import CorpusFile, corpus_files
from testbed.fixed_files import FixedFile, fixed_file
from testbed.markdown import listing, rule_links, subsection, table
from twinform.compiler import LoadOptions, inspect, read
from twinform.diagnostics import catalog

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every file of the corpus but those that xacro expands is fixed with all safe fixes, and once more with the unsafe ones.
Nothing is written. *The same robot* is the verdict of `twinform diff` where the file had no error before; what cannot
be compared includes models that are not here. *Kept* means that of the result

* a second run changes nothing;
* there is no finding that was not there before, and where there were errors, there are no more of them;
* every comment is there still, and every byte between the fixes (where one round was enough, which shows it);
* the encoding, the byte order mark and the line ends are the same;
* no fix is safer than the page of its rule says.

*Taken back* are fixes that would have made another finding."""


_VERDICTS = {True: "the same robot", False: "another robot", None: "cannot be compared, or had errors"}


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a file, and how many findings it has of the rules with fixes, and how many with a fix."""

    name: str
    fixed: FixedFile
    found: Mapping[str, int] = field(default_factory=dict[str, int])


def measure(sample: Sample) -> Findings:
    """Fix every file."""
    files = [each for each in sample.of(corpus_files()) if each.path.suffix != ".xacro"]
    outcomes = sample.outcomes(
        _outcome, files, lambda file, why: Outcome(file.name, FixedFile(file.name, faults=(why,)))
    )
    totals = _totals(outcomes)
    faults = [(each.name, fault) for each in outcomes for fault in each.fixed.faults]
    rows = [(name, fault, KNOWN.why("faults", name) or UNEXPLAINED) for name, fault in faults]
    return Findings(
        [
            subsection("Totals", totals),
            subsection("By rule", _by_rule(outcomes)),
            subsection("Broken promises", listing(("file", "what", "why"), rows)),
        ],
        totals,
        [f"{name}: {fault}" for name, fault, why in rows if why == UNEXPLAINED],
    )


def _outcome(file: CorpusFile) -> Outcome:
    data, load_options = file.path.read_bytes(), LoadOptions()
    loaded = inspect(read(data, load_options, name=str(file.path)), load_options)
    found = Counter(each.rule.name for each in loaded.diagnostics if each.rule.fix)
    return Outcome(file.name, fixed_file(str(file.path), data), found)


def _totals(outcomes: Sequence[Outcome]) -> str:
    changed = [each.fixed for each in outcomes if each.fixed.changed]
    unsafe = [each for each in outcomes if each.fixed.unsafe and not each.fixed.changed]
    verdicts = Counter(each.same for each in changed)
    rows = [
        ("files", len(outcomes)),
        ("with a finding of a rule that has fixes", sum(bool(each.found) for each in outcomes)),
        ("changed by safe fixes", len(changed)),
        *((f"- {words}", verdicts[verdict]) for verdict, words in _VERDICTS.items()),
        ("findings fixed by safe fixes", sum(count for each in changed for _, count in each.safe)),
        ("changed only with unsafe fixes", len(unsafe)),
        ("fixes taken back", sum(len(each.fixed.refused) for each in outcomes)),
        ("broken promises", sum(len(each.fixed.faults) for each in outcomes)),
    ]
    return table(("", "number"), rows)


def _counts_of(rule: str, made: Iterable[Iterable[tuple[str, int]]]) -> list[int]:
    return [count for each in made for name, count in each if name == rule]


def _by_rule(outcomes: Sequence[Outcome]) -> str:
    rows: list[tuple[object, ...]] = []
    for name, rule in catalog().items():
        if rule.fix is None:
            continue
        found = [each.found[name] for each in outcomes if name in each.found]
        safe = _counts_of(name, (each.fixed.safe for each in outcomes))
        unsafe = _counts_of(name, (each.fixed.unsafe for each in outcomes))
        back = sum(each.fixed.refused.count(name) for each in outcomes)
        if found or safe or unsafe:
            cells = (sum(found), len(found), sum(safe), len(safe), sum(unsafe), len(unsafe), back)
            rows.append((rule_links([name]), rule.fix, *cells))
    head = ("rule", "at best", "findings", "in files", "safe", "in files", "with unsafe", "in files", "taken back")
    rows.sort(key=lambda row: (-int(str(row[2])), str(row[0])))
    return table(head, rows)


SECTION = Section("fixes", _ABOUT, measure, known=KNOWN)
