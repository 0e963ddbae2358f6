r"""The text of a pipeline: its grammar, and its parser and printer without any knowledge of passes.

    pipeline = [ part { "," part } ]
    part     = pass | "@" key
    pass     = name [ "{" [ option { separator option } ] "}" ]
    option   = name "=" value
    value    = scalar | "[" [ scalar { "," scalar } ] "]"
    scalar   = number | "true" | "false" | "null" | word | string

A `name` is kebab-case: `fill-limits`. A `key` is letters, digits, `_` and `-`, which is what TOML writes as a key
without quotes; `@key` stands for the passes of the pipeline that a configuration calls so. A `separator` is a comma, or
blanks, or both. Blanks may stand around commas, inside brackets and braces, and at both ends. A `number` is written as
in Python, or is `inf` or `-inf`. A `word` is any run of characters without blanks, quotes and `, = { } [ ]` that is not
one of the other scalars; all other text is a `string`: in double quotes, with the escapes of JSON.

    lump-fixed-joints{keep=tool0},check-inertia,fill-limits{effort=100 joints="arm_[0-9]"}
"""

import json
import math
import re
from collections.abc import Iterator

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern

Scalar = str | float | bool | None
Value = Scalar | list[Scalar]

_BLANKS = lazy_pattern(r"\s*")
# No pass can be called `@NAME`: names begin with a letter.
_NAME = lazy_pattern(r"[a-z][a-z0-9]*(?:-[a-z0-9]+)*")
KEY = lazy_pattern(r"[A-Za-z0-9_-]+")
"""The name of a pipeline."""
_STRING = lazy_pattern(r'"(?:[^"\\]|\\.)*"', re.DOTALL)
_WORD = lazy_pattern(r'[^\s,={}\[\]"]+')
_INTEGER = lazy_pattern(r"[-+]?[0-9]+")
_REAL = lazy_pattern(r"[-+]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)(?:[eE][-+]?[0-9]++)?|[-+]?inf")
_KEYWORDS: dict[str, Scalar] = {"true": True, "false": False, "null": None}
# No double needs more digits, and Python refuses to read thousands of them.
_LONGEST_NUMBER = 400


class PipelineError(ValueError):
    """The text of a pipeline is wrong; `position` counts characters from 0."""

    def __init__(self, problem: str, text: str, position: int) -> None:
        self.problem, self.text, self.position = problem, text, position
        super().__init__(f"{problem}\n{self._caret()}")

    def _caret(self) -> str:
        """The line with the mistake, and a caret below the character."""
        start = self.text.rfind("\n", 0, self.position) + 1
        line = self.text[start:].split("\n", 1)[0]
        indent = "".join(each if each == "\t" else " " for each in line[: self.position - start])
        return f"  {line}\n  {indent}^"


@dataclass(frozen=True, slots=True)
class PipelineOption:
    """`name=value`, with the positions of the name and of the value."""

    name: str
    value: Value
    position: int
    value_position: int


@dataclass(frozen=True, slots=True)
class Call:
    """A pass and its options as they are written, with the position of the name."""

    name: str
    options: tuple[PipelineOption, ...]
    position: int


@dataclass(frozen=True, slots=True)
class PipelineReference:
    """`@name`, which refers to a pipeline; `position` is that of the `@`."""

    name: str
    position: int


def parse_calls(text: str) -> tuple[Call | PipelineReference, ...]:
    """Parse a text into calls of passes and references to pipelines.

    Raises:
        PipelineError: the text does not follow the grammar.
    """
    return tuple(_Scanner(text).pipeline())


def print_call(name: str, options: dict[str, Value]) -> str:
    """A pass in its canonical spelling: one blank between options, and no braces without options."""
    listed = " ".join(f"{key}={print_value(value)}" for key, value in options.items())
    return f"{name}{{{listed}}}" if listed else name


def print_value(value: Value) -> str:
    """A value in its canonical spelling; text is quoted only where it has to be."""
    return f"[{','.join(map(_print_scalar, value))}]" if isinstance(value, list) else _print_scalar(value)


def _print_scalar(value: Scalar) -> str:
    if isinstance(value, str):
        plain = _WORD.fullmatch(value) and value.isprintable() and value not in _KEYWORDS and not _REAL.fullmatch(value)
        return value if plain else json.dumps(value, ensure_ascii=not value.isprintable())
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    return print_number(value)


def print_number(value: float) -> str:
    """A number without a needless `.0`."""
    return repr(value).removesuffix(".0") if value else repr(value)  # -0.0 keeps its sign only with its point


def _read_word(word: str) -> Scalar:
    if word in _KEYWORDS:
        return _KEYWORDS[word]
    if _INTEGER.fullmatch(word):
        return int(word)
    return float(word) if _REAL.fullmatch(word) else word


class _Scanner:
    """Reads the text from left to right; each method reads one rule of the grammar."""

    def __init__(self, text: str) -> None:
        self.text, self.at = text, 0

    def pipeline(self) -> Iterator[Call | PipelineReference]:
        self.take(_BLANKS)
        if self.at == len(self.text):
            return
        yield self.part()
        while self.skip(","):
            yield self.part()
        if self.at < len(self.text):
            raise self.expected("',' or the end")

    def part(self) -> Call | PipelineReference:
        position = self.at
        if not self.skip("@", blanks=False):
            return self.call()
        key = self.take(KEY)
        if not key:
            raise self.expected("the name of a pipeline")
        self.take(_BLANKS)
        return PipelineReference(key, position)

    def call(self) -> Call:
        position, name = self.at, self.name("a pass")
        options = tuple(self.options()) if self.at < len(self.text) and self.text[self.at] == "{" else ()
        self.take(_BLANKS)
        return Call(name, options, position)

    def options(self) -> Iterator[PipelineOption]:
        seen = set[str]()
        self.skip("{")
        while not self.skip("}"):
            if seen:
                self.separator()
            option = self.option()
            if option.name in seen:
                raise PipelineError(f"the option {option.name} is given twice", self.text, option.position)
            seen.add(option.name)
            yield option

    def separator(self) -> None:
        """Read a comma, or accept blanks before this place."""
        if not self.skip(",") and not self.text[self.at - 1].isspace():
            raise self.expected("',', a blank or '}'")

    def option(self) -> PipelineOption:
        position, name = self.at, self.name("an option")
        if not self.skip("=", blanks=False):
            raise self.expected("'='")
        start, value = self.at, self.value()
        self.take(_BLANKS)
        return PipelineOption(name, value, position, start)

    def value(self) -> Value:
        if not self.skip("["):
            return self.scalar()
        values: list[Scalar] = []
        while not self.skip("]"):
            if values and not self.skip(","):
                raise self.expected("',' or ']'")
            values.append(self.scalar())
            self.take(_BLANKS)
        return values

    def scalar(self) -> Scalar:
        position = self.at
        if self.text.startswith('"', position):
            return self.string()
        word = self.take(_WORD)
        if not word:
            raise self.expected("a value")
        if not _REAL.fullmatch(word) or word.endswith("inf"):
            return _read_word(word)
        if len(word) > _LONGEST_NUMBER or math.isinf(float(word)):
            raise PipelineError("the number is too large", self.text, position)
        return _read_word(word)

    def string(self) -> str:
        position = self.at
        literal = self.take(_STRING)
        if not literal:
            raise PipelineError('the string has no closing "', self.text, position)
        try:
            return str(json.loads(literal, strict=False))
        except json.JSONDecodeError as error:
            raise PipelineError("no such escape", self.text, position + error.pos) from error

    def name(self, what: str) -> str:
        name = self.take(_NAME)
        if not name:
            raise self.expected(f"the name of {what}")
        return name

    def take(self, pattern: re.Pattern[str]) -> str:
        """Read the text that a pattern matches here; empty where it does not match."""
        found = pattern.match(self.text, self.at)
        self.at = found.end() if found else self.at
        return found[0] if found else ""

    def skip(self, character: str, *, blanks: bool = True) -> bool:
        """Move past a character, and the blanks behind it, if it comes next."""
        if not self.text.startswith(character, self.at):
            return False
        self.at += 1
        if blanks:
            self.take(_BLANKS)
        return True

    def expected(self, what: str) -> PipelineError:
        here = repr(self.text[self.at]) if self.at < len(self.text) else "the end"
        return PipelineError(f"expected {what}, not {here}", self.text, self.at)
