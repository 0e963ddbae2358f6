"""Does everything come back from MJCF? Every URDF and SDF of the corpus becomes MJCF and then what it was."""

from collections.abc import Iterable

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.text_survives.mismatches import COLUMNS, by_path
from testbed.corpus.files import Kind
from testbed.corpus.home_from_mjcf import Home, come_home
from testbed.markdown import frequent, grouped, listing, subsection, table

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every URDF and SDF file of the corpus is converted to MJCF and back, a world as a whole, to the version of the source;
robots also by way of the third language, before MJCF and after it. *Home* means what it means
[above](#what-the-compiler-makes-of-real-files): it is the same robot by `twinform diff`, and every name, attribute and
text that is not the spelling of a default is back, and nothing else has come along. A file with includes comes back
without them: of that, each of its first robots is a text of its own, and counted. Lost is also what `convert --audit`
finds neither in the first result nor in the ledger."""


def measure(sample: Sample) -> Findings:
    """Convert there and back."""
    rows, homes, died = list[tuple[object, ...]](), list[Home](), list[str]()
    for kind in (Kind.URDF, Kind.SDF):
        found, failures = sample.lists(come_home, sample.models(kind), seconds=120)
        ways = grouped(((kind.value, *one.way), one) for one in found)
        rows += [(" -> ".join((*way, kind.value)), *_counts(ones)) for way, ones in sorted(ways.items())]
        homes += found
        died += failures
    counts = table(["way", "files and robots", "written", "home", "explained", "lost"], rows)
    refused = frequent((rule, one.name) for one in homes if len(one.way) == 1 for rule in one.refused_by)
    named = [(why, one.name) for one in homes if one.lost and (why := _why(one))]
    lost = [one for one in homes if one.lost and not _why(one)]
    parts = [
        subsection("Files that became MJCF and came back", counts),
        subsection("What no MJCF can be written for, by rule", listing(["rule", "files", "for example"], refused)),
        subsection("What is not as it was, and why that is left", listing(["why", "file"], sorted(set(named)))),
        subsection("What does not come back", listing(COLUMNS, by_path((one.name, one.lost) for one in lost))),
    ]
    return Findings(parts, counts, [*(f"{one.name}, {one.way}: {one.lost[0].message}" for one in lost), *died])


def _why(one: Home) -> str:
    return KNOWN.why("lost", one.name)


def _counts(homes: Iterable[Home]) -> tuple[int, ...]:
    homes = list(homes)
    written = [one for one in homes if not one.refused_by]
    odd = [one for one in written if one.lost]
    named = [one for one in odd if _why(one)]
    return len(homes), len(written), len(written) - len(odd), len(named), len(odd) - len(named)


SECTION = Section("mjcf_home", _ABOUT, measure, known=KNOWN)
