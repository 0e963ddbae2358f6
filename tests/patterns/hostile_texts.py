"""Texts that a regular expression may need long for, derived from it: something it repeats, very often, and no end.

A repetition that may end at many places takes the square of a text's length if what follows is not there; two that can
take the same characters take its cube, and one in another doubles with each character. So each repetition gets what
has to stand before it, then many of what it repeats, then what cannot follow.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from importlib import import_module
from typing import Any, NamedTuple

# Python's own parser of regular expressions has no public name
constants: Any = import_module("re._constants")
parser: Any = import_module("re._parser")

_CANDIDATES = "\0\t\n\r !\"#$%&'()*+,-./059:;<=>?@AEXZ[\\]^_`abdefgimnprstxyz{|}~\u00b0\u00e9"
"""Characters of which those that a pattern treats alike are tried once."""
_LIKELY = "a0 " + _CANDIDATES
_MANY = 64
_REPEATS = frozenset({constants.MAX_REPEAT, constants.MIN_REPEAT, constants.POSSESSIVE_REPEAT})
_Parsed = Any


class Hostile(NamedTuple):
    """A text that begins somehow, repeats something, and ends somehow."""

    before: str
    again: str
    behind: str

    def of_length(self, length: int) -> str:
        """The text with about so many characters."""
        return self.before + self.again * (length // len(self.again)) + self.behind


def hostile_texts(pattern: re.Pattern[Any]) -> list[Hostile]:
    """What may be hard for a pattern; the texts for patterns of bytes have characters of one byte."""
    source = pattern.pattern if isinstance(pattern.pattern, str) else pattern.pattern.decode("latin-1")
    parsed = parser.parse(source, pattern.flags & ~re.UNICODE if isinstance(pattern.pattern, bytes) else pattern.flags)
    characters = _different(parsed)
    # a character that most parts of a pattern take is one that they can take from each other
    shared = "".join(sorted(characters, key=lambda each: -sum(_accepts(of, each) for of in _sets(parsed))))
    repeats = [each for likely in (_LIKELY, shared) for each in _repeats(parsed, "", likely)]
    befores = dict.fromkeys(["", *(before for before, _ in repeats)])
    bodies = [part for before, body in repeats for part in (body, before + body)]
    again = dict.fromkeys([*characters, *bodies, *befores, _sample(parsed, _LIKELY)[:-1]])
    ends = ("", "\0", "\n")
    return [Hostile(before, each, end) for before in befores for each in again if each and repeats for end in ends]


def _repeats(parsed: _Parsed, before: str, likely: str) -> Iterator[tuple[str, str]]:
    """What may stand before each repetition without an end, and what it repeats."""
    for operation, argument in parsed:
        if operation in _REPEATS:
            _, most, body = argument
            if most > _MANY:
                yield before, _sample(body, likely) or "a"
            yield from _repeats(body, before, likely)
        else:
            for part in _parts(operation, argument):
                yield from _repeats(part, before, likely)
        before += _sample([(operation, argument)], likely)


def _parts(operation: object, argument: Any) -> Sequence[_Parsed]:
    """The patterns in one element of a pattern."""
    if operation is constants.SUBPATTERN:
        return [argument[-1]]
    if operation is constants.BRANCH:
        return argument[1]
    if operation is constants.ATOMIC_GROUP:
        return [argument]
    if operation in {constants.ASSERT, constants.ASSERT_NOT}:
        return [argument[1]]
    if operation is constants.GROUPREF_EXISTS:
        return [each for each in argument[1:] if each]
    return []


def _sample(parsed: _Parsed, likely: str) -> str:
    """A short text that a pattern matches, as far as that can be said without its assertions."""
    return "".join(_sample_of(operation, argument, likely) for operation, argument in parsed)


def _sample_of(operation: object, argument: Any, likely: str) -> str:
    if operation is constants.LITERAL:
        return chr(argument)
    if operation is constants.NOT_LITERAL:
        return next(each for each in likely + _LIKELY if ord(each) != argument)
    if operation is constants.IN:
        return next((each for each in likely + _LIKELY if _accepts(argument, each)), "a")
    if operation is constants.ANY:
        return likely[0]
    if operation in _REPEATS:
        least, most, body = argument
        return _sample(body, likely) * max(least, min(1, most))
    if operation in {constants.ASSERT, constants.ASSERT_NOT}:
        return ""
    return "".join(_sample(part, likely) for part in _parts(operation, argument)[:1])


def _different(parsed: _Parsed) -> list[str]:
    """One of the characters each that the pattern treats alike."""
    sets = [*_sets(parsed)]
    first: dict[tuple[bool, ...], str] = {}
    for character in _LIKELY:
        first.setdefault(tuple(_accepts(each, character) for each in sets), character)
    return [*first.values()]


def _sets(parsed: _Parsed) -> Iterator[list[tuple[Any, Any]]]:
    for operation, argument in parsed:
        if operation in {constants.LITERAL, constants.NOT_LITERAL}:
            yield [(constants.LITERAL, argument)]
        elif operation is constants.IN:
            yield argument
        elif operation in _REPEATS:
            yield from _sets(argument[2])
        else:
            for part in _parts(operation, argument):
                yield from _sets(part)


def _accepts(items: Iterable[tuple[Any, Any]], character: str) -> bool:
    """Whether a set of characters has one."""
    code, negated, found = ord(character), False, False
    for operation, argument in items:
        if operation is constants.NEGATE:
            negated = True
        elif operation is constants.LITERAL:
            found |= code == argument
        elif operation is constants.RANGE:
            found |= argument[0] <= code <= argument[1]
        elif operation is constants.CATEGORY:
            found |= _CATEGORIES[argument].fullmatch(character) is not None
    return found is not negated


_CATEGORIES = {
    getattr(constants, f"CATEGORY_{name}"): re.compile(letter)
    for name, letter in (
        ("DIGIT", r"\d"),
        ("NOT_DIGIT", r"\D"),
        ("SPACE", r"\s"),
        ("NOT_SPACE", r"\S"),
        ("WORD", r"\w"),
        ("NOT_WORD", r"\W"),
    )
}
