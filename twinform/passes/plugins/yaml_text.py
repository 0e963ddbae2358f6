"""Writes YAML in block style for ROS, with any text as data, whatever it contains."""

import json
import re
from collections.abc import Iterator, Mapping, Sequence

from twinform.lazy import lazy_pattern

Value = str | bool | int | float | None | Sequence["Value"] | Mapping[str, "Value"]

# PyYAML is no dependency: what is written is a mapping of known shape, and a property says that
# PyYAML reads it back, types included, for any text. ROS reads `nan` and `inf` as numbers where
# they stand without quotes, which PyYAML would not write in quotes.
_PLAIN = lazy_pattern(r"[A-Za-z_/][A-Za-z0-9_/.-]*(?: [A-Za-z0-9_/.]+)*")
"""Text that needs no quotes anywhere, except for the words below."""
# YAML 1.1 reads these as other types than text, and ROS as numbers.
_RESERVED_WORDS = frozenset({"true", "false", "yes", "no", "on", "off", "null", "y", "n", "nan", "inf", "infinity"})
_SURROGATES = lazy_pattern(r"\\u(d[89ab][0-9a-f]{2})\\u(d[c-f][0-9a-f]{2})")


def yaml_text(value: Mapping[str, Value]) -> str:
    """The mapping as a YAML document in block style.

    Keys have to be shorter than 1,000 characters, the limit of YAML.
    """
    return "".join(f"{line}\n" for line in _block_lines(value))


def quote(text: str) -> str:
    """A text in double quotes as in JSON, except for characters that JSON writes as two surrogates."""
    return _SURROGATES.sub(_join_surrogates, json.dumps(text))


def _join_surrogates(pair: re.Match[str]) -> str:
    high, low = (int(half, 16) for half in pair.groups())
    return f"\\U{0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00):08x}"


def _block_lines(value: Value) -> Iterator[str]:
    """The lines of a mapping or sequence that is not empty."""
    if isinstance(value, Mapping):
        for key, each in value.items():
            yield from _entry_lines(f"{_scalar(key)}:", each)
    elif isinstance(value, Sequence) and not isinstance(value, str):
        for each in value:
            inner = list(_block_lines(each)) if _is_block(each) else [_scalar(each)]
            yield f"- {inner[0]}"
            yield from (f"  {line}" for line in inner[1:])


def _entry_lines(key: str, value: Value) -> Iterator[str]:
    if not _is_block(value):
        yield f"{key} {_scalar(value)}"
        return
    yield key
    yield from (f"  {line}" for line in _block_lines(value))


def _is_block(value: Value) -> bool:
    return isinstance(value, Mapping | Sequence) and not isinstance(value, str) and bool(value)


def _scalar(value: Value) -> str:
    match value:
        case None:
            return "null"
        case bool():
            return "true" if value else "false"
        case str():
            plain = _PLAIN.fullmatch(value) and value.lower() not in _RESERVED_WORDS
            return value if plain else quote(value)
        case int():
            return str(value)
        case float():
            return _format_number(value)
        case Mapping():
            return "{}"
        case _:
            return "[]"


def _format_number(value: float) -> str:
    """A number that YAML 1.1 reads as one: with a point, even before an exponent."""
    text = repr(float(value))
    mantissa, e, exponent = text.partition("e")
    if not e:
        return text
    sign = "" if exponent.startswith("-") else "+"
    point = "" if "." in mantissa else ".0"
    return f"{mantissa}{point}e{sign}{exponent.lstrip('+')}"
