"""YAML text: block style for what ROS reads, with any text as data, whatever is in it."""

import json
import re
from collections.abc import Iterator, Mapping, Sequence

Value = str | bool | int | float | None | Sequence["Value"] | Mapping[str, "Value"]

# PyYAML is no dependency: what is written is a mapping of known shape, and a property says that
# PyYAML reads it back, types included, for any text. ROS reads `nan` and `inf` as numbers where
# they stand without quotes, which PyYAML would not write in quotes.
_PLAIN = re.compile(r"[A-Za-z_/][A-Za-z0-9_/.-]*(?: [A-Za-z0-9_/.]+)*")
"""Text that needs no quotes in any place, but for the words below."""
# YAML 1.1 reads these as something else than text, and ROS as numbers.
_WORDS = frozenset({"true", "false", "yes", "no", "on", "off", "null", "y", "n", "nan", "inf", "infinity"})
_SURROGATES = re.compile(r"\\u(d[89ab][0-9a-f]{2})\\u(d[c-f][0-9a-f]{2})")


def yaml_text(value: Mapping[str, Value]) -> str:
    """A document of YAML with this mapping, in block style, with an end of line.

    Keys are shorter than 1,000 characters, which is as long as YAML has them.
    """
    return "".join(f"{line}\n" for line in _lines(value))


def quoted(text: str) -> str:
    """Text in double quotes: those of JSON, but for characters that JSON writes as two."""
    return _SURROGATES.sub(_joined, json.dumps(text))


def _joined(pair: re.Match[str]) -> str:
    high, low = (int(half, 16) for half in pair.groups())
    return f"\\U{0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00):08x}"


def _lines(value: Value) -> Iterator[str]:
    """The lines of a mapping or sequence that has something in it."""
    if isinstance(value, Mapping):
        for key, each in value.items():
            yield from _entry_lines(f"{_scalar(key)}:", each)
    elif isinstance(value, Sequence) and not isinstance(value, str):
        for each in value:
            inner = list(_lines(each)) if _is_block(each) else [_scalar(each)]
            yield f"- {inner[0]}"
            yield from (f"  {line}" for line in inner[1:])


def _entry_lines(key: str, value: Value) -> Iterator[str]:
    if not _is_block(value):
        yield f"{key} {_scalar(value)}"
        return
    yield key
    yield from (f"  {line}" for line in _lines(value))


def _is_block(value: Value) -> bool:
    return isinstance(value, Mapping | Sequence) and not isinstance(value, str) and bool(value)


def _scalar(value: Value) -> str:
    match value:
        case None:
            return "null"
        case bool():
            return "true" if value else "false"
        case str():
            plain = _PLAIN.fullmatch(value) and value.lower() not in _WORDS
            return value if plain else quoted(value)
        case int():
            return str(value)
        case float():
            return _number(value)
        case Mapping():
            return "{}"
        case _:
            return "[]"


def _number(value: float) -> str:
    """A number that YAML 1.1 reads as one: with a point, also before an exponent."""
    text = repr(float(value))
    mantissa, e, exponent = text.partition("e")
    if not e:
        return text
    sign = "" if exponent.startswith("-") else "+"
    point = "" if "." in mantissa else ".0"
    return f"{mantissa}{point}e{sign}{exponent.lstrip('+')}"
