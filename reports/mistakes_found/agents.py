"""Does a script that has only the tools of `twinform mcp` mend planted mistakes?"""

import tempfile
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from reports.harness.needs import need
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.markdown import listing, subsection, table
from testbed.mistakes import Mistake

_WANTED = 0.95
_ABOUT = """\
The mistakes of `tests/mistakes/columns.toml` in files in which there is nothing else to find, one after the other. A
script (`testbed/mending.py`) talks to `twinform mcp` on standard input and output, through the client of the official
SDK, and knows XML and nothing of robots. It writes what `fix` fixes. For what is left it tries edits of the piece that
a finding is about, made of the suggestions and expectations in the finding, of values and names of `schema`, and of
names in the file, and keeps the one after which `check` finds least; taking the part away comes last. A file is mended
where `check` finds nothing any more. Whether the robot is the one before the mistake is asked with `diff`: nobody can
know a number that was overwritten."""


@dataclass(frozen=True)
class _Planted:
    """A mistake with a name, to draw from."""

    mistake: Mistake

    @property
    def name(self) -> str:
        """What is wrong."""
        return self.mistake.what


def measure(sample: Sample) -> Findings:
    """Let the script mend them."""
    from testbed.mending import PLANTED, Ending, mend_planted  # noqa: PLC0415 - it needs the SDK

    planted: Sequence[_Planted] = sample.of(map(_Planted, PLANTED))
    with tempfile.TemporaryDirectory() as folder:
        endings = mend_planted(Path(folder), [each.mistake for each in planted])
    counts = Counter(endings)
    mended = counts[Ending.SAME] + counts[Ending.ANOTHER] + counts[Ending.REMOVED]
    head = table(["mistakes", "mended", "share"], [(len(planted), mended, f"{mended / len(planted):.0%}")])
    kinds = table(["ending", "mistakes"], ((each.value, counts[each]) for each in Ending))
    others = {Ending.REMOVED, Ending.LEFT, Ending.UNFOUND}
    pairs = [(each.name, ending) for each, ending in zip(planted, endings, strict=True) if ending in others]
    rest = subsection("Not mended, or by taking away", listing(["mistake", "ending"], pairs))
    few = [f"{mended} of {len(planted)} are mended"] if mended < _WANTED * len(planted) else []
    return Findings([head, kinds, rest], head, few)


SECTION = Section("agents", _ABOUT, measure, (need(lambda: find_spec("mcp") is not None, "pip install '.[mcp]'"),))
