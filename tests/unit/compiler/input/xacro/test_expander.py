"""Texts are taken apart as xacro's own lexer takes them apart."""

from importlib import import_module
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.profile import examples
from twinform.compiler.input.xacro.budget import Budget, ExcessError
from twinform.compiler.input.xacro.expander import TextEvaluator
from twinform.compiler.input.xacro.interpreter import Interpreter

_XACRO: Any = import_module("xacro")


def _texts(budget: Budget) -> TextEvaluator:
    return TextEvaluator(Interpreter(budget).evaluate, _substitute, _XACRO.XacroException, budget)


def _substitute(text: str) -> str:
    return f"<{text[2:-1]}>"


@given(st.text("${}()a1+' \n", max_size=12))
@examples(4)
def test_a_text_has_the_value_that_xacro_gives_it(text: str) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(_XACRO, "eval_extension", _substitute)
        try:
            theirs = _XACRO.eval_text(text, {"a": 1})
        except Exception:  # noqa: BLE001 - an expression may raise anything
            with pytest.raises(Exception):  # noqa: B017, PT011 - and so it does
                _texts(Budget()).value(text, {"a": 1})
            return
    ours = _texts(Budget()).value(text, {"a": 1})
    assert (type(ours), ours) == (type(theirs), theirs)


@pytest.mark.parametrize("text", ["${", "$(a", "$$", "a${1", "a $$"])
def test_what_is_not_closed_is_a_mistake(text: str) -> None:
    with pytest.raises(_XACRO.XacroException, match="invalid expression: "):
        _texts(Budget()).value(text, {})


def test_a_mistake_names_the_expression() -> None:
    with pytest.raises(_XACRO.XacroException, match=r"(?s)name 'b' is not defined.*when evaluating expression 'b'"):
        _texts(Budget()).value("a ${b} c", {})


def test_what_is_written_is_counted() -> None:
    budget = Budget(output=100)
    with pytest.raises(ExcessError, match="the file expands to more than"):
        _texts(budget).value("${'a' * 20} ${'b' * 50}", {})
