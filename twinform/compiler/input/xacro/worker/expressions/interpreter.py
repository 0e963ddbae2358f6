"""Evaluation of expressions: a walk through the syntax tree, which knows no more of Python than what stands here."""

import ast
from collections.abc import Callable, Mapping
from typing import Any

from twinform.compiler.input.xacro.worker.expressions import displays
from twinform.compiler.input.xacro.worker.expressions.budget import Budget
from twinform.compiler.input.xacro.worker.expressions.expression_values import (
    SCALARS,
    TYPES,
    Function,
    NameLookup,
    Value,
    weigh,
)
from twinform.compiler.input.xacro.worker.expressions.iterating import hashable
from twinform.compiler.input.xacro.worker.expressions.members import callable_member, member
from twinform.compiler.input.xacro.worker.expressions.operations import binary, compare, unary
from twinform.compiler.input.xacro.worker.expressions.syntax import parse


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
        raise NameError(f"name {node.id!r} is not defined") from error


def _binary(interpreter: Interpreter, node: ast.BinOp, names: NameLookup) -> Value:
    left, right = interpreter.value(node.left, names), interpreter.value(node.right, names)
    return binary(node.op, left, right, interpreter.budget)


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


# A whitelist of node types, then of exact types of values, names and methods: no value of an
# expression is a module, a class, a frame or a function of Python. Libraries were tried: simpleeval
# 1.0.8 looks attributes up with `getattr`, has no budget of steps and checks sizes by operator
# (`'x'.ljust(10**9)` fills the memory); asteval 1.0.10 allows `open('/etc/passwd').read()`;
# RestrictedPython 9.0 calls itself "not a sandbox system" and bounds neither steps nor sizes. The
# tree walk that they would save is 150 lines; bounding what methods, functions and operators make
# is 500.
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
    ast.List: displays.list_display,
    ast.Tuple: displays.tuple_display,
    ast.Set: displays.set_display,
    ast.Dict: displays.dict_display,
    ast.ListComp: displays.list_comprehension,
    ast.SetComp: displays.set_comprehension,
    ast.DictComp: displays.dict_comprehension,
    ast.GeneratorExp: displays.generator,
}
