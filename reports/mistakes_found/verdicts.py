"""Where do libsdformat 12 and urdfdom judge mutated files otherwise, and why?"""

from collections import Counter
from collections.abc import Iterable, Iterator

from reports.harness.needs import corpus, libsdformat, urdfdom
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.mistakes_found.verdict_reasons import OURS, THEIRS, Reason, reasons
from testbed.corpus.files import Kind
from testbed.markdown import rule_links, subsection, table
from testbed.mutated.mutated import mutated, sources
from testbed.mutated.verdicts import QUESTIONS, Question, Verdict, verdicts

DOCUMENTS = {Kind.SDF: 4000, Kind.URDF: 6000}
_AT_ONCE = 1000
_ABOUT = """\
Files of the corpus, with one to four mistakes each, are read by `twinform check` and by the parser that Gazebo or ROS
reads them with: libsdformat 12 (SDF up to 1.9, and URDF through its converter) and urdfdom (`check_urdf`). The number
of a document decides which file it is and which mistakes are made: a number spelt in another way or out of range, a
name that nothing has, an element left out, repeated or put elsewhere (`testbed/mutated/slips.py`), or changes that
mean nothing (`testbed/mutated/mutants.py`).

libsdformat accepts a file that it reads without an error; what it only writes to the terminal does not count. urdfdom
accepts a file where it has no error message: after many a fault it drops the rest of the link and goes on. We are
asked without `--strict`, since names that the formats do not know are a warning to libsdformat and nothing to urdfdom.

Where only one of the two refuses, there is a reason, by rule or by message and not by file
(`reports/mistakes_found/verdicts.toml`). A refusal without one is a failure of the command."""


def measure(sample: Sample) -> Findings:
    """Ask everybody, and find the reasons of those who disagree."""
    seeds = {kind: range(0, count, sample.every) for kind, count in DOCUMENTS.items()}
    found = [verdict for kind in seeds for verdict in judged(kind, seeds[kind])]
    explained = Counter(reason for verdict in found for reason in reasons(verdict))
    counts = _counts(found)
    return Findings([counts, *_explanations(explained)], counts, list(map(str, unexplained(found))))


def judged(kind: Kind, seeds: Iterable[int]) -> Iterator[Verdict]:
    """The documents with these numbers before every judge of their kind, a thousand at a time."""
    questions = [question for question in QUESTIONS if question.kind is kind]
    numbers = list(seeds)
    for start in range(0, len(numbers), _AT_ONCE):
        yield from verdicts(questions, (mutated(kind, seed) for seed in numbers[start : start + _AT_ONCE]))


def unexplained(found: Iterable[Verdict]) -> list[Verdict]:
    """Where only one of the two refuses, and nobody knows why."""
    return [verdict for verdict in found if verdict.accepted != verdict.opinion.accepts and not reasons(verdict)]


def _counts(found: list[Verdict]) -> str:
    head = ["documents", "files", "judged", "both accept", "both refuse", "only we refuse", "only they refuse"]
    return table(head, (_row(question, found) for question in QUESTIONS))


def _row(question: Question, found: list[Verdict]) -> tuple[object, ...]:
    pairs = Counter((one.accepted, one.opinion.accepts) for one in found if one.question == question)
    kinds = ((True, True), (False, False), (False, True), (True, False))
    return (question, len(sources(question.kind)), pairs.total(), *(pairs[kind] for kind in kinds))


def _explanations(explained: Counter[Reason]) -> Iterator[str]:
    ours = (
        (explained[one], one.scope, rule_links([one.rule]), f"`{one.text}`" if one.text else "", one.why)
        for one in OURS
        if explained[one]
    )
    yield subsection("We refuse, they accept", table(["documents", "judge", "rule", "about", "why"], ours))
    theirs = (
        (explained[one], one.scope, f"`{one.text}`", rule_links(one.rules) or "nothing", one.why)
        for one in THEIRS
        if explained[one]
    )
    yield subsection(
        "They refuse, we accept", table(["documents", "judge", "message", "what we report", "why"], theirs)
    )


SECTION = Section("verdicts", _ABOUT, measure, (corpus, libsdformat, urdfdom))
