"""Does the other file follow an edit, and nothing else in it change?"""

from collections import Counter

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.text_survives.edit_jobs import corpus_jobs
from reports.text_survives.followed_edits import Fate, Followed, work
from testbed.corpus.files import ROOT
from testbed.markdown import frequent, listing, subsection, table

KNOWN = Known.beside(__file__)
_SECONDS = 300
_EDITS = {True: 4, False: 2}
"""Edits for a URDF file, and for an SDF file."""
_ABOUT = """\
Every model of the corpus is converted, the result is edited at random as people edit (the edits of
[edits](#edits-win)), and the edits are patched into the model's own file, as `twinform convert EDITED --into FILE`
does.
*Followed* means: `twinform diff` finds no difference between the edited file and the one that follows it, but such as
there were before the edit, or would be if it were written anew; no comment is gone but with its element; and no more
lines differ than twice those of the change in our own layout, and 14. What the conversion of the edited file refuses
is refused here, and nothing is written. Files with several models are left out: it takes `--model` to convert them."""


def measure(sample: Sample) -> Findings:
    """Convert, edit, and follow."""
    jobs = sorted(sample.of(corpus_jobs(sample.seed, _EDITS)), key=lambda job: -job.path.stat().st_size)
    done, failures = sample.lists(work, jobs, seconds=_SECONDS)
    reasons = {one: KNOWN.why("fault", one.name, kind=one.kind) for one in done if one.faults}
    faults = [f"{one.name}: {one.kind}: {fault}" for one, why in reasons.items() if not why for fault in one.faults]
    return Findings(
        [part.replace(f"{ROOT}/", "") for part in _sections(done, failures, reasons, sample.seed)],
        "\n".join(f"{count} {fate}" for fate, count in Counter(one.fate for one in done).most_common()),
        [*failures, *faults],
    )


def _sections(done: list[Followed], failures: list[str], reasons: dict[Followed, str], seed: int) -> list[str]:
    rows = [
        (way, *(sum(one.fate is fate for one in done if one.to_urdf is flag) for fate in Fate))
        for way, flag in (("an edit of SDF follows into URDF", True), ("an edit of URDF follows into SDF", False))
    ]
    followed = [one for one in done if one.fate is Fate.FOLLOWED]
    lines = sorted(one.lines for one in followed)
    middle, most, all_of_them = (_quantile(lines, part) for part in (0.5, 0.9, 1))
    spread = f"Changed lines: {middle} in the middle, {most} at nine tenths, {all_of_them} at most."
    kinds = frequent((one.kind, one.name) for one in followed)
    wrong = [(one.name, one.kind, "; ".join(one.faults)[:200], why or UNEXPLAINED) for one, why in reasons.items()]
    wrong += [(each, "", "", UNEXPLAINED) for each in failures]
    about = f"{len(done)} edits of {len({one.name for one in done})} files, seed {seed}."
    return [
        subsection("What became of the edits", about, table(["", *Fate], rows), spread),
        subsection("Faults", listing(["file", "edit", "what", "why"], wrong)),
        subsection("Edits that were followed", listing(["kind", "edits", "such as"], kinds)),
    ]


def _quantile(values: list[int], part: float) -> int:
    return values[min(len(values) - 1, int(part * len(values)))] if values else 0


SECTION = Section("following", _ABOUT, measure, known=KNOWN)
