"""Allowed syntax of expressions: a list that the whole syntax tree is checked against before it runs."""

import ast
from collections.abc import Mapping
from functools import lru_cache

from twinform.compiler.input.xacro.worker.expressions.budget import ExcessError
from twinform.compiler.input.xacro.worker.expressions.expression_values import SCALARS, ExpressionRefusedError

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
