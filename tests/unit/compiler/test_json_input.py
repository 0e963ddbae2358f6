"""Documents as JSON: what does not fit is said with its path."""

import pytest

import twinform
from twinform.diagnostics import Location


@pytest.mark.parametrize(
    ("text", "path", "words"),
    [
        ('{"format": "urdf", "version": "1.0", "models": [{"name": 1}]}', "models/0/name", "models/0/name: "),
        ("{", "", "the document: "),
    ],
)
def test_what_does_not_fit_is_said_with_its_path(text: str, path: str, words: str) -> None:
    found = twinform.check(text.encode(), name="robot.json").diagnostics
    assert [(each.rule.name, each.location) for each in found] == [("invalid-value", Location("robot.json", 0, path))]
    assert found[0].message.startswith(words)
