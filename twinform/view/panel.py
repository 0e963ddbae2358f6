"""The panel beside the 3D view: joints, layers, the tree, what was found, and the part that is looked at."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from twinform.compiler.compare.comparison import Comparison
from twinform.compiler.scene import Degree, Positions, SceneJoint
from twinform.view import words
from twinform.view.figure import MARK, Figure, Rgb
from twinform.view.layers import LAYERS
from twinform.view.names import shortened
from twinform.view.subject import Subject

_TURN, _WAY = math.pi, 1.0
"""How far sliders go where there are no limits: rad to both sides, and m."""
_STEPS = 200
_MOST_ROWS = 100
"""So many joints, findings or differences have controls of their own; the page says how many more there are."""
_DIFFERENT: Rgb = (220, 40, 40)


@dataclass(slots=True)
class Panel:
    """The controls of one or two figures."""

    gui: Any
    subjects: Sequence[Subject]
    figures: Sequence[Figure]
    comparison: Comparison | None = None
    positions: dict[tuple[str, int], float] = field(default_factory=dict[tuple[str, int], float])
    _part: Any = None
    _sliders: dict[tuple[str, int], Any] = field(default_factory=dict[tuple[str, int], Any])

    def build(self) -> None:
        """Put all controls into the panel."""
        self._part = self.gui.add_html(words.paragraph("Click a part of the robot to see what it is."))
        tabs = self.gui.add_tab_group()
        with tabs.add_tab("Joints"):
            self._joints()
        with tabs.add_tab("Show"):
            self._layers()
        with tabs.add_tab("Tree"):
            self._tree()
        if self.comparison is not None:
            with tabs.add_tab("Differences"):
                self._differences(self.comparison)
        with tabs.add_tab("Findings"):
            self._findings()

    def select(self, link: str, text: str = "") -> None:
        """Mark a link, and say what there is to know about it."""
        for figure in self.figures:
            figure.mark({link: MARK})
        self._part.content = text + "".join(words.part(link, subject) for subject in self.subjects)

    def move(self, positions: Positions) -> None:
        """Put joints to positions, and their sliders."""
        self.positions |= positions
        for key, slider in self._sliders.items():
            if key in positions:
                slider.value = min(max(positions[key], slider.min), slider.max)
        for figure in self.figures:
            figure.move(self.positions)

    def _joints(self) -> None:
        """A slider for each degree of freedom that follows no other."""
        moving = list(self._moving())
        shown = moving[:_MOST_ROWS]
        reset = self.gui.add_button("All joints to zero", disabled=not moving)
        for joint, number, degree in shown:
            self._slider(joint, number, degree)
        if len(moving) > len(shown):
            self.gui.add_html(words.more(len(moving) - len(shown), "joints"))
        if not moving:
            self.gui.add_html(words.paragraph("No joint moves."))

        @reset.on_click
        def _(event: object) -> None:
            del event
            for slider in self._sliders.values():
                slider.value = min(max(0.0, slider.min), slider.max)

    def _moving(self) -> Iterator[tuple[SceneJoint, int, Degree]]:
        """Each degree of freedom, by the names of joints; the first figure that has a joint says how it moves."""
        known: set[str] = set()
        for figure in self.figures:
            for joint in figure.scene.joints:
                if joint.name not in known:
                    known.add(joint.name)
                    yield from ((joint, i, each) for i, each in enumerate(joint.degrees) if each.leader is None)

    def _slider(self, joint: SceneJoint, number: int, degree: Degree) -> None:
        lower, upper = slider_range(degree)
        key = (joint.name, number)
        value = min(max(self.positions.get(key, 0.0), lower), upper)
        self.positions[key] = value
        label = shortened(joint.name if len(joint.degrees) == 1 else f"{joint.name} ({number + 1})")
        unit = "m" if degree.slides else "rad"
        step = (upper - lower) / _STEPS
        slider = self.gui.add_slider(label, lower, upper, step, value, hint=f"{joint.type}, {unit}")
        self._sliders[key] = slider

        @slider.on_update
        def _(event: object) -> None:
            del event
            self.positions[key] = slider.value
            for figure in self.figures:
                figure.move(self.positions)

    def _layers(self) -> None:
        if len(self.figures) > 1:
            self._arrangement()
        for layer in LAYERS:
            box = self.gui.add_checkbox(layer.label, layer.shown)
            for figure in self.figures:
                figure.show(layer.label, layer.draw, visible=layer.shown)

            @box.on_update
            def _(event: object, layer: Any = layer, box: Any = box) -> None:
                del event
                for figure in self.figures:
                    figure.show(layer.label, layer.draw, visible=box.value)

    def _arrangement(self) -> None:
        first, second = self.figures
        where = self.gui.add_dropdown("B is", ["over A", "beside A", "hidden"])

        @where.on_update
        def _(event: object) -> None:
            del event
            least, greatest = first.bounds()
            aside = 1.2 * float(greatest[1] - least[1]) + 0.05 * first.size
            second.place((0.0, -aside if where.value == "beside A" else 0.0, 0.0), visible=where.value != "hidden")

    def _tree(self) -> None:
        """The tree as text, and a field that finds a link in it."""
        links = [link.name for link in self.subjects[0].scene.links]
        labels = [f"{number}: {shortened(name)}" for number, name in enumerate(links)]
        if links:
            found = self.gui.add_dropdown("Look at", labels)

            @found.on_update
            def _(event: object) -> None:
                del event
                self.select(links[labels.index(found.value)])

        for subject in self.subjects:
            self.gui.add_html(words.tree(subject.scene))

    def _findings(self) -> None:
        self.gui.add_html(words.verdict(self.subjects))
        for subject in self.subjects:
            rows = subject.findings
            for found in rows[:_MOST_ROWS]:
                label = f"{found.severity}: {found.rule.name}, line {found.location.line}"
                self._row(label, words.finding(found), subject.link_at(found.location.path))
            if len(rows) > _MOST_ROWS:
                self.gui.add_html(words.more(len(rows) - _MOST_ROWS, "findings"))
        for figure in self.figures:
            for link, shape, problem in list(figure.problems())[:_MOST_ROWS]:
                self._row(f"not drawn: {shortened(shape.name or shape.role)}", words.paragraph(problem), link)

    def _differences(self, comparison: Comparison) -> None:
        self.gui.add_html(words.compared(comparison))
        for found in comparison.differences[:_MOST_ROWS]:
            label = shortened(f"{found.group} {found.name}: {found.aspect}")
            self._row(label, words.difference(found), self._moved(found.group, found.name))
        if len(comparison.differences) > _MOST_ROWS:
            self.gui.add_html(words.more(len(comparison.differences) - _MOST_ROWS, "differences"))

    def _moved(self, group: str, name: str) -> str | None:
        """The link that a difference is seen on."""
        if group in {"link", "kinematics"}:
            return name
        joints = {joint.name: joint for figure in self.figures for joint in figure.scene.joints}
        return joints[name].child if group == "joint" and name in joints else None

    def _row(self, label: str, text: str, link: str | None) -> None:
        button = self.gui.add_button(label, hint="Show it")
        self.gui.add_html(text)

        @button.on_click
        def _(event: object) -> None:
            del event
            if link is not None:
                self.select(link, text)

    def mark_differences(self) -> None:
        """Color what is different."""
        if self.comparison is None:
            return
        links = (self._moved(each.group, each.name) for each in self.comparison.differences)
        colors = dict.fromkeys((each for each in links if each is not None), _DIFFERENT)
        for figure in self.figures:
            figure.mark(colors)


def slider_range(degree: Degree) -> tuple[float, float]:
    """The ends of a slider, in rad or m: the limits, or a way to both sides; some way where both limits are one."""
    usual = _WAY if degree.slides else _TURN
    lower = degree.lower if math.isfinite(degree.lower) else -usual
    upper = degree.upper if math.isfinite(degree.upper) else usual
    if not math.isfinite(degree.lower) and upper <= lower:
        lower = upper - usual
    if lower >= upper:
        lower, upper = min(lower, 0.0), max(upper, 0.0)
    return (lower, upper) if lower < upper else (-usual, usual)
