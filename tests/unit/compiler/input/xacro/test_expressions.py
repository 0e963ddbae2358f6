"""Expressions have the values that Python gives them, or none: what is offered, and what is refused."""

import math
import warnings
from collections.abc import Callable
from copy import deepcopy
from importlib import import_module
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.hostile.xacro_escapes import ESCAPES
from tests.profile import examples
from twinform.compiler.input.xacro.budget import Budget, ExcessError
from twinform.compiler.input.xacro.expression_values import (
    DotDict,
    DotList,
    ExpressionRefusedError,
    weigh,
)
from twinform.compiler.input.xacro.interpreter import Interpreter, parse
from twinform.compiler.input.xacro.vocabulary import math_functions, python_functions

_VALUES: dict[str, Any] = {"i": 3, "x": 0.25, "s": "a b", "b": True, "l": [1, 2.5, "c"], "d": {"k": 1, "n": 0}}
_EVALUATE: Callable[..., Any] = vars(import_module("builtins"))["eval"]


def evaluate(expression: str, budget: Budget | None = None, /, **names: Any) -> Any:
    budget = budget or Budget()
    return Interpreter(budget).evaluate(expression, {**python_functions(budget), **math_functions(budget), **names})


def _by_python(expression: str) -> Any:
    with warnings.catch_warnings(action="ignore"):
        return _EVALUATE(expression, {**vars(math), **deepcopy(_VALUES)})


def _is_same(ours: Any, theirs: Any) -> bool:
    return type(ours) is type(theirs) and repr(ours) == repr(theirs)


_LITERALS = st.one_of(
    st.integers(-9, 99).map(str),
    st.floats(0, 1e3, allow_nan=False).map(repr),
    st.sampled_from(["True", "False", "None", "'a'", "'b c'", "[]", "()", "pi"]),
    st.sampled_from(sorted(_VALUES)),
)
_BINARY = [
    "+",
    "-",
    "*",
    "/",
    "//",
    "%",
    "**",
    "==",
    "!=",
    "<",
    "<=",
    ">",
    ">=",
    "in",
    "not in",
    "and",
    "or",
    "is None or",
]
_FORMS = [
    "({0} if {1} else {2})", "[{0}, {1}]", "({0}, {1})", "{{{0}, {1}}}", "{{{0}: {1}}}", "{0}[{1}]", "{0}[{1}:{2}]",
    "[{0} for y in {1}]", "[y for y in {0} if {1}]", "[(y, z) for y in {0} for z in {1}]", "{{y: {0} for y in {1}}}",
    "{{y for y in {0}}}", "list({0} for y in {1})", "[y for y, z in {0}]",
    "len({0})", "str({0})", "int({0})", "float({0})", "bool({0})", "list({0})", "tuple({0})", "set({0})", "dict({0})",
    "dict(k={0}, n={1})", "max({0}, {1})", "min({0})", "round({0}, {1})", "abs({0})", "sum({0})", "sorted({0})",
    "any({0})", "all({0})", "divmod({0}, {1})", "ord({0})", "list(range({0}, {1}))", "list(zip({0}, {1}))",
    "list(map(str, {0}))", "list(enumerate({0}))", "list(reversed({0}))", "isinstance({0}, (int, str))",
    "sorted({0}, key=str, reverse={1})", "sin({0})", "pow({0}, {1})", "floor({0})", "hypot({0}, {1})",
    "{0}.split({1})", "{0}.strip()", "{0}.lower()", "{0}.upper()", "{0}.title()", "{0}.replace({1}, {2})",
    "{0}.startswith({1})", "{0}.endswith({1})", "{0}.join({1})", "{0}.count({1})", "{0}.find({1})", "{0}.zfill({1})",
    "{0}.append({1})", "{0}.pop()", "{0}.index({1})", "{0}.extend({1})", "{0}.get({1}, {2})", "{0}.pop({1})",
    "list({0}.keys())", "list({0}.items())", "list({0}.values())", "'{{}} {{}}'.format({0}, {1})",
    "'{{1}} {{0}}'.format({0}, {1})", "'{{}} {{1}}'.format({0}, {1})",
]  # fmt: skip


def _larger(parts: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    binary = st.builds("({} {} {})".format, parts, st.sampled_from(_BINARY), parts)
    unary = st.builds("({}{})".format, st.sampled_from(["-", "+", "not "]), parts)
    forms = st.builds(str.format, st.sampled_from(_FORMS), parts, parts, parts)
    return binary | unary | forms


expressions = st.recursive(_LITERALS, _larger, max_leaves=8)


@given(expressions)
@examples(4)
def test_an_expression_has_the_value_that_python_gives_it_or_none(expression: str) -> None:
    try:
        ours = evaluate(expression, pi=math.pi, **deepcopy(_VALUES))
    except (ExpressionRefusedError, ExcessError):
        return
    except Exception:  # noqa: BLE001 - as below
        with pytest.raises(Exception):  # noqa: B017, PT011 - which one it is, Python decides
            _by_python(expression)
        return
    assert _is_same(ours, _by_python(expression))


@given(st.text("()[]{}'\"\\.,:=+-*/%<>! \n_axy01jfé", max_size=40))
@examples(4)
def test_whatever_is_written_leads_to_nothing_else(expression: str) -> None:
    try:
        value = evaluate(expression, a=1, x=[1], y={"a": 1})
    except Exception:  # noqa: BLE001 - it is hardly ever an expression
        return
    weigh(value, Budget())


KNOWN = [
    "1 < 2 < 3", "1 < 3 < 2", "0 or '' or 5", "1 and 0 and 2", "not []", "7 // 2", "-7 % 3", "2 ** -1", "2 ** 0.5",
    "[1, 2, 3][-1]", "'abc'[::-1]", "[1, 2, 3][1:]", "dict(a=1, b=2)['b']", "None is None", "True is not None",
    "[a * b for a in [1, 2] for b in [3, 4] if a < b]", "[a for a, b in [(1, 2), (3, 4)]]", "sorted([3, 1, 2])",
    "max([1, 5, 2])", "max(1, 5, 2)", "min([], default=3)", "sum([0.5, 1])", "sum([[1], [2]], [])", "round(2.567, 2)",
    "round(2.5)", "int('12')", "int('ff', 16)", "float('1e3')", "str([1, 'a'])", "str(dict(a=(1,)))", "len('abc')",
    "list(range(5, 0, -2))", "list(map(int, '1 2'.split()))", "list(zip([1, 2], 'ab'))", "list(enumerate('ab', 1))",
    "isinstance(1, int)", "isinstance(True, (str, int))", "isinstance('a', float)", "'a-b'.split('-')",
    "'a b'.split(maxsplit=1)", "'x'.join(['a', 'b'])", "'{} {}'.format(1, 'a')", "'{a} {b}'.format(a=1, b=2)",
    "'{{{0}}}'.format(7)", "'7'.zfill(3)", "' a '.strip()", "'xax'.strip('x')", "'aXb'.replace('X', '-')", "ord('a')",
    "list(reversed([1, 2]))", "divmod(7, 2)", "abs(-2)", "any([0, 1])", "all([0, 1])", "bool('')", "tuple('ab')",
    "dict([('a', 1)])", "dict(dict(a=1), b=2)", "list(dict(a=1).items())", "dict(a=1).get('b', 2)", "[1, 2].count(1)",
    "'ab' in 'cab'", "2 not in [1]", "'a' * 3", "[0] * 2", "(1,) + (2,)", "-(-3)", "+True", "1_000", "0x1f", "'\\x41'",
    "sin(0.5)", "atan2(1, 2)", "pow(2, 3)", "radians(180)", "fsum([0.1] * 3)", "hypot(3, 4)", "floor(2.7)", "isnan(1)",
]  # fmt: skip


@pytest.mark.parametrize("expression", KNOWN)
def test_what_robots_use_has_the_value_of_python(expression: str) -> None:
    assert _is_same(evaluate(expression), _by_python(expression))


@pytest.mark.parametrize("value", [DotDict(a={"b": [{"c": 1}]}), DotDict(a=DotDict(b=DotList([{"c": 1}])))])
def test_data_has_dots_at_any_depth(value: DotDict) -> None:
    assert evaluate("d.a.b[0].c + d['a']['b'][0]['c']", d=value) == 2
    assert evaluate("[each.c for each in d.a.b]", d=value) == [1]
    with pytest.raises(AttributeError, match="The yaml dictionary has no key 'z'"):
        evaluate("d.a.z", d=value)


def test_names_of_a_comprehension_stay_in_it() -> None:
    assert evaluate("[y for y in [1]] + [y]", y=2) == [1, 2]
    with pytest.raises(NameError, match="name 'y' is not defined"):
        evaluate("[y for y in [1]] + [y]")


def test_iterators_are_used_up_as_in_python() -> None:
    assert evaluate("[list(m), list(m)]", m=iter([1, 2])) == [[1, 2], []]
    with pytest.raises(TypeError, match="has no len"):
        evaluate("len(map(str, [1]))")


def test_all_expressions_of_a_file_share_one_budget() -> None:
    budget = Budget(steps=1000)
    evaluate("[i + i for i in range(40)]", budget)
    with pytest.raises(ExcessError, match="steps"):
        evaluate("[i + i for i in range(200)]", budget)


@pytest.mark.parametrize("value", [object(), print, math, int, Budget(), memoryview(b""), iter(())])
def test_no_other_value_can_be_used_for_anything(value: Any) -> None:
    for expression in ("v", "v.real", "v()", "v[0]", "str(v)", "[v]", "v == v", "v + 1", "list(v)", "len(v)"):
        with pytest.raises((ExpressionRefusedError, TypeError)):
            evaluate(expression, v=value)


@pytest.mark.parametrize("name", [name for name in ESCAPES if name.startswith(("classes", "functions"))])
def test_escapes_by_syntax_or_name_fail_whatever_the_names_mean(name: str) -> None:
    expression = ESCAPES[name][0].rpartition("${")[2].partition("}")[0]
    with pytest.raises((ExpressionRefusedError, NameError, TypeError)):
        evaluate(expression, d=DotDict(a=1), xacro=DotDict(load_yaml=1), python=DotDict())


def test_a_tree_is_looked_at_once() -> None:
    assert parse("a + 1") is parse("a + 1")


@pytest.mark.parametrize(
    "expression", ["'{text} {budget} {value}'.format(text=1, budget=2, value=3)", "dict(values=1, budget=2)"]
)
def test_a_named_argument_may_have_any_name(expression: str) -> None:
    assert _is_same(evaluate(expression), _by_python(expression))
