"""What somebody is told while typing: each state of a file has a message in our words, at a place of the file."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from testbed.corpus.files import ROOT
from tests.profile import DEEP
from twinform.diagnostics import Diagnostic
from twinform.server.checking import CheckJob, EditorSettings, check
from twinform.server.diagnostics import span_of
from twinform.server.documents import TextDocument

pytestmark = pytest.mark.slow

_LINES = 60
_STEPS = {".urdf": 13, ".sdf": 13, ".xacro": 67}
"""Every which state is looked at: xacro is expanded in a process of its own."""
FILES = {
    "arm.urdf": ROOT / "examples" / "gripper.urdf",
    "crate.sdf": ROOT / "examples" / "crate" / "model.sdf",
    "wheels.urdf.xacro": ROOT / "examples" / "four_wheels.urdf.xacro",
}
SYNTAX = frozenset({"not-well-formed", "repaired-xml", "xacro-error", "unreadable-file"})
_PARTS = re.compile(r"the '<' of line \d|<[\w:./?-]+|(the|a) (comment|CDATA section|file|declaration)\b")
"""What a message has to name: a tag, or what else there is outside of tags."""
_OF_PARSERS = re.compile(
    r"xml[A-Z]|\bPI\b|, column|expected '|String not|[Mm]alformed|mismatch|Opening|Premature|[Ee]xtra content"
    r"|EntityRef|PCDATA|expecting|internal error|StartTag|junk after|no element found|unclosed token|invalid token"
)


def typed_at_the_end(text: str) -> Iterator[str]:
    """Yield what is there when a file was typed so far."""
    yield from (text[:end] for end in range(1, len(text)))


def typed_inside(text: str) -> Iterator[str]:
    """Yield what is there when each line of a whole file is typed anew."""
    lines = text.splitlines(keepends=True)
    for number, line in enumerate(lines):
        before, behind = "".join(lines[:number]), "".join(lines[number + 1 :])
        yield from (f"{before}{line[:end]}\n{behind}" for end in range(1, len(line) - 1))


def findings(name: str, text: str) -> tuple[TextDocument, list[Diagnostic]]:
    path = Path("/nowhere") / name
    found = check(CheckJob(path, {str(path): text.encode()}, EditorSettings())).diagnostics
    return TextDocument(path.as_uri(), text), [each for each in found if each.rule.name in SYNTAX]


@pytest.mark.parametrize("states", [typed_at_the_end, typed_inside])
@pytest.mark.parametrize("name", FILES)
def test_every_state_has_a_message_that_helps(name: str, states: Callable[[str], Iterator[str]]) -> None:
    path = FILES[name]
    text = "".join(path.read_text(encoding="utf-8").splitlines(keepends=True)[:_LINES])
    useless: dict[str, str] = {}
    for state in list(states(text))[:: 1 if DEEP else _STEPS[path.suffix]]:
        document, found = findings(name, state)
        for each in found:
            span = span_of(each.location, document)
            is_helpful = _PARTS.search(each.message) and not _OF_PARSERS.search(each.message)
            is_in_file = 0 < each.location.line <= len(document.positions.starts) and span.end <= len(state)
            if not is_helpful or not is_in_file:
                useless.setdefault(each.message, state[-60:])
    assert useless == {}
