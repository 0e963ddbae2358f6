"""Are planted mistakes found at the piece that is wrong, and what is reported about models that others accept?"""

import random
import re
import tempfile
from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Sequence
from pathlib import Path

from reports.harness import needs
from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.corpus.files import CorpusFile, Kind, models
from testbed.markdown import listing, rule_links, subsection, table
from testbed.mistakes import MISTAKES, Mistake, is_at
from testbed.oracles import urdfdom
from twinform.compiler import check
from twinform.compiler.input.finding_spans import located
from twinform.diagnostics import Diagnostic, Severity
from twinform.testing.oracles import libsdformat

KNOWN = Known.beside(__file__)
CLEAN = 200
_SEED = 17
_ABOUT = """\
Each mistake of `tests/mistakes/columns.toml` is one edit in a model without mistakes, most of them written for this,
some of the corpus: a slip in a name, a unit, a comma, swapped parents, a tag that is not closed. It counts as found
where `check` reports a warning or an error whose line and columns, beginning and end, are those of the piece that is
wrong. The pieces were marked before anything was run; 67 of these 77 were found the first time, and the others showed
what was to be fixed.

libsdformat 12, as Gazebo reads URDF and SDF, and urdfdom are asked about the same files, other than those of xacro.
They say something where they have a message that they do not have for the file without the mistake; libsdformat's
warnings and what urdfdom prints are messages too. libsdformat names the line where one of these has it.

The other half is 200 models of the corpus, drawn from those that libsdformat 12 and, for URDF, urdfdom accept. What
`check` reports about them was judged by hand."""


def measure(sample: Sample) -> Findings:
    """Plant the mistakes, and check the models."""
    planted = sample.of([_Planted(each) for each in MISTAKES])
    lost = [each.mistake for each in planted if not each.found()]
    alarms = _alarms(sample)
    counts = table(
        ["mistakes", "found at the piece", "not found", "models that others accept", "with findings"],
        [(len(planted), len(planted) - len(lost), len(lost), CLEAN, sum(bool(found) for found in alarms.values()))],
    )
    faults = [each.what for each in lost if not each.missed]
    faults += [
        f"{file}: {one.rule.name}: {one.message}" for file, found in alarms.items() for one in found if not _why(one)
    ]
    said = table(["reader", "mistakes", "says something", "names the line"], _said_by_readers(planted))
    missed = listing(["mistake", "why it is not found"], ((each.what, each.missed) for each in lost))
    judged = table(["rule", "findings", "models", "judgment"], _rows(alarms))
    sections = [
        counts,
        subsection("Mistakes that are not found", missed),
        subsection("What readers say of the same mistakes", said),
        subsection("Findings about models", judged),
    ]
    return Findings(sections, counts, faults)


class _Planted:
    """A mistake in a file of its own."""

    def __init__(self, mistake: Mistake) -> None:
        self.mistake = mistake

    @property
    def name(self) -> str:
        """What is wrong."""
        return self.mistake.what

    def found(self) -> bool:
        """Whether it is found at its piece."""
        with tempfile.TemporaryDirectory() as folder:
            path, place = self.mistake.make(Path(folder))
            return any(is_at(each, place) for each in located(check(path, passes=self.mistake.passes)))


def _said_by_readers(planted: Sequence[_Planted]) -> Iterator[tuple[object, ...]]:
    """Yield how many mistakes in URDF and SDF each reader says something of, and of how many it names the line."""
    plain = [each for each in planted if each.mistake.is_plain]
    found = sum(each.found() for each in plain)
    yield "twinform", len(plain), found, found
    for reader, suffixes, messages in (
        ("libsdformat 12", {".urdf", ".sdf"}, _messages_of_libsdformat),
        ("urdfdom", {".urdf"}, urdfdom.complaints),
    ):
        said = [_new_messages(each.mistake, suffixes, messages) for each in plain]
        asked = [each for each in said if each is not None]
        named = sum(any(_names_line(text, line) for text in new) for new, line in asked)
        yield reader, len(asked), sum(bool(new) for new, _ in asked), named


def _messages_of_libsdformat(path: Path) -> tuple[str, ...]:
    ((_, reading),) = libsdformat.judge([path]).items()
    return (*reading.errors, *reading.console.splitlines())


def _new_messages(
    mistake: Mistake, suffixes: Collection[str], messages: Callable[[Path], tuple[str, ...]]
) -> tuple[frozenset[str], int] | None:
    """Return what a reader says of a mistake alone, and its line; None where it does not read the file."""
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as clean:
        path, (_, line, *_) = mistake.make(Path(folder))
        if path.suffix not in suffixes:
            return None
        _, before = mistake.copied(Path(clean))
        known = {text.replace(clean, "") for text in messages(before)}
        return frozenset(text.replace(folder, "") for text in messages(path)) - known, line


def _names_line(message: str, line: int) -> bool:
    return re.search(rf"(:L|Line number=){line}\b", message) is not None


def _alarms(sample: Sample) -> dict[str, list[Diagnostic]]:
    drawn = random.Random(_SEED).sample([file for file in models() if _is_clean(file)], CLEAN)
    return {
        file.name: [each for each in check(file.path, paths=file.paths).diagnostics if each.severity > Severity.INFO]
        for file in sample.of(drawn)
    }


def _is_clean(file: CorpusFile) -> bool:
    others = ["libsdformat12", *(["check_urdf"] if file.kind is Kind.URDF else [])]
    return all(file.row.get(other) == "ok" for other in others)


def _why(found: Diagnostic) -> str:
    return KNOWN.why("alarm", rule=found.rule.name)


def _rows(alarms: dict[str, list[Diagnostic]]) -> Iterator[tuple[object, ...]]:
    by_rule: dict[str, list[str]] = defaultdict(list)
    for file, found in alarms.items():
        for each in found:
            by_rule[each.rule.name].append(file)
    for rule, files in sorted(by_rule.items(), key=lambda pair: (-len(pair[1]), pair[0])):
        yield rule_links([rule]), len(files), len(set(files)), KNOWN.why("alarm", rule=rule)


SECTION = Section("mistakes", _ABOUT, measure, (needs.corpus, needs.libsdformat, needs.urdfdom), KNOWN)
