"""Is it the same robot after the passes for a consumer, but for the changes that the ledger lists?"""

from collections import Counter
from collections.abc import Iterator, Sequence

from reports.fixes_and_passes.physics_verdicts import Outcome, Verdict, judge
from reports.harness.known import Known
from reports.harness.needs import corpus, drake
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.corpus.files import Kind
from testbed.markdown import cross_table, subsection, table
from twinform.profiles import names

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every file of the corpus, with small boxes for its meshes, is converted for each profile
(`twinform convert --for NAME`): into its own format where the
consumer reads that, into URDF where it does not, and into SDF for Gazebo. Where a pass has changed something, Drake is
asked. What it compares the result with is the source with the values that the ledger lists written into it, one by
one, by a few lines of code that know nothing of any pass (`testbed/ledger_changes.py`): so it finds both what was
changed and is not listed, and what is listed and was not changed. Collisions of links of which the ledger lists that
other shapes collide are left out of both: which they are is for the cases of the passes to show.

*Nothing was changed* are files that need no pass: the result is that of a conversion for nobody. *Not converted* are
files with errors, or of which a consumer would refuse the result."""


def measure(sample: Sample) -> Findings:
    """Convert every file for every profile, and ask."""
    found, failures = sample.lists(judge, sample.models(Kind.URDF, Kind.SDF), seconds=600)
    wrong = [each for each in found if each.verdict is Verdict.DIFFERENT]
    known = {each.name: KNOWN.why("different", each.name, cause=each.cause) for each in wrong}
    faults = [f"{each.name}: {each.cause}" for each in wrong if not known[each.name]]
    faults += failures
    totals = _totals(found)
    return Findings([totals, *_passes(found), *_causes(found), *_different(wrong, known)], totals, faults)


def _totals(found: Sequence[Outcome]) -> str:
    order = {profile: number for number, profile in enumerate(names())}
    met = sorted(((each.profile, each.verdict) for each in found), key=lambda pair: order[pair[0]])
    return cross_table(["profile"], met, Verdict)


def _passes(found: Sequence[Outcome]) -> Iterator[str]:
    count = Counter(name for each in found for name in each.passes)
    parts = sum(each.changed for each in found)
    rows = [(f"`{name}`", number) for name, number in count.most_common()]
    yield subsection(
        "Passes that changed the physics", f"{parts} links and joints are listed.", table(("pass", "conversions"), rows)
    )


def _causes(found: Sequence[Outcome]) -> Iterator[str]:
    files, profiles = dict[str, set[str]](), dict[str, set[str]]()
    for each in (each for each in found if each.verdict is Verdict.REFUSED):
        files.setdefault(each.cause, set()).add(each.name.rpartition(" for ")[0])
        profiles.setdefault(each.cause, set()).add(each.profile)
    rows = [
        (cause, len(files[cause]), "all" if profiles[cause] == set(names()) else ", ".join(sorted(profiles[cause])))
        for cause in sorted(files)
    ]
    yield subsection("Not converted", table(("first error", "files", "profiles"), rows))


def _different(wrong: Sequence[Outcome], known: dict[str, str]) -> Iterator[str]:
    if wrong:
        rows = [(each.name, each.cause, known[each.name] or "?") for each in wrong]
        yield subsection("Different", table(("conversion", "what Drake reports", "why"), rows))


SECTION = Section("physics", _ABOUT, measure, (corpus, drake), KNOWN)
