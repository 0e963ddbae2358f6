"""Conversions for each consumer before Drake: the same robot, but for the changes that the ledger lists."""

from collections import Counter
from collections.abc import Iterator, Sequence

from reports.harness.known import Known
from reports.harness.needs import corpus, drake
from reports.harness.pages import section, table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample
from reports.physics.judging import Job, Outcome, Verdict, judge
from tests.corpus.files import Kind
from twinform.profiles import names

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every file of the corpus, with small boxes for its meshes, is converted for each profile
(`twinform convert --for NAME`): into its own format where the
consumer reads that, into URDF where it does not, and into SDF for Gazebo. Where a pass has changed something, Drake is
asked. What it compares the result with is the source with the values that the ledger lists written into it, one by
one, by a few lines of code that know nothing of any pass (`reports/physics/applying.py`): so it finds both what was
changed and is not listed, and what is listed and was not changed.

*Nothing was changed* are files of which the text is that of a conversion for nobody. *Not converted* are files with
errors, or of which a consumer would refuse the result."""


def measure(sample: Sample) -> Findings:
    """Convert every file for every profile, and ask."""
    jobs = [Job(file, profile) for profile in names() for file in sample.models(Kind.URDF, Kind.SDF)]
    found = sample.outcomes(judge, jobs, lambda job, cause: Outcome(job.name, job.profile, Verdict.DIFFERENT, cause))
    wrong = [each for each in found if each.verdict is Verdict.DIFFERENT]
    known = {each.name: KNOWN.why("different", each.name, cause=each.cause) for each in wrong}
    faults = [f"{each.name}: {each.cause}" for each in wrong if not known[each.name]]
    totals = _totals(found)
    return Findings([totals, *_passes(found), *_causes(found), *_different(wrong, known)], totals, faults)


def _totals(found: Sequence[Outcome]) -> str:
    rows: list[tuple[object, ...]] = []
    for profile in names():
        count = Counter(each.verdict for each in found if each.profile == profile)
        rows.append((profile, *(count[verdict] for verdict in Verdict)))
    return table(("profile", *Verdict), rows)


def _passes(found: Sequence[Outcome]) -> Iterator[str]:
    count = Counter(name for each in found for name in each.passes)
    parts = sum(each.changed for each in found)
    rows = [(f"`{name}`", number) for name, number in count.most_common()]
    yield section(
        "Passes that changed the physics", f"{parts} links and joints are listed.", table(("pass", "conversions"), rows)
    )


def _causes(found: Sequence[Outcome]) -> Iterator[str]:
    count = Counter((each.profile, each.cause) for each in found if each.verdict is Verdict.REFUSED)
    rows = [(profile, cause, number) for (profile, cause), number in sorted(count.items())]
    yield section("Not converted", table(("profile", "first error", "files"), rows))


def _different(wrong: Sequence[Outcome], known: dict[str, str]) -> Iterator[str]:
    if wrong:
        rows = [(each.name, each.cause, known[each.name] or "?") for each in wrong]
        yield section("Different", table(("conversion", "what Drake reports", "why"), rows))


REPORT = Report(
    "physics", "Conversions for a consumer, and what the ledger lists", _ABOUT, measure, (corpus, drake), KNOWN
)
