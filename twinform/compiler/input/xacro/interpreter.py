"""Evaluation of expressions: a walk through the syntax tree, which knows no more of Python than what stands here.

The whole tree is checked against a list of what is allowed before any of it is evaluated.
"""

import ast
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from typing import Any

from twinform.compiler.input.xacro.budget import Budget, ExcessError
from twinform.compiler.input.xacro.expression_values import (
    SCALARS,
    TYPES,
    ExpressionRefusedError,
    Function,
    NameLookup,
    Value,
    each,
    hashable,
    weigh,
)
from twinform.compiler.input.xacro.operations import binary, callable_member, compare, member, unary

LONGEST = 10_000
"""In characters. The longest real expression that we know has 300."""
_KEPT = 4096

_ALLOWED: frozenset[type[ast.AST]] = frozenset({
    ast.Expression, ast.Constant, ast.Name, ast.Load, ast.Store,
    ast.BinOp, ast.Add, ast.Sub, ast.Mult, ast.Div, ast.FloorDiv, ast.Mod, ast.Pow,
    ast.UnaryOp, ast.UAdd, ast.USub, ast.Not,
    ast.BoolOp, ast.And, ast.Or, ast.IfExp,
    ast.Compare, ast.Eq, ast.NotEq, ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.In, ast.NotIn, ast.Is, ast.IsNot,
    ast.Subscript, ast.Slice, ast.Attribute, ast.Call, ast.keyword,
    ast.List, ast.Tuple, ast.Set, ast.Dict,
    ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp, ast.comprehension,
})  # fmt: skip
_CALLED: Mapping[type[ast.AST], str] = {
    ast.Lambda: "a lambda",
    ast.NamedExpr: "an assignment",
    ast.Starred: "'*'",
    ast.JoinedStr: "an f-string",
    ast.MatMult: "'@'",
    ast.BitAnd: "'&'",
    ast.BitOr: "'|'",
    ast.BitXor: "'^'",
    ast.Invert: "'~'",
    ast.LShift: "'<<'",
    ast.RShift: "'>>'",
}


@lru_cache(_KEPT)
def parse(expression: str) -> ast.expr:
    """The syntax tree of an expression.

    Raises:
        RefusedError: something in it is not allowed.
        ExcessError: it is too long.
        SyntaxError: it is none.
    """
    if len(expression) > LONGEST:
        raise ExcessError(f"an expression has {len(expression):,} characters; the limit is {LONGEST:,}")
    try:
        tree = ast.parse(expression.strip(), "<expression>", "eval")
    except (MemoryError, RecursionError) as error:  # so Python's parser reports that its stack is full
        raise ExcessError("an expression is nested too deeply") from error
    for node in ast.walk(tree):
        _require_allowed(node)
    return tree.body


def _require_allowed(node: ast.AST) -> None:
    if type(node) not in _ALLOWED:
        name = type(node).__name__
        raise ExpressionRefusedError(f"an expression must not use {_CALLED.get(type(node), name)}")
    match node:
        case ast.Constant() if type(node.value) not in SCALARS:
            raise ExpressionRefusedError(f"an expression must not use {node.value!r}")
        case ast.Name(id=name) | ast.Attribute(attr=name) if name.startswith("__"):
            raise ExpressionRefusedError(f"an expression must not use {name!r}")
        case ast.keyword(arg=None):
            raise ExpressionRefusedError("an expression must not use '**'")
        case ast.Dict(keys=keys) if None in keys:
            raise ExpressionRefusedError("an expression must not use '**'")
        case ast.comprehension(is_async=1):
            raise ExpressionRefusedError("an expression must not use 'async'")
        case _:
            return


class Interpreter:
    """Evaluates expressions within a budget; `scope` is the type of names that included files are reached by."""

    def __init__(self, budget: Budget, scope: type | None = None) -> None:
        self.budget = budget
        self.scope = scope

    def evaluate(self, expression: str, names: NameLookup) -> Value:
        """The value of an expression.

        Raises:
            RefusedError: it wants what is not offered.
            ExcessError: it wants too much.
            Exception: what Python raises where an expression is wrong.
        """
        value = self.value(parse(expression), names)
        if type(value) not in SCALARS:
            weigh(value, self.budget)
        return value

    def value(self, node: ast.expr, names: NameLookup) -> Value:
        """The value of a part of an expression."""
        self.budget.spend()
        return _EVALUATE[type(node)](self, node, names)


def _constant(_: Interpreter, node: ast.Constant, __: NameLookup) -> Value:
    return node.value


def _name(_: Interpreter, node: ast.Name, names: NameLookup) -> Value:
    try:
        return names[node.id]
    except KeyError as error:
        raise NameError(f"name {node.id!r} is not defined", name=node.id) from error


def _binary(interpreter: Interpreter, node: ast.BinOp, names: NameLookup) -> Value:
    left, right = interpreter.value(node.left, names), interpreter.value(node.right, names)
    try:
        return binary(node.op, left, right, interpreter.budget)
    except TypeError as error:
        raise TypeError(_text_operand((node.left, left), (node.right, right)) or str(error)) from error


def _text_operand(*operands: tuple[ast.expr, Value]) -> str:
    """Say which operand is a text; empty where none is."""
    for part, value in operands:
        if isinstance(value, str):
            name = f"{part.id} is the text {value!r}" if isinstance(part, ast.Name) else f"{value!r} is a text"
            return f"{name}, not a number"
    return ""


def _unary(interpreter: Interpreter, node: ast.UnaryOp, names: NameLookup) -> Value:
    return unary(node.op, interpreter.value(node.operand, names))


def _boolean(interpreter: Interpreter, node: ast.BoolOp, names: NameLookup) -> Value:
    """The first value that decides, or the last one."""
    deciding = isinstance(node.op, ast.Or)
    value: Value = None
    for part in node.values:
        value = interpreter.value(part, names)
        if bool(value) is deciding:
            break
    return value


def _comparison(interpreter: Interpreter, node: ast.Compare, names: NameLookup) -> bool:
    left = interpreter.value(node.left, names)
    for operation, part in zip(node.ops, node.comparators, strict=True):
        right = interpreter.value(part, names)
        if not compare(operation, left, right, interpreter.budget):
            return False
        left = right
    return True


def _conditional(interpreter: Interpreter, node: ast.IfExp, names: NameLookup) -> Value:
    return interpreter.value(node.body if interpreter.value(node.test, names) else node.orelse, names)


def _subscript(interpreter: Interpreter, node: ast.Subscript, names: NameLookup) -> Value:
    value = interpreter.value(node.value, names)
    if type(value) not in TYPES:
        weigh(value, interpreter.budget)
    found = value[_index(interpreter, node.slice, names)]
    interpreter.budget.pay(found)
    return found


def _index(interpreter: Interpreter, node: ast.expr, names: NameLookup) -> Value:
    if not isinstance(node, ast.Slice):
        return hashable(interpreter.value(node, names), interpreter.budget)
    return slice(*(part and interpreter.value(part, names) for part in (node.lower, node.upper, node.step)))


def _attribute(interpreter: Interpreter, node: ast.Attribute, names: NameLookup) -> Value:
    found = member(interpreter.value(node.value, names), node.attr, interpreter.scope)
    interpreter.budget.pay(found)
    return found


def _call(interpreter: Interpreter, node: ast.Call, names: NameLookup) -> Value:
    call = _callee(interpreter, node.func, names)
    args = [interpreter.value(part, names) for part in node.args]
    named = {part.arg: interpreter.value(part.value, names) for part in node.keywords if part.arg}
    return call(*args, **named)


def _callee(interpreter: Interpreter, node: ast.expr, names: NameLookup) -> Callable[..., Value]:
    if isinstance(node, ast.Attribute):
        value = interpreter.value(node.value, names)
        return callable_member(value, node.attr, interpreter.scope, interpreter.budget)
    value = interpreter.value(node, names)
    if type(value) is not Function:
        raise TypeError(f"{type(value).__name__!r} object is not callable")
    return value.call


class _Scope:
    """The names of a comprehension, and those around it."""

    def __init__(self, around: NameLookup) -> None:
        self.around = around
        self.own: dict[str, Value] = {}

    def __getitem__(self, name: str) -> Value:
        return self.own[name] if name in self.own else self.around[name]


def _list_display(interpreter: Interpreter, node: ast.List, names: NameLookup) -> list[Value]:
    """`[a, b]`."""
    return [interpreter.value(part, names) for part in node.elts]


def _tuple_display(interpreter: Interpreter, node: ast.Tuple, names: NameLookup) -> tuple[Value, ...]:
    """`(a, b)`."""
    return tuple(interpreter.value(part, names) for part in node.elts)


def _set_display(interpreter: Interpreter, node: ast.Set, names: NameLookup) -> set[Value]:
    """`{a, b}`."""
    return {_key(interpreter, part, names) for part in node.elts}


def _dict_display(interpreter: Interpreter, node: ast.Dict, names: NameLookup) -> dict[Value, Value]:
    """`{a: b}`."""
    pairs = [(key, value) for key, value in zip(node.keys, node.values, strict=True) if key]
    return {_key(interpreter, key, names): interpreter.value(value, names) for key, value in pairs}


def _list_comprehension(interpreter: Interpreter, node: ast.ListComp, names: NameLookup) -> list[Value]:
    """`[a for b in c]`."""
    return [interpreter.value(node.elt, scope) for scope in _scopes(interpreter, node.generators, names)]


def _generator(interpreter: Interpreter, node: ast.GeneratorExp, names: NameLookup) -> Iterator[Value]:
    """`(a for b in c)`, all of it at once: an iterator without a frame behind it."""
    # A real generator has a frame (`gi_frame`), and with it the globals of this module: the way out
    # of simpleeval.
    return iter([interpreter.value(node.elt, scope) for scope in _scopes(interpreter, node.generators, names)])


def _set_comprehension(interpreter: Interpreter, node: ast.SetComp, names: NameLookup) -> set[Value]:
    """`{a for b in c}`."""
    return {_key(interpreter, node.elt, scope) for scope in _scopes(interpreter, node.generators, names)}


def _dict_comprehension(interpreter: Interpreter, node: ast.DictComp, names: NameLookup) -> dict[Value, Value]:
    """`{a: b for c in d}`."""
    scopes = _scopes(interpreter, node.generators, names)
    return {_key(interpreter, node.key, scope): interpreter.value(node.value, scope) for scope in scopes}


def _key(interpreter: Interpreter, node: ast.expr, names: NameLookup) -> Value:
    return hashable(interpreter.value(node, names), interpreter.budget)


def _scopes(interpreter: Interpreter, generators: list[ast.comprehension], names: NameLookup) -> Iterator[NameLookup]:
    """The names as they are each time that the inside of a comprehension is evaluated."""
    if not generators:
        yield names
        return
    first, *rest = generators
    scope = _Scope(names)
    for item in each(interpreter.value(first.iter, names), interpreter.budget):
        _assign(first.target, item, scope, interpreter.budget)
        if all(interpreter.value(condition, scope) for condition in first.ifs):
            yield from _scopes(interpreter, rest, scope)


def _assign(target: ast.expr, value: Value, scope: _Scope, budget: Budget) -> None:
    match target:
        case ast.Name(id=name):
            scope.own[name] = value
        case ast.Tuple(elts=parts) | ast.List(elts=parts):
            for part, item in zip(parts, list(each(value, budget)), strict=True):
                _assign(part, item, scope, budget)
        case _:
            raise ExpressionRefusedError("a comprehension must assign to names")


# A whitelist of node types, then of exact types of values, names and methods: no value of an
# expression is a module, a class, a frame or a function of Python. Libraries were measured. As it
# comes, simpleeval 1.0.8 lets 23 of 109 attacks through, 8 of which take all memory, time or stack
# (`'1'.zfill(10**9)`). With each of its handlers that meets a value replaced, all attacks fail: that
# leaves the walk through operators and conditions to it, 21 lines of code, for 20 ms more to start a
# process of 45 ms and 1,000 lines of others inside of it. asteval 1.0.10 allows
# `open('/etc/passwd').read()`; RestrictedPython 9.0 calls itself "not a sandbox system" and bounds
# neither steps nor sizes.
_EVALUATE: Mapping[type[ast.expr], Callable[[Interpreter, Any, NameLookup], Value]] = {
    ast.Constant: _constant,
    ast.Name: _name,
    ast.BinOp: _binary,
    ast.UnaryOp: _unary,
    ast.BoolOp: _boolean,
    ast.Compare: _comparison,
    ast.IfExp: _conditional,
    ast.Subscript: _subscript,
    ast.Attribute: _attribute,
    ast.Call: _call,
    ast.List: _list_display,
    ast.Tuple: _tuple_display,
    ast.Set: _set_display,
    ast.Dict: _dict_display,
    ast.ListComp: _list_comprehension,
    ast.SetComp: _set_comprehension,
    ast.DictComp: _dict_comprehension,
    ast.GeneratorExp: _generator,
}
