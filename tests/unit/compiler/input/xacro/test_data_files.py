"""Data files of xacro: plain data, units, and aliases that do not multiply without measure."""

from datetime import date
from typing import Any

import pytest
import yaml

from twinform.compiler.input.xacro import data_files
from twinform.compiler.input.xacro.budget import ExcessError
from twinform.compiler.input.xacro.data_files import DataFiles
from twinform.compiler.input.xacro.expression_values import DotDict, DotList


def _load(text: str) -> Any:
    return DataFiles({"!degrees": 0.5, "!mm": 0.001}, lambda expression: f"{len(expression)}").load(text.encode(), "f")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a: 1\nb: [x, 0.5, true, null]", {"a": 1, "b": ["x", 0.5, True, None]}),
        ("a: !degrees 90\nb: !mm pi/2", {"a": 1.0, "b": 0.004}),
        ("a: &a {k: 1}\nb: {<<: *a, n: 2}\nc: *a", {"a": {"k": 1}, "b": {"k": 1, "n": 2}, "c": {"k": 1}}),
        ("2026-01-02", date(2026, 1, 2)),
        ("", None),
        ("- 1\n- [2]", [1, [2]]),
    ],
)
def test_a_file_is_plain_data(text: str, value: object) -> None:
    assert _load(text) == value


def test_what_is_read_has_dots() -> None:
    found = _load("a: [{b: 1}]")
    assert (type(found), type(found["a"]), type(found["a"][0])) == (DotDict, DotList, DotDict)


@pytest.mark.parametrize(
    "text",
    [
        "!!python/object/apply:os.system [id]",
        "!!python/name:os.system",
        "!!python/module:os",
        "!radians 1",
        "a: *b",
        "[",
        "a: !degrees [1]",
        "- a\n- b\n---\n- c",
    ],
)
def test_what_is_no_plain_data_is_a_mistake(text: str) -> None:
    with pytest.raises(yaml.YAMLError):
        _load(text)


@pytest.mark.parametrize("text", ["a: &a [*a]", "&a {k: {n: *a}}", "&a [[[*a]]]"])
def test_nothing_is_inside_of_itself(text: str) -> None:
    with pytest.raises(ExcessError, match="alias inside of what it stands for"):
        _load(text)


def _doubling(levels: int, form: str) -> str:
    lines = [f"a{n}: &a{n} {form.format(f'*a{n - 1}')}" for n in range(1, levels + 1)]
    return "\n".join(["a0: &a0 {k: 1}", *lines])


@pytest.mark.parametrize("form", ["[{0}, {0}]", "{{x: {0}, y: {0}}}", "{{<<: [{0}, {0}]}}"])
def test_aliases_count_as_often_as_they_stand_there(form: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(data_files, "LONGEST_TEXT", 2000)
    _load(_doubling(6, form))
    with pytest.raises(ExcessError, match="values"):
        _load(_doubling(12, form))


def test_a_file_that_is_too_large_is_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(data_files, "LARGEST", 9)
    with pytest.raises(ExcessError, match="has 10 bytes; the limit is 9"):
        _load("0123456789")


def test_units_of_one_file_are_not_those_of_yaml() -> None:
    _load("a: !mm 1")
    with pytest.raises(yaml.YAMLError):
        yaml.safe_load("a: !mm 1")
