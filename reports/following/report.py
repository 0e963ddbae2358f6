"""Edits of converted files, patched into the files that they were made of."""

from collections import Counter

from reports.edits.jobs import corpus_jobs
from reports.following.judging import Fate, Followed, work
from reports.harness.known import Known
from reports.harness.pages import frequent, listing, section, table
from reports.harness.report import UNEXPLAINED, Findings, Report
from reports.harness.sample import Sample
from tests.corpus.files import ROOT

KNOWN = Known.beside(__file__)
_SECONDS = 300
_EDITS = {True: 4, False: 2}
"""Edits for a URDF file, and for an SDF file."""
_ABOUT = """\
Every model of the corpus is converted, the result is edited at random as people edit (the edits of
[edits](edits.md)), and the edits are patched into the model's own file, as `twinform convert EDITED --into FILE` does.
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
    spread = (
        f"Changed lines: {_at(lines, 0.5)} in the middle, {_at(lines, 0.9)} at nine tenths, {_at(lines, 1)} at most."
    )
    kinds = frequent((one.kind, one.name) for one in followed)
    wrong = [(one.name, one.kind, "; ".join(one.faults)[:200], why or UNEXPLAINED) for one, why in reasons.items()]
    return [
        section(
            "What became of the edits",
            f"{len(done)} edits of {len({one.name for one in done})} files, seed {seed}.",
            table(["", *Fate], rows),
            spread,
        ),
        section(
            "Faults",
            listing(["file", "edit", "what", "why"], [*wrong, *((each, "", "", UNEXPLAINED) for each in failures)]),
        ),
        section("Edits that were followed", listing(["kind", "edits", "such as"], kinds)),
    ]


def _at(values: list[int], part: float) -> int:
    return values[min(len(values) - 1, int(part * len(values)))] if values else 0


REPORT = Report("following", "The other file follows", _ABOUT, measure, known=KNOWN)
