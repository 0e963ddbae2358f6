"""How many small faults the tests notice: `python -m benchmarks.mutation MODULE TESTS... [--sample N]`.

A sample of all places where an operator, comparison, constant or condition can be another one is changed, one at a
time, in a copy of the repository; the tests that are named run on each until one fails.
"""

import argparse
import ast
import copy
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from random import Random

from tests.corpus.files import ROOT

_SWAPS: dict[type[ast.AST], type[ast.AST]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
    ast.And: ast.Or,
    ast.Or: ast.And,
    ast.USub: ast.UAdd,
}
_SECONDS = 300


def main() -> int:
    """Print every survivor and the score."""
    parser = argparse.ArgumentParser()
    parser.add_argument("module", type=Path)
    parser.add_argument("tests", nargs="+")
    parser.add_argument("--sample", type=int, default=30)
    asked = parser.parse_args()
    source = (ROOT / asked.module).read_text(encoding="utf-8")
    mutants = list(_mutants(ast.parse(source)))
    chosen = Random(6).sample(mutants, min(asked.sample, len(mutants)))
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "repository"
        skipped = shutil.ignore_patterns(".venv", ".git", "out", ".hypothesis", "__pycache__", ".coverage*")
        shutil.copytree(ROOT, place, ignore=skipped)
        survivors = [what for what, text in chosen if not _noticed(place, asked.module, text, asked.tests)]
    print(*survivors, sep="\n")
    print(f"{asked.module}: {len(chosen) - len(survivors)} of {len(chosen)} noticed, {len(mutants)} in all")
    return 0


def _mutants(tree: ast.Module) -> Iterator[tuple[str, str]]:
    for number, node in enumerate(ast.walk(tree)):
        changed = copy.deepcopy(tree)
        twin = next(each for place, each in enumerate(ast.walk(changed)) if place == number)
        line = getattr(node, "lineno", 0)
        if _mutate(twin):
            yield f"line {line}: {type(node).__name__}: {ast.unparse(node)[:80]}", ast.unparse(changed)


def _mutate(node: ast.AST) -> bool:
    """Change a node; gives whether there is anything to change."""
    match node:
        case ast.BinOp() | ast.BoolOp() | ast.UnaryOp() if type(node.op) in _SWAPS:
            node.op = _SWAPS[type(node.op)]()  # pyright: ignore[reportAttributeAccessIssue] - of the same kind
        case ast.Compare() if type(node.ops[0]) in _SWAPS:
            node.ops[0] = _SWAPS[type(node.ops[0])]()  # pyright: ignore[reportArgumentType, reportCallIssue] - as above
        case ast.Constant(value=bool() as value):
            node.value = not value
        case ast.Constant(value=int() | float() as value):
            node.value = value + 1
        case ast.If() | ast.IfExp() | ast.While():
            node.test = ast.UnaryOp(ast.Not(), node.test)
        case _:
            return False
    return True


def _noticed(place: Path, module: Path, text: str, tests: list[str]) -> bool:
    original = (place / module).read_text(encoding="utf-8")
    (place / module).write_text(text, encoding="utf-8")
    command = [sys.executable, "-B", "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "-n0", *tests]
    environment = {**os.environ, "PYTHONPATH": str(place)}
    try:
        done = subprocess.run(command, cwd=place, env=environment, capture_output=True, timeout=_SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return True
    else:
        return done.returncode != 0
    finally:
        (place / module).write_text(original, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
