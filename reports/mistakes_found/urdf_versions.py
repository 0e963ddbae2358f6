"""Do we judge documents of every version of URDF as urdfdom 6 does?"""

import re
from collections import Counter
from collections.abc import Iterable

from reports.harness.needs import urdfdom_6
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.mistakes_found.verdict_reasons import reasons
from reports.mistakes_found.verdicts import unexplained
from testbed.markdown import subsection, table
from testbed.mutated.verdicts import OF_VERSIONS, Verdict, verdicts
from testbed.mutated.versioned import versioned
from twinform.ir.versions import versions_of

DOCUMENTS = 2000
_DECLARED = re.compile(r"<robot [^>]*?version=[\"']([^\"']*)")
_ABOUT = """\
Robots of two or three links, whose number decides about all that they consist of (`testbed/mutated/versioned.py`), are
read by `twinform check` and by urdfdom 6, the first release that reads URDF 1.2. A few values in a hundred are odd, a
few parts stand twice, and one document in twelve declares a version that there is not, or spells one in another way.
Where only one of the two refuses, there is a reason (`reports/mistakes_found/verdicts.toml`)."""


def judged(seeds: Iterable[int]) -> list[Verdict]:
    """The documents with these numbers before urdfdom 6."""
    return list(verdicts([OF_VERSIONS], map(versioned, seeds)))


def measure(sample: Sample) -> Findings:
    """Ask both, and find the reasons where they disagree."""
    found = judged(range(0, DOCUMENTS, sample.every))
    groups = ["none", *versions_of("urdf"), "another"]
    head = ["version", "documents", "both accept", "both refuse", "only we refuse", "only they refuse"]
    counts = table(head, ((group, *_row([one for one in found if _group(one) == group])) for group in groups))
    explained = Counter(reason.why for verdict in found for reason in reasons(verdict))
    why = subsection("Why", table(["documents", "reason"], ((count, text) for text, count in explained.items())))
    return Findings([counts, *([why] if explained else [])], counts, list(map(str, unexplained(found))))


def _group(verdict: Verdict) -> str:
    declared = _DECLARED.search(verdict.document.text.decode())
    if declared is None:
        return "none"
    return declared[1] if declared[1] in versions_of("urdf") else "another"


def _row(found: list[Verdict]) -> tuple[int, ...]:
    pairs = Counter((one.accepted, one.opinion.accepts) for one in found)
    kinds = ((True, True), (False, False), (False, True), (True, False))
    return (pairs.total(), *(pairs[kind] for kind in kinds))


SECTION = Section("urdf_versions", _ABOUT, measure, (urdfdom_6,))
