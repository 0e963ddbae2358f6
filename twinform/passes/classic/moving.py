"""Conversion of parameters of Gazebo Classic plugins to the elements that gz-sim reads."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from math import isfinite, pi, tan

from twinform.ir import Element
from twinform.passes.classic.element_edits import added, text_at, with_text
from twinform.passes.classic.tables import Move, Moves
from twinform.schemas import format_value

_TRUTHS = {"true": "true", "True": "true", "1": "true", "false": "false", "False": "false", "0": "false"}
_FIELD_OF_VIEW = 1.047
"""What SDF has for a camera's field of view where nothing is written, in rad."""
# The time in s over which a bias wanders where none is given: that of hector_gazebo's sensor
# models.
_DRIFT_TIME = "3600"


@dataclass(frozen=True, slots=True)
class DroppedParameter:
    """A parameter that went nowhere, and why; `harmless` where its value does not matter."""

    parameter: Element
    reason: str
    harmless: bool = False


@dataclass(slots=True)
class Moved:
    """What the parameters made: the element that they went into, and what went nowhere.

    Where a path `repeats`, values stand beside each other; else the first one stays. `is_valid` is whether the
    element can be as it is; a parameter after which it cannot goes nowhere.
    """

    element: Element
    repeats: Callable[[str], bool] = lambda _: False
    is_valid: Callable[[Element], bool] = lambda _: True
    moved: set[str] = field(default_factory=set[str])
    lost: list[DroppedParameter] = field(default_factory=list[DroppedParameter])
    frame: str | None = None
    offsets: dict[str, str] = field(default_factory=dict[str, str])

    def apply(self, parameters: Iterable[Element], moves: Moves) -> None:
        """Take the parameters to their places; those that the moves do not know are left."""
        for parameter in parameters:
            move = moves.get(parameter.name)
            if move is not None:
                before = self.element
                self._take(parameter, move)
                self.moved.add(parameter.name)
                # One bad value (`<updateRate>$(arg rate)</updateRate>`) must not cost the whole
                # sensor: the step is taken back and the parameter reported.
                if self.element is not before and not self.is_valid(self.element):
                    self.element = before
                    self.lost.append(DroppedParameter(parameter, f"{parameter.text!r} is no value for it"))

    def _take(self, parameter: Element, move: Move) -> None:
        text = (parameter.text or "").strip()
        if _is_harmless(text, move.harmless):
            self.lost.append(DroppedParameter(parameter, move.drop or "it is the default", harmless=True))
        elif move.drop is not None:
            self.lost.append(DroppedParameter(parameter, move.drop))
        elif not (text or parameter.children or parameter.attributes):
            self.lost.append(DroppedParameter(parameter, "it is empty", harmless=True))
        elif move.choose is not None:
            self._choose(parameter, text, move)
        # The plugin of Gazebo Classic took several where the system of gz-sim reads one.
        elif move.first and parameter.name in self.moved:
            self.lost.append(DroppedParameter(parameter, "the system has one value for all", harmless=False))
        elif parameter.children or parameter.attributes:
            self.element = added(self.element, parameter.copy(name=move.to or parameter.name))
        else:
            self._write_all(parameter, text, move)

    def _choose(self, parameter: Element, text: str, move: Move) -> None:
        choices = move.choose or {}
        chosen = choices.get(text, choices.get(_TRUTHS.get(text, text)))
        if chosen is None:
            self.lost.append(DroppedParameter(parameter, f"{text!r} is none of {', '.join(choices)}"))
            return
        for path, value in chosen.items():
            self.element = with_text(self.element, path, value)

    def _write_all(self, parameter: Element, text: str, move: Move) -> None:
        for part in text.split(move.split) if move.split else [text]:
            for path, value in self._values(part.strip(), move):
                self._write(parameter, path, value, move)
        for path, value in move.also.items():
            if text_at(self.element, path) is None:
                self.element = with_text(self.element, path, value)

    def _values(self, text: str, move: Move) -> Iterator[tuple[str, str]]:
        if move.each:
            numbers = text.split()
            # One number for all three axes, as hector_gazebo's sensor models take it.
            many = numbers if len(numbers) == len(move.each) else numbers[:1] * len(move.each)
            yield from zip(move.each, many, strict=False)
            return
        value = text.strip("/") if move.bare else self._scaled(text, move)
        for path in (move.to or "", *move.same):
            yield path, value
        if move.mirror and (number := _number(value)) is not None:
            yield move.mirror, format_value(-number)

    def _scaled(self, text: str, move: Move) -> str:
        number, factor = _number(text), move.scale
        if move.negative_times is not None:
            factor = -focal_length(self.element)
        return text if number is None or factor is None else format_value(number * factor)

    def _write(self, parameter: Element, path: str, value: str, move: Move) -> None:
        if path == "@frame":
            self.frame = value
            return
        if path.startswith("@"):
            self._keep_offset(parameter, path[1:], value)
            return
        old = text_at(self.element, path)
        # Sensor and plugin both have a rate, and Gazebo Classic measured at the sensor's and
        # published at the plugin's: the smaller one is what subscribers saw.
        if move.least and old is not None:
            value = _least(old, value)
        elif old is not None and self.repeats(path):
            self.element = added(self.element, Element(name=path, text=value))
            return
        # Settings of the sensor count more than what its plugin repeats (ranges, clips, fields of
        # view); the plugin's value that differs is reported.
        elif old is not None:
            if not _same(old, value):
                self.lost.append(DroppedParameter(parameter, f"the {self.element.name} itself has {path} {old}"))
            return
        self.element = with_text(self.element, path, value)
        if move.noise:
            self._make_noise(path.rpartition("/")[0], move)

    def _keep_offset(self, parameter: Element, name: str, value: str) -> None:
        numbers = _numbers(value)
        if len(numbers) == len("xyz") and all(number is not None and isfinite(number) for number in numbers):
            self.offsets[name] = value
        else:
            self.lost.append(DroppedParameter(parameter, f"{value!r} is not three numbers"))

    def _make_noise(self, noise: str, move: Move) -> None:
        self.element = with_text(self.element, f"{noise}/@type", "gaussian")
        beside = {"mean": "0", "stddev": "0"}
        if move.drifts:
            beside["dynamic_bias_correlation_time"] = _DRIFT_TIME
        for name, value in beside.items():
            if text_at(self.element, f"{noise}/{name}") is None:
                self.element = with_text(self.element, f"{noise}/{name}", value)


def focal_length(sensor: Element) -> float:
    """The focal length of a camera in pixels, from its field of view and the width of its images."""
    fov = _number(text_at(sensor, "camera/horizontal_fov") or "") or _FIELD_OF_VIEW
    fov = fov if 0 < fov < pi else _FIELD_OF_VIEW
    return camera_width(sensor) / (2 * tan(fov / 2))


def camera_width(sensor: Element) -> float:
    """The width of a camera's images in pixels."""
    return _number(text_at(sensor, "camera/image/width") or "") or 320.0


def camera_height(sensor: Element) -> float:
    """The height of a camera's images in pixels."""
    return _number(text_at(sensor, "camera/image/height") or "") or 240.0


def truth_of(text: str) -> bool | None:
    """Whether a text means yes or no; None where it means neither."""
    truth = _TRUTHS.get(text.strip())
    return None if truth is None else truth == "true"


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _numbers(text: str) -> list[float | None]:
    return [_number(word) for word in text.split()]


def _same(one: str, other: str) -> bool:
    numbers = _numbers(one)
    return (
        one == other
        or _TRUTHS.get(one, one) == _TRUTHS.get(other, other)
        or (bool(numbers) and None not in numbers and numbers == _numbers(other))
    )


def _is_harmless(text: str, harmless: Iterable[str]) -> bool:
    return any(_same(text, each) for each in harmless)


def _least(old: str, new: str) -> str:
    """The smaller of two rates; zero means as often as possible."""
    rates = {text: _number(text) or float("inf") for text in (old, new)}
    return new if rates[new] < rates[old] else old
