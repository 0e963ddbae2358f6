"""Fixes in xacro: what a case becomes as URDF or SDF, it becomes as xacro, in the file where the text stands."""

import os
import shutil
from collections import Counter
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from lxml import etree

from testbed.fixed_xacro import as_it_is, fixed_xacro, in_a_macro, in_properties, outline, root_of
from tests.expected import assert_expected
from tests.test_fix_cases import FIXES, fixed, passes_of
from twinform.compiler import LoadOptions, LoadResult, as_refused, inspect, read
from twinform.compiler.fixing import FixResult, Texts, apply_fixes_by, with_fixes
from twinform.compiler.fixing.fix_rounds import kind_of
from twinform.diagnostics import Severity, catalog
from twinform.schemas import XmlElement

_CASES = [path for path in sorted((FIXES[0].parent / "xacro").glob("*.xacro")) if ".expected" not in path.name]
_WAYS = (as_it_is, in_a_macro, in_properties)
# What is wrong with the XML itself is refused by xacro, or gone once it has written it; nothing moves the text of an
# element into an attribute if a property has it.
_OF_THE_TEXT = {"doctype", "old-root", "split-value", "tabbed-numbers", "yaml-in-comment"}
_Way = Callable[[XmlElement], dict[str, str]]


def _root(path: Path) -> XmlElement | None:
    try:
        return root_of(path.read_bytes())
    except etree.XMLSyntaxError:
        return None


_WELL_FORMED = [path for path in FIXES if _root(path) is not None]


def _fixed_in(way: _Way, path: Path, folder: Path) -> FixResult:
    root, data = _root(path), path.read_bytes()
    assert root is not None
    shutil.copytree(path.parent / "parts", folder / "parts")
    return fixed_xacro(folder, way(root), unsafe=b"fixes: unsafe" in data, passes=passes_of(data))


@pytest.mark.parametrize("way", _WAYS, ids=lambda way: way.__name__)
@pytest.mark.parametrize("path", _WELL_FORMED, ids=lambda path: path.name)
def test_a_case_becomes_the_same_in_xacro(path: Path, way: _Way, tmp_path: Path) -> None:
    made, plain = _fixed_in(way, path, tmp_path), fixed(path)
    missing = _rules(plain) - _rules(made)
    if way is not in_properties:
        assert missing <= _OF_THE_TEXT
    assert missing or outline(made.left.content or b"") == outline(plain.data)


def _rules(fixed: FixResult) -> set[str]:
    return {each.rule.name for each in fixed.applied}


def test_most_rules_fix_in_xacro(tmp_path: Path) -> None:
    counts: Counter[str] = Counter()
    for number, path in enumerate(_WELL_FORMED):
        folder = tmp_path / str(number)
        folder.mkdir()
        counts.update(_rules(_fixed_in(in_a_macro, path, folder)))
    for path in _CASES:
        counts.update(_rules(_fixed(path)))
    assert len(counts) >= 60, sorted(counts)
    assert {name for name, rule in catalog().items() if rule.fix and rule.group == "xacro"} <= counts.keys()


def _look(path: Path, texts: Texts) -> LoadResult:
    options = LoadOptions().with_unsaved({os.path.realpath(name or path): data for name, data in texts.items()})
    return as_refused(inspect(read(path, options), options))


@cache
def _fixed(path: Path) -> FixResult:
    data = path.read_bytes()
    return apply_fixes_by(lambda texts: _look(path, texts), data, unsafe=b"fixes: unsafe" in data)


@pytest.mark.parametrize("path", _CASES, ids=lambda path: path.name)
def test_fixes_make_what_the_case_shows(path: Path) -> None:
    made = _fixed(path)
    assert_expected(made.data.decode(), path.with_suffix(".expected.xacro"))
    for name, (_, after) in made.included.items():
        assert_expected(after.decode(), Path(name).with_suffix(".expected.xacro"))


@pytest.mark.parametrize("path", _CASES, ids=lambda path: path.name)
def test_nothing_is_left_to_fix_and_nothing_new_is_found(path: Path) -> None:
    made, before = _fixed(path), _look(path, {})
    assert made.refused == ()
    assert not any(each.fix for each in with_fixes(made.left))
    if not before.unreadable:
        found = Counter(kind_of(each) for each in made.left.diagnostics if each.severity > Severity.INFO)
        assert found <= Counter(map(kind_of, before.diagnostics))
