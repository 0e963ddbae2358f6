"""The controls of joints: a slider for each degree of freedom, poses, units, and all positions as text."""

import json
import math
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from itertools import groupby
from typing import Any, cast

from twinform.compiler.graph.graph import shortened
from twinform.compiler.kinematics import Degree, Positions
from twinform.compiler.scene import SceneJoint
from twinform.dataclass import dataclass
from twinform.view import words
from twinform.view.figure import Figure

_TURN, _WAY = math.pi, 1.0
"""How far sliders go where there are no limits: rad to both sides, and m."""
_BEYOND = 2
"""So many times as far they go where limits are ignored."""
_STEPS = 200
# The step of sliders in their unit, unless the whole range is too small for it.
_FINEST = 1e-3
_FARTHEST = 1e6
"""Positions beyond this, in rad or m, are not taken from text."""
_MOST_ROWS = 100
"""So many degrees of freedom have sliders; the page says how many more there are."""
Key = tuple[str, int]


@dataclass(slots=True)
class Choices:
    """The choices of a person, which stay when a file is shown again."""

    positions: dict[Key, float] = field(default_factory=dict[Key, float])
    shown: dict[str, bool] = field(default_factory=dict[str, bool])
    degrees: bool = False
    beyond: bool = False


@dataclass(frozen=True, slots=True)
class _Movable:
    """A degree of freedom that mimics no other one."""

    joint: SceneJoint
    number: int
    degree: Degree

    @property
    def key(self) -> Key:
        return self.joint.name, self.number

    @property
    def model(self) -> str:
        """The models around the joint, in a file with several; empty in one with a single robot."""
        return self.joint.name.rpartition("::")[0]

    @property
    def label(self) -> str:
        name = self.joint.name.rpartition("::")[2]
        return shortened(name if len(self.joint.degrees) == 1 else f"{name} ({self.number + 1})")


# The sliders are viser's own. `viser.extras.ViserUrdf` adds none, and reads URDF a second time, with yourdfpy; it knows
# no SDF.
@dataclass(slots=True)
class JointControls:
    """The sliders of all joints of some figures."""

    gui: Any
    figures: Sequence[Figure]
    choices: Choices
    _movable: list[_Movable] = field(default_factory=list[_Movable], init=False)
    _sliders: dict[Key, Any] = field(default_factory=dict[Key, Any], init=False)
    _rows: list[Any] = field(default_factory=list[Any], init=False)
    _folder: Any = field(default=None, init=False)
    _text: Any = field(default=None, init=False)

    def build(self) -> None:
        """Add all controls to the panel."""
        self._movable = list(_find_movable(self.figures))
        if not self._movable:
            self.gui.add_html(words.paragraph("No joint moves."))
            return
        self._add_poses()
        self._add_choice("Degrees", self.choices.degrees, self._show_degrees)
        self._add_choice("Ignore limits", self.choices.beyond, self._ignore_limits)
        self._folder = self.gui.add_folder(None)
        self._show_sliders()
        if len(self._movable) > _MOST_ROWS:
            self.gui.add_html(words.more(len(self._movable) - _MOST_ROWS, "joints"))
        with self.gui.add_folder("Positions as text", expand_by_default=False):
            self._add_text()

    def move(self, positions: Positions) -> None:
        """Move joints and their sliders to positions."""
        self._set_positions(positions)
        self._update_text()

    def _set_positions(self, positions: Positions) -> None:
        self.choices.positions |= positions
        for key, slider in self._sliders.items():
            if key in positions:
                slider.value = _clamp(positions[key] * self._units_per_si(key), slider.min, slider.max)
        for figure in self.figures:
            figure.move(self.choices.positions)

    def _units_per_si(self, key: Key) -> float:
        """Return how many of the displayed units are one rad or m."""
        slides = next(each.degree.slides for each in self._movable if each.key == key)
        return math.degrees(1) if self.choices.degrees and not slides else 1.0

    def _add_choice(self, label: str, value: bool, choose: Callable[[bool], None]) -> None:
        box = self.gui.add_checkbox(label, value)

        @box.on_update
        def _(event: object) -> None:
            del event
            choose(box.value)
            self._show_sliders()

    def _show_degrees(self, chosen: bool) -> None:
        self.choices.degrees = chosen

    def _ignore_limits(self, chosen: bool) -> None:
        self.choices.beyond = chosen

    def _add_poses(self) -> None:
        poses: Mapping[str, Callable[[Degree], float]] = {
            "Zero": lambda _: 0.0,
            "Middle": lambda degree: math.fsum(slider_range(degree)) / 2,
            "Random": lambda degree: random.uniform(*slider_range(degree)),  # noqa: S311 - no secret
        }
        group = self.gui.add_button_group("Pose", tuple(poses), hint="All joints to zero, half way, or anywhere")

        @group.on_click
        def _(event: object) -> None:
            del event
            choose = poses[group.value]
            self.move({each.key: _clamp(choose(each.degree), *slider_range(each.degree)) for each in self._movable})

    def _show_sliders(self) -> None:
        for row in self._rows:
            row.remove()
        self._sliders, self._rows = {}, []
        with self._folder:
            for model, movable in groupby(self._movable[:_MOST_ROWS], key=lambda each: each.model):
                self._rows.append(self.gui.add_folder(shortened(model) or None))
                with self._rows[-1]:
                    for each in movable:
                        self._add_row(each)

    def _add_row(self, movable: _Movable) -> None:
        lower, upper = slider_range(movable.degree, beyond=self.choices.beyond)
        if lower < upper:
            self._add_slider(movable)
            return
        self.choices.positions[movable.key] = lower
        value = lower * self._units_per_si(movable.key)
        self.gui.add_number(movable.label, value, disabled=True, hint="Locked: its limits are the same")

    def _add_slider(self, movable: _Movable) -> None:
        key, degree = movable.key, movable.degree
        unit = self._units_per_si(key)
        lower, upper = (each * unit for each in slider_range(degree, beyond=self.choices.beyond))
        position = _clamp(self.choices.positions.get(key, 0.0), lower / unit, upper / unit)
        self.choices.positions[key] = position
        slider = self.gui.add_slider(
            movable.label,
            lower,
            upper,
            min(_FINEST * max(1.0, unit), (upper - lower) / _STEPS),
            _clamp(position * unit, lower, upper),
            marks=tuple((each, f"{each:.4g}") for each in sorted({lower, _clamp(0.0, lower, upper), upper})),
            hint=_describe_range(movable, degrees=unit != 1.0),
        )
        self._sliders[key] = slider

        @slider.on_update
        def _(event: Any) -> None:
            if event.client is None:
                return  # it was put there by a program, which moves the joints itself
            self.choices.positions[key] = slider.value / unit
            for figure in self.figures:
                figure.move(self.choices.positions)
            self._update_text()

    def _add_text(self) -> None:
        """Add a field to copy all positions from, or to write them into."""
        self._text = self.gui.add_text(
            "JSON", self._format_positions(), multiline=True, hint="In rad and m, to copy or to write"
        )

        @self._text.on_update
        def _(event: Any) -> None:
            if event.client is not None:
                known = {each.key for each in self._movable}
                self._set_positions(
                    {key: value for key, value in positions_of(self._text.value).items() if key in known}
                )

    def _update_text(self) -> None:
        if self._text is not None:
            self._text.value = self._format_positions()

    def _format_positions(self) -> str:
        found: dict[str, list[float]] = {}
        for each in self._movable:
            found.setdefault(each.joint.name, []).append(round(self.choices.positions.get(each.key, 0.0), 6))
        return json.dumps({name: each[0] if len(each) == 1 else each for name, each in found.items()}, indent=1)


def positions_of(text: str) -> dict[Key, float]:
    """Return the positions in a text of JSON: numbers, or lists of numbers, by the names of joints."""
    try:
        found: object = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    if not isinstance(found, dict):
        return {}
    joints = cast("dict[str, object]", found)
    return {(name, number): each for name, value in joints.items() for number, each in enumerate(_find_numbers(value))}


def _find_numbers(value: object) -> Iterator[float]:
    several = cast("list[object]", value) if isinstance(value, list) else [value]
    for each in several:
        if isinstance(each, int | float) and abs(each) < _FARTHEST:
            yield float(each)


def slider_range(degree: Degree, *, beyond: bool = False) -> tuple[float, float]:
    """Return the ends of a slider in rad or m: the limits, or a fixed range to both sides if there are none.

    A joint whose limits are the same is locked: both ends are there. With `beyond` a slider ignores the limits and goes
    farther.
    """
    usual = _WAY if degree.slides else _TURN
    lower = degree.lower if math.isfinite(degree.lower) else -usual
    upper = degree.upper if math.isfinite(degree.upper) else usual
    if not math.isfinite(degree.lower) and upper <= lower:
        lower = upper - usual
    if lower > upper:
        lower, upper = min(lower, 0.0), max(upper, 0.0)
        if lower == upper:
            lower, upper = -usual, usual
    if beyond:
        return min(-_BEYOND * usual, lower - usual), max(_BEYOND * usual, upper + usual)
    return lower, upper


def _find_movable(figures: Sequence[Figure]) -> Iterator[_Movable]:
    """Yield the degrees of freedom of all joints; of two figures, the first that has a joint says how it moves."""
    known: set[str] = set()
    for figure in figures:
        for joint in figure.scene.joints:
            if joint.name not in known:
                known.add(joint.name)
                yield from (_Movable(joint, i, each) for i, each in enumerate(joint.degrees) if each.leader is None)


def _describe_range(movable: _Movable, *, degrees: bool) -> str:
    degree = movable.degree
    unit = "m" if degree.slides else "degrees" if degrees else "rad"
    limited = math.isfinite(degree.lower) or math.isfinite(degree.upper)
    return f"{movable.joint.type}, {unit}, {'within its limits' if limited else 'without limits'}"


def _clamp(value: float, lower: float, upper: float) -> float:
    return min(max(value, lower), upper)
