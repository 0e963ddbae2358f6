"""C++ source as text to search: without comments, calls with their arguments, the value of an initializer."""

import ast
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

# Regular expressions and no compiler: the C++ asks for elements in a dozen ways, all of them visible in
# the text, and a compiler would need Gazebo's dependencies.
_TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*.*?\*/', re.DOTALL)
_JOINED = re.compile(r'"\s*"')
_OPENING, _CLOSING = "([{", ")]}"
_STEPS = 5
"""So many names may stand for one another before a value."""
_CAST = re.compile(r"^(?:static_cast\s*<[^>]*>|double|float|int)\s*\((.*)\)$", re.DOTALL)
_COMPOUND = re.compile(r"^[\w:]*(?:Vector\d\w|Color|Pose3d|Quaterniond)\s*(?:<\w+>)?\s*[({](.*)[)}]$", re.DOTALL)
_NAMED = {"Zero": "0 0 0", "One": "1 1 1", "UnitX": "1 0 0", "UnitY": "0 1 0", "UnitZ": "0 0 1"}
_CONSTANT = re.compile(r"^[\w:]*Vector3d::(\w+)$")
_PI = {"PI": math.pi, "PI_2": math.pi / 2, "PI_4": math.pi / 4}
_PI_NAME = re.compile(r"\b(?:GZ|IGN|M)_(PI(?:_2|_4)?)\b")
_SUFFIX = re.compile(r"(?<=[\d.])(?:[fFlL]|[uU][lL]{0,2})\b")
_NAME = re.compile(r"^(?:[A-Za-z_]\w*\s*(?:->|\.|::)\s*)*([A-Za-z_]\w*)$")
_OPERATORS: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: lambda left, right: left + right,
    ast.Sub: lambda left, right: left - right,
    ast.Mult: lambda left, right: left * right,
    ast.Div: lambda left, right: left / right,
}


def source_text(path: Path) -> str:
    """A source file without its comments; bytes that are not UTF-8 are replaced."""
    return without_comments(path.read_text(encoding="utf-8", errors="replace"))


def without_comments(text: str) -> str:
    """The text with comments blanked and adjacent string literals joined."""
    code = _TOKEN.sub(lambda found: " " if found[0].startswith("/") else found[0], text)
    return _JOINED.sub("", code)


def arguments(text: str, start: int) -> tuple[list[str], int]:
    """The arguments of the call whose bracket opens at `start`, and the position behind it."""
    found, depth, begin = list[str](), 0, start + 1
    for position, character in _outside_strings(text, start):
        if character in _OPENING:
            depth += 1
        elif character in _CLOSING:
            depth -= 1
        if depth == 0 or (depth == 1 and character == ","):
            found.append(text[begin:position].strip())
            begin = position + 1
        if depth == 0:
            return [each for each in found if each], position + 1
    return [], len(text)


def _outside_strings(text: str, start: int) -> Iterator[tuple[int, str]]:
    position = start
    while position < len(text):
        found = _TOKEN.match(text, position)
        if found:
            position = found.end()
            continue
        yield position, text[position]
        position += 1


@dataclass(frozen=True, slots=True)
class Scope:
    """The files in which a name is searched for, the one that mentions it first."""

    texts: tuple[str, ...]
    before: int
    """Where it is mentioned in the first of them: of local variables the last one before that counts."""

    def value(self, expression: str, steps: int = _STEPS) -> str | None:
        """The value of an expression, as SDF writes it; None where it is empty or not to be known from the text."""
        text = _CAST.sub(r"\1", expression.strip()).strip()
        if text in {"true", "false"}:
            return text
        if text.startswith('"'):
            return text[1:-1] or None if _TOKEN.fullmatch(text) else None
        compound = _COMPOUND.match(text)
        if compound:
            return self._several(compound[1], steps)
        constant = _CONSTANT.match(text)
        if constant:
            return _NAMED.get(constant[1])
        name = _NAME.match(_PI_NAME.sub("", text))
        if name:
            return self._of_name(name[1], steps)
        return self._several(text, steps) if len(arguments(f"({text})", 0)[0]) > 1 else _number(text)

    def _several(self, text: str, steps: int) -> str | None:
        values = [self.value(each, steps) for each in arguments(f"({text})", 0)[0]]
        return " ".join(each for each in values if each) if values and all(values) else None

    def _of_name(self, name: str, steps: int) -> str | None:
        if steps == 0:
            return None
        declared = re.compile(rf"[\w>*&]\s+[*&]?{name}\s*(=|\{{|\()")
        assigned = re.compile(rf"(?:->|\.|[;{{}}]\s*){name}\s*(=)(?!=)")
        for text in self.texts:
            found = list(declared.finditer(text))
            near = [each for each in found if text is self.texts[0] and each.start() < self.before]
            for each in (near[::-1] or found)[:1]:
                return self._initial(text, each, steps - 1)
        # A member without an initializer may be given its value before it is read.
        near = [each for each in assigned.finditer(self.texts[0]) if each.end() < self.before]
        values = (self._initial(self.texts[0], each, steps - 1) for each in reversed(near))
        return next((value for value in values if value is not None), None)

    def _initial(self, text: str, declared: re.Match[str], steps: int) -> str | None:
        if declared[1] == "=":
            ends = [position for position, character in _outside_strings(text, declared.end()) if character == ";"][:1]
            return self.value(_unbraced(text[declared.end() : ends[0]].strip()), steps) if ends else None
        given, end = arguments(text, declared.end() - 1)
        return self.value(", ".join(given), steps) if text[end:].lstrip().startswith(";") else None


def _unbraced(text: str) -> str:
    return text[1:-1] if text.startswith("{") and text.endswith("}") else text


def _number(text: str) -> str | None:
    plain = _PI_NAME.sub(lambda found: repr(_PI[found[1]]), _SUFFIX.sub("", text))
    try:
        return f"{_arithmetic(ast.parse(plain.strip(), mode='eval').body):.12g}"
    except (SyntaxError, ValueError, ZeroDivisionError):
        return None


def _arithmetic(node: ast.expr) -> float:
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return float(value)
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return -_arithmetic(inner)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_arithmetic(left), _arithmetic(right))
        case _:
            raise ValueError("no number")
