"""How large the code is, room by room: `python -m benchmarks.code_size [FOLDER]...`, `make size`.

Code lines are lines of modules written by hand that are not blank, nor a part of an import, docstring or comment.
"""

import ast
import sys
import tokenize
from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass, fields
from io import BytesIO
from pathlib import Path

from testbed.markdown import table

_GENERATED = ("do not edit it", "not to be edited")
"""What the docstrings of generated modules say."""
_AROUND = ("tests", "testbed", "reports", "benchmarks", "generators", "fuzz")
"""Folders that are one row each, unless they are asked for."""


@dataclass(slots=True)
class Size:
    """Counts of a room; `lines` are all lines of modules that are not generated."""

    modules: int = 0
    packages: int = 0
    lines: int = 0
    code: int = 0
    comments: int = 0
    generated: int = 0

    def __add__(self, other: "Size") -> "Size":
        return Size(*map(sum, zip(astuple(self), astuple(other), strict=True)))


def size_of(module: Path) -> Size:
    """The counts of one module."""
    source = module.read_bytes()
    lines, tree = source.splitlines(), ast.parse(source)
    packages = int(module.name == "__init__.py")
    if any(words in (ast.get_docstring(tree) or "") for words in _GENERATED):
        return Size(1, packages, generated=len(lines))
    left_out = set(_lines_of_statements(tree))
    comments = set(_lines_of_comments(source))
    blank = {number for number, line in enumerate(lines, 1) if not line.strip()}
    code = len(lines) - len(left_out | comments | blank)
    return Size(1, packages, len(lines), code, len(comments))


def _lines_of_statements(tree: ast.Module) -> Iterator[int]:
    """The lines of imports and docstrings, those of attributes among them."""
    for node in ast.walk(tree):
        match node:
            case ast.Import() | ast.ImportFrom() | ast.Expr(value=ast.Constant(value=str())):
                yield from range(node.lineno, (node.end_lineno or node.lineno) + 1)
            case _:
                pass


def _lines_of_comments(source: bytes) -> Iterator[int]:
    """The lines that have a comment and nothing else."""
    for token in tokenize.tokenize(BytesIO(source).readline):
        if token.type == tokenize.COMMENT and not token.line[: token.start[1]].strip():
            yield token.start[0]


def rooms(folder: Path) -> Iterator[tuple[str, Size]]:
    """The folders in a folder and the modules beside them, which are one room, with their counts; then their sum."""
    found: dict[str, Size] = {}
    for module in sorted(folder.rglob("*.py")):
        inside = module.relative_to(folder).parts
        room = f"{folder.name}/{inside[0]}" if len(inside) > 1 else f"{folder.name}/*.py"
        found[room] = found.get(room, Size()) + size_of(module)
    yield from found.items()
    yield f"**{folder.name}**", sum(found.values(), Size())


def main(folders: Sequence[str]) -> None:
    """Print the table."""
    found = [row for name in folders or ["twinform"] for row in rooms(Path(name))]
    found += [list(rooms(Path(name)))[-1] for name in _AROUND if not folders]
    rows = [[room, *(f"{count:,}" for count in astuple(size))] for room, size in found]
    print(table(["room", *(field.name for field in fields(Size))], rows))


if __name__ == "__main__":
    main(sys.argv[1:])
