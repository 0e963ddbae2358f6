"""Fixes of values: commas, units and other characters in numbers, colors of 255, degrees, tabs, words in capitals."""

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

from twinform.compiler.fixing.site import FindingSite, Fixers, revealing, unsafe
from twinform.diagnostics import Fix, Safety, meant_name, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import VALUE_TYPES, format_value

# A number may not start in the middle of another one, or each digit of a long one would be a start
# (quadratic time).
_NUMBER = r"[-+]?(?<![\d.])(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?"
_LONGEST = 1000
"""The longest text, in characters, that somebody may have meant something by."""
# What word processors make of a minus, a comma, a point and a blank.
_CHARACTERS = str.maketrans(
    {"\u2212": "-", "\u2013": "-", "\ufe63": "-", "\uff0d": "-", "\uff0c": ",", "\uff0e": ".", "\u00a0": " "}
)
_BRACKETS = str.maketrans("()[]{}", "      ")
_THOUSANDS = lazy_pattern(r"[-+]?[1-9]\d{0,2}(?:,\d{3})+(?:\.\d+)?")
_DECIMAL_COMMA = lazy_pattern(r"(?<=\d),(?=\d)|(?<![\d.]),(?=\d)")
_SI = {"m", "rad", "kg", "n", "nm", "n*m", "n.m", "s", "m/s", "rad/s", "hz", "kg*m^2", "kg.m^2", "kgm^2"}
"""Units that the formats use anyway."""
_SCALES = {
    "mm": 1e-3,
    "cm": 1e-2,
    "km": 1e3,
    "in": 0.0254,
    "inch": 0.0254,
    "g": 1e-3,
    "ms": 1e-3,
    "deg": math.pi / 180,
    "degree": math.pi / 180,
    "degrees": math.pi / 180,
    "\u00b0": math.pi / 180,
    "deg/s": math.pi / 180,
    "rpm": math.pi / 30,
}
_WITH_UNIT = lazy_pattern(rf"(?P<number>{_NUMBER})\s*+(?P<unit>[A-Za-z\u00b0][A-Za-z/*.^\d]*+)")
_WORDS = {"yes": "true", "on": "true", "no": "false", "off": "false"}
# Here a minus means neither "no limit" nor a direction.
_NEVER_NEGATIVE = frozenset({"capsule", "cylinder", "dynamics", "length", "mass", "radius", "size", "sphere"})
_POSE = 6


class Guess(NamedTuple):
    """A text that may have been meant, and whether it is safe to write it."""

    text: str
    safety: Safety


def _invalid_value(site: FindingSite) -> Fix | None:
    text = site.value
    word = meant_name(site.finding.help)
    # What cannot be read is no part of the robot before.
    if word is not None:
        certain = word.lower() == text.strip().lower()
        return (revealing if certain else unsafe)(f"Write {word!r}", *site.set_value(word))
    parses = _parser(site)
    if parses is None or not text.strip() or len(text) > _LONGEST or len(site.element):
        return None
    for guess in guesses(text, site.finding.expected or ""):
        if guess.text != text and parses(guess.text):
            return Fix(f"Write {guess.text!r}", site.set_value(guess.text), guess.safety, keeps=False)
    return None


def _parser(site: FindingSite) -> Callable[[str], bool] | None:
    """Return a test whether a text is of the type that the finding asks for."""
    types = [each for each in VALUE_TYPES[site.file.format].values() if each.expected == site.finding.expected]
    types = types or [each for each in VALUE_TYPES["sdf"].values() if each.expected == site.finding.expected]
    if not types:
        return None

    def parses(text: str) -> bool:
        try:
            types[0].parse(text)
        except ValueError:
            return False
        return True

    return parses


def guesses(text: str, expected: str) -> Iterator[Guess]:
    """Yield texts that may have been meant, the most certain first."""
    plain = " ".join(text.translate(_CHARACTERS).split())
    yield Guess(plain, Safety.SAFE)
    if _THOUSANDS.fullmatch(plain):
        return  # 1,000 is one or a thousand
    bare = " ".join(plain.translate(_BRACKETS).split())
    yield Guess(" ".join(bare.replace(",", " ").replace(";", " ").split()), Safety.SAFE)
    yield Guess(_DECIMAL_COMMA.sub(".", bare), Safety.SAFE)
    yield Guess(bare.strip("\"'`.,;:"), Safety.SAFE)
    yield from _without_units(bare)
    yield Guess(f"{bare} 1" if "alpha" in expected else bare, Safety.SAFE)
    if expected == VALUE_TYPES["urdf"]["vector3"].expected and len(numbers_of(bare)) == 1:
        yield Guess(" ".join([bare] * 3), Safety.UNSAFE)
    if len(numbers_of(bare)) == _POSE // 2 and expected == VALUE_TYPES["sdf"]["pose"].expected:
        yield Guess(f"{bare} 0 0 0", Safety.UNSAFE)
    yield Guess(_WORDS.get(bare.lower(), bare), Safety.UNSAFE)


def _without_units(text: str) -> Iterator[Guess]:
    found = [*_WITH_UNIT.finditer(text)]
    if not found or (_WITH_UNIT.sub("", text).strip() and not numbers_of(_WITH_UNIT.sub("", text))):
        return
    units = {each["unit"].lower() for each in found}
    # `0.5f` is a float literal of C.
    if units <= _SI or units == {"f"}:
        yield Guess(_WITH_UNIT.sub(lambda each: each["number"], text), Safety.SAFE)
    elif units <= _SCALES.keys():

        def scaled(each: re.Match[str]) -> str:
            return text_of_number(float(each["number"]) * _SCALES[each["unit"].lower()])

        yield Guess(_WITH_UNIT.sub(scaled, text), Safety.UNSAFE)


def _out_of_range(site: FindingSite) -> Fix | None:
    numbers = numbers_of(site.value)
    if site.finding.help == "divide by 255" and all(0 <= each <= _WHITE for each in numbers):
        # Somebody who writes colors from 0 to 255 often still writes an alpha of 1.
        alpha = numbers[3:] if len(numbers) > 3 and numbers[3] <= 1 else tuple(each / _WHITE for each in numbers[3:])
        value = text_of_numbers(round(each, 4) for each in (*(each / _WHITE for each in numbers[:3]), *alpha))
        if max(numbers) > _MOST_BRIGHT:
            return unsafe(f"Divide by 255: {value}", *site.set_value(value))
    if site.element.tag in _NEVER_NEGATIVE and len(numbers) == 1 and numbers[0] < 0:
        return unsafe("Write it without its minus", *site.set_value(site.value.strip().removeprefix("-")))
    return None


_WHITE = 255
# A color between 1 and this is too bright rather than one from 0 to 255.
_MOST_BRIGHT = 2


def _angles_in_degrees(site: FindingSite) -> Fix | None:
    """Convert the angles of a pose or a lidar from degrees to radians."""
    if site.element.tag in {"min_angle", "max_angle"}:
        return _angles_of_lidar(site)
    if site.file.format == "urdf":
        angles = numbers_of(site.element.get("rpy"))
        if len(angles) != 3:
            return None
        value = _radians(angles)
        return unsafe("Write the angles in radians", site.edit.set_attribute(site.element, "rpy", value))
    numbers = (site.element.text or "").split()
    if len(numbers) != _POSE or len(numbers_of(site.element.text)) != _POSE:
        return None
    value = f"{' '.join(numbers[:3])} {_radians(numbers_of(site.element.text)[3:])}"
    return unsafe("Write the angles in radians", *site.edit.set_text(site.element, value))


def _angles_of_lidar(site: FindingSite) -> Fix | None:
    """Write the angles of a lidar that are more than a turn in radians."""
    holder = site.element.getparent()
    ends = [] if holder is None else list(holder.iterchildren("min_angle", "max_angle"))
    numbers = [(each, *numbers_of(each.text)) for each in ends]
    edits = [
        edit
        for each, *angles in numbers
        if len(angles) == 1 and abs(angles[0]) > math.tau
        for edit in site.edit.set_text(each, text_of_number(round(math.radians(angles[0]), 9)))
    ]
    return unsafe("Write the angles in radians", *edits) if edits else None


def _radians(angles: Sequence[float]) -> str:
    return text_of_numbers(round(math.radians(each), 9) for each in angles)


def _unnormalized_quaternion(site: FindingSite) -> Fix | None:
    numbers = numbers_of(site.read(site.element, "quat_xyzw"))
    turn = numbers[-4:]
    length = math.hypot(*turn)
    if len(turn) != 4 or not length:
        return None
    value = text_of_numbers((*numbers[:-4], *(each / length for each in turn)))
    return unsafe("Write the quaternion with length one", *site.write(site.element, "quat_xyzw", value))


def _split_value(site: FindingSite) -> Fix | None:
    """Move the comments in a value before its element."""
    place, text = site.edit.places[site.element], site.edit.text_with(site.element)
    if place.content is None or place.children:
        return None
    value = " ".join("".join(run.of(text) for run in place.texts()).split())
    comments = "".join(aside.of(text) for aside in place.asides)
    moved = site.edit.replace(site.element, place.start_tag._replace(end=place.start_tag.start), comments)
    bare = site.edit.replace(site.element, place.content, value)
    return unsafe(f"Put the comment before the element, whose text is {value!r}", moved, bare)


def _negative_mass(site: FindingSite) -> Fix | None:
    element = site.element if site.element.tag == "mass" else site.element.find("mass")
    if element is None:
        return None
    text = site.read(element, "value")
    numbers = numbers_of(text)
    if len(numbers) != 1 or numbers[0] >= 0:
        return None
    value = text.strip().removeprefix("-")
    return unsafe("Write the mass without its minus", *site.write(element, "value", value))


_DIGITS = 15


def numbers_of(text: str | None) -> tuple[float, ...]:
    """Return the numbers of a text, or nothing where something else is in it."""
    try:
        found = tuple(map(float, (text or "").split()))
    except ValueError:
        return ()
    return found if all(map(math.isfinite, found)) else ()


def text_of_number(value: float) -> str:
    """Write a number with its shortest text, to 15 digits."""
    rounded = float(f"{value:.{_DIGITS}g}") + 0.0
    return format_value(rounded)


def text_of_numbers(values: Iterable[float]) -> str:
    """Write several numbers in their shortest spelling, with blanks between them."""
    return " ".join(map(text_of_number, values))


FIXERS: Fixers = {
    rules.ANGLE_IN_DEGREES.name: _angles_in_degrees,
    rules.UNNORMALISED_QUATERNION.name: _unnormalized_quaternion,
    rules.NON_POSITIVE_MASS.name: _negative_mass,
    rules.INVALID_VALUE.name: _invalid_value,
    rules.OUT_OF_RANGE.name: _out_of_range,
    rules.SPLIT_VALUE.name: _split_value,
}
