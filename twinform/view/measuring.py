"""The tab that measures: how far links are from each other, and what joints have to hold against gravity."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from twinform.compiler.graph.graph import shortened
from twinform.compiler.kinematics import Degree, Positions
from twinform.dataclass import dataclass
from twinform.ir.defaults import GRAVITY
from twinform.ir.transform import Transform
from twinform.view import words
from twinform.view.figure import Figure
from twinform.view.joint_controls import Key, slider_range

_SAMPLES = 31
_MOST_LINKS = 60
"""With more links than these the curve is drawn anew for another joint, and not with each motion."""
_STEP = 1e-5
"""Half of the way over which the energy is differentiated, rad or m."""
_CURVE = """<svg viewBox="-12 -16 320 150" role="img" aria-label="{label}" style="margin:0.5em;width:90%">
<path d="M0 {zero:.1f}H300" stroke="gray" stroke-width="1"/>
<polyline points="{points}" fill="none" stroke="rgb(200, 90, 30)" stroke-width="2"/>
<g fill="currentColor" font-size="11"><text x="0" y="-5">{label}</text>
<text x="0" y="128">{lower:.4g}</text><text x="300" y="128" text-anchor="end">{upper:.4g}</text></g></svg>"""


def lines_between(first: Transform, second: Transform) -> Iterable[str]:
    """Yield how far a frame is from another one, and where it is and how it is turned in that one."""
    between = first.inverse().compose(second)
    yield f"distance {math.hypot(*between.translation):.4g} m"
    yield f"xyz {_numbers(between.translation)} m"
    yield f"rpy {_numbers(map(math.degrees, between.rpy()))} degrees"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(f"{round(each, 6) + 0.0:.4g}" for each in values)


def gravity_effort(figure: Figure, joint: Key, positions: Positions) -> float:
    """Return the effort, in N m or N, with which a joint holds what it carries: how its potential energy grows."""

    def energy(position: float) -> float:
        poses = figure.kinematics.poses({**positions, joint: position})
        solids = ((link.mass, poses[link.name]) for link in figure.scene.links if link.mass)
        return sum(GRAVITY * mass.mass * pose.apply(mass.center)[2] for mass, pose in solids)

    at = positions.get(joint, 0.0)
    return (energy(at + _STEP) - energy(at - _STEP)) / (2 * _STEP)


def curve(positions: Sequence[float], efforts: Sequence[float]) -> str:
    """Return the efforts over the positions as a picture in HTML."""
    # viser's own plots stay empty where they are made in a tab that is not open.
    low, high = min(0.0, *efforts), max(0.0, *efforts)
    lower, upper = positions[0], positions[-1]
    heights = [110 * (high - each) / ((high - low) or 1.0) for each in (0.0, *efforts)]
    points = " ".join(
        f"{300 * (at - lower) / (upper - lower):.1f},{height:.1f}"
        for at, height in zip(positions, heights[1:], strict=True)
    )
    label = f"from {_numbers([min(efforts)])} to {_numbers([max(efforts)])}"
    return _CURVE.format(label=label, zero=heights[0], points=points, lower=lower, upper=upper)


@dataclass(slots=True)
class Measuring:
    """The controls of the tab; joints are where `positions` say, and follow what moves them."""

    gui: Any
    figure: Figure
    positions: Positions

    def build(self) -> None:
        """Add all controls to the panel."""
        links = [link.name for link in self.figure.scene.links]
        if len(links) > 1:
            self._add_distance(links)
        joints = {
            joint.name: degree
            for joint in self.figure.scene.joints
            for degree in joint.degrees[:1]
            if degree.leader is None and slider_range(degree)[0] < slider_range(degree)[1]
        }
        if joints and any(link.mass for link in self.figure.scene.links):
            self._add_efforts(joints)

    def _keep_current(self, controls: Iterable[Any], update: Callable[[], None]) -> None:
        """Run an update now, when a control is changed and when a joint is moved."""

        def changed(event: object) -> None:
            del event
            update()

        for control in controls:
            control.on_update(changed)
        self.figure.watchers.append(update)
        update()

    def _add_distance(self, links: Sequence[str]) -> None:
        names = {shortened(name): name for name in links}
        first = self.gui.add_dropdown("From", tuple(names), initial_value=next(iter(names)))
        second = self.gui.add_dropdown("To", tuple(names), initial_value=list(names)[-1])
        said = self.gui.add_html("")

        def update() -> None:
            a, b = (self.figure.poses[names[each.value]] for each in (first, second))
            said.content = "".join(map(words.paragraph, lines_between(a, b)))

        self._keep_current((first, second), update)

    def _add_efforts(self, joints: Mapping[str, Degree]) -> None:
        names = {shortened(name): name for name in joints}
        chosen = self.gui.add_dropdown(
            "Effort of", tuple(names), hint="What it holds against gravity where it is moved"
        )
        said = self.gui.add_html("")
        plot = self.gui.add_html("")
        plotted: list[Key] = []

        def update() -> None:
            key = (names[chosen.value], 0)
            degree, here = joints[key[0]], gravity_effort(self.figure, key, self.positions)
            said.content = words.paragraph(f"it holds {here:.4g} {'N' if degree.slides else 'N m'} here")
            if len(self.figure.scene.links) > _MOST_LINKS and plotted == [key]:
                return
            plotted[:] = [key]
            lower, upper = slider_range(degree)
            positions = [lower + (upper - lower) * number / (_SAMPLES - 1) for number in range(_SAMPLES)]
            efforts = [gravity_effort(self.figure, key, {**self.positions, key: each}) for each in positions]
            plot.content = curve(positions, efforts)

        self._keep_current((chosen,), update)
