"""Completion at the places of `places.toml`: what is offered, and that the checker takes what is offered."""

import tomllib
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types

from tests.profile import DEEP
from tests.write_files import write_files
from twinform.server.checking import CheckJob, EditorSettings, check, no_settings
from twinform.server.completion import complete
from twinform.server.documents import TextDocument
from twinform.server.session import Session

TABLE: dict[str, Any] = tomllib.loads(Path(__file__).with_name("places.toml").read_text(encoding="utf-8"))
PLACES: list[dict[str, Any]] = TABLE["place"]
IDS = [f"{each['frame']}: {each['at']}" for each in PLACES]


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A workspace with the files of the table."""
    made = tmp_path_factory.mktemp("workspace")
    (made / ".git").mkdir()
    return write_files(made, TABLE["files"])


def edited(place: dict[str, Any], folder: Path) -> tuple[Session, TextDocument, int]:
    """The session with the file of a place, and the offset of the cursor."""
    frame = TABLE["frames"][place["frame"]]
    text: str = frame["text"].replace("{}", place["at"])
    session = Session(no_settings, lambda _: None)
    session.snippets, session.folders = False, [folder]
    path = folder / frame["file"]
    path.parent.mkdir(parents=True, exist_ok=True)
    document = session.documents.follow(path.as_uri(), text.replace("|", "", 1), 1, "")
    return session, document, text.index("|")


def is_offered(name: str, labels: list[str]) -> bool:
    return any(each.startswith(name[:-1]) for each in labels) if name.endswith("*") else name in labels


@pytest.mark.parametrize("place", PLACES, ids=IDS)
def test_what_is_offered(place: dict[str, Any], folder: Path) -> None:
    labels = [each.label for each in complete(*edited(place, folder)).items]
    assert [each for each in place.get("has", []) if not is_offered(each, labels)] == []
    assert [each for each in place.get("lacks", []) if is_offered(each, labels)] == []
    assert len(labels) == len(set(labels))


REFUSED = frozenset({
    "ambiguous-frame", "continuous-in-sdf", "dangling-frame", "deprecated-element", "dialect", "duplicate-name",
    "frame-cycle", "misplaced-sensor", "misspelled-interface", "outside-version", "plugin-reference",
    "repeated-control", "repeated-element", "reserved-name", "self-joint", "sensor-mismatch", "two-parents",
    "uncommandable-joint", "unknown-attribute", "unknown-element", "unknown-material", "unknown-name",
    "unknown-package", "unknown-plugin", "unknown-plugin-parameter", "unresolved-uri", "unusable-axis",
    "unused-axis", "uri-leaves-folder", "world-child", "world-link", "wrong-plugin-scope",
})  # fmt: skip
"""The rules that find what does not belong where it was written; others find what is not written yet."""
_MOST = {False: 15, True: 3}
"""The items of a place that are tried, by whether xacro has to be expanded for each."""


def refusals(document: TextDocument, text: str) -> Counter[str]:
    """What the checker refuses in a document with another text."""
    unsaved = {str(document.path.resolve()): text.encode()}
    found = check(CheckJob(document.path, unsaved, EditorSettings())).diagnostics
    return Counter(
        each.message
        for each in found
        if each.rule.name in REFUSED or (each.rule.name == "xacro-error" and "not defined" in each.message)
    )


def with_item(document: TextDocument, item: types.CompletionItem) -> str:
    assert isinstance(item.text_edit, types.TextEdit)
    span = document.positions.span(item.text_edit.range)
    return document.text[: span.start] + item.text_edit.new_text + document.text[span.end :]


@pytest.mark.slow
@pytest.mark.parametrize("place", PLACES, ids=IDS)
def test_nothing_is_offered_that_the_checker_refuses(place: dict[str, Any], folder: Path) -> None:
    session, document, offset = edited(place, folder)
    items = complete(session, document, offset).items
    begun = document.text[offset - 1 : offset] == "<"
    before = refusals(document, document.text[: offset - begun] + document.text[offset:])
    step = 1 if DEEP else max(1, len(items) // _MOST[document.is_xacro])
    for item in items[::step]:
        assert refusals(document, with_item(document, item)) - before == Counter(), item.label
