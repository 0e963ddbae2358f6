"""Merges of 2,000 random pairs of edits: never a wrong tree, and a conflict only where both touch one value."""

import random
import re
from collections import Counter
from pathlib import Path

import pytest
from lxml import etree

from tests.merges import Side, both_touch, content, made_by, random_side
from tests.tree_changes import PARSER
from twinform.cli.merge import find_problems
from twinform.compiler.merging import FileVersions, merge_files
from twinform.text import SourceText, patch, spans

_ROOT = Path(__file__).parents[3]
_FILES = [
    path
    for folder in ("examples", "tests/cases/convert", "tests/cases/xacro", "tests/cases/elements")
    for path in sorted((_ROOT / folder).rglob("*.*"))
    if path.suffix in {".urdf", ".sdf", ".xacro"}
]
_SEEDS = 2000
_PORTION = 100
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_GAP = re.compile(r"(?<=>)(?=\s*\n\s*<)")


def _models() -> list[tuple[Path, bytes]]:
    models: list[tuple[Path, bytes]] = []
    for path in _FILES:
        data = path.read_bytes()
        try:
            etree.fromstring(data, PARSER)
            spans(SourceText.of(data).text)
        except (etree.XMLSyntaxError, ValueError):
            continue
        models.append((path, data))
    return models


def _commented(text: str, chance: random.Random, who: str) -> str:
    """The text with some comments that nobody else has."""
    inside = [found.span() for found in _COMMENT.finditer(text)]
    gaps = [found.start() for found in _GAP.finditer(text)]
    free = [gap for gap in gaps if not any(start < gap < end for start, end in inside)]
    for count, gap in enumerate(sorted(chance.sample(free, min(len(free), chance.randint(0, 2))), reverse=True)):
        text = f"{text[:gap]}{chance.choice(['  ', chr(10)])}<!-- {who} {count} -->{text[gap:]}"
    return text


def _comments(text: str) -> Counter[str]:
    return Counter(_COMMENT.findall(text))


def _assert_merged(path: Path, data: bytes, chance: random.Random) -> None:
    source, base = SourceText.of(data), etree.fromstring(data, PARSER)
    sides: list[Side] = [random_side(base, chance, who, chance.randint(1, 4)) for who in ("ours", "theirs")]
    texts = [
        _commented(patch(source, base, side.tree).text, chance, who)
        for side, who in zip(sides, ("ours", "theirs"), strict=True)
    ]
    files = FileVersions(data, *(source.with_text(text).data for text in texts))
    merged = merge_files(files, lambda text: find_problems(text, path.name))
    text = SourceText.of(merged.data).text
    assert not merged.notes
    added = sum((_comments(each) - _comments(source.text) for each in texts), Counter[str]())
    assert not added - _comments(text)
    if merged.conflicts:
        assert "<<<<<<< ours\n" in text
        # Where somebody deletes an element, a comment that another one has added in it is touched too.
        assert both_touch(*sides, orders=True) or any("is deleted" in each for each in merged.conflicts)
    else:
        assert not both_touch(*sides)
        both = made_by([edit for side in sides for edit in side.edits], base)
        assert content(etree.fromstring(merged.data, PARSER)) == content(both)


@pytest.mark.slow
@pytest.mark.parametrize("start", range(0, _SEEDS, _PORTION))
def test_random_edits_of_two_people_are_merged(start: int) -> None:
    models = _models()
    for seed in range(start, start + _PORTION):
        try:
            _assert_merged(*models[seed % len(models)], random.Random(seed))
        except Exception as error:
            raise AssertionError(f"seed {seed}") from error
