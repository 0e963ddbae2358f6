"""The panel beside the 3D view: joints, layers, the tree, findings, and the selected part.

The mouse moves joints too: the joint above a part follows the point at which the part was grabbed.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager
from dataclasses import field
from itertools import groupby
from threading import RLock
from typing import Any

from twinform.compiler.compare.comparison import Comparison, Difference
from twinform.compiler.graph.graph import shortened
from twinform.compiler.kinematics import Degree, Positions
from twinform.compiler.scene import SceneJoint
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic
from twinform.ir import Vector3
from twinform.ir.transform import Transform, across, cross, dot, minus
from twinform.view import words
from twinform.view.figure import MARK, VIEWS, Figure, Handle, Rgb, aim
from twinform.view.joint_controls import Choices, JointControls, slider_range
from twinform.view.layers import COLORS, LAYERS, SKELETON, Layer
from twinform.view.measuring import Measuring
from twinform.view.subject import ViewSubject
from twinform.view.words import Mark, tree

_MOST_ROWS = 100
"""So many findings or differences have controls of their own; the page says how many more there are."""
_FEW_ROWS = 20
"""So many differences are open at first."""
# With a smaller share of shapes drawn, the skeleton is shown at first.
_FEW_DRAWN = 0.5


@dataclass(slots=True)
class Panel:
    """The controls of one or two figures, which stand on a grid.

    Events are handled in threads of viser: under the `lock`, and not after the panel has `ended`, since another one has
    taken its place.
    """

    gui: Any
    subjects: Sequence[ViewSubject]
    figures: Sequence[Figure]
    grid: Handle
    comparison: Comparison | None = None
    choices: Choices = field(default_factory=Choices)
    lock: AbstractContextManager[object] = field(default_factory=RLock)
    ended: bool = field(default=False, init=False)
    _joints: JointControls = field(init=False)
    _warning: Any = field(default=None, init=False)
    _part: Any = field(default=None, init=False)
    _page: Any = field(default=None, init=False)
    _selected: tuple[str, ...] = field(default=(), init=False)
    _colors: dict[str, Rgb] = field(default_factory=dict[str, Rgb], init=False)

    def build(self) -> None:
        """Add all controls to the panel."""
        if self.comparison is not None:
            self._colors = words.difference_colors(self.comparison, self.subjects)
        self._joints = JointControls(self.gui, self.figures, self.choices)
        self._page = self.gui.add_html("")
        self._warning = self.gui.add_html("")
        self._part = self.gui.add_html(words.welcome(self.subjects, MODIFIER))
        tabs = self.gui.add_tab_group()
        with tabs.add_tab("Joints"):
            self._joints.build()
        with tabs.add_tab("Show"):
            self._add_layers()
        with tabs.add_tab("Tree"):
            self._add_tree()
        if self.figures[0].scene.links:
            with tabs.add_tab("Measure"):
                Measuring(self.gui, self.figures[0], self.choices.positions).build()
        if self.comparison is not None:
            with tabs.add_tab("Differences"):
                self._add_differences(self.comparison)
        with tabs.add_tab("Findings"):
            self._add_findings()
        self._mark()

    def select(self, links: Iterable[str], text: str = "") -> None:
        """Mark links, and show what is known about them."""
        with self.lock:
            if self.ended:
                return
            self._selected = tuple(links)
            parts = (words.part(link, subject) for link in self._selected for subject in self.subjects)
            self._part.content = text + "".join(parts)
            self._mark()

    def warn(self, title: str, lines: Iterable[str]) -> None:
        """Show above all controls what has gone wrong."""
        self._warning.content = words.alert(title, lines)

    def move(self, positions: Positions) -> None:
        """Move joints and their sliders to positions."""
        self._joints.move(positions)

    def listen(self, figure: Figure, handle: Handle, link: str) -> None:
        """Select a link when its part is clicked, and move it when it is dragged."""

        @handle.on_click
        def _(event: object) -> None:
            del event
            self.select([link])

        Dragging(figure, self.choices.positions, self._drag).listen(handle, link)

    def _drag(self, joint: SceneJoint, degree: Degree, position: float) -> None:
        lower, upper = slider_range(degree, beyond=self.choices.beyond)
        self.move({(joint.name, 0): min(max(position, lower), upper)})

    def _mark(self) -> None:
        """Color what differs and what is selected."""
        for figure in self.figures:
            figure.mark(self._colors | dict.fromkeys(self._selected, MARK))
        self._update_page()

    def _update_page(self) -> None:
        labels = {name: text for figure in self.figures for name, text in figure.labels.items()}
        self._page.content = words.control(labels, self._selected, words.title(self.subjects))

    def _add_layers(self) -> None:
        if len(self.figures) > 1:
            self._add_arrangement()
        for layer in LAYERS:
            shown = layer.shown or (layer.label == SKELETON and _few_are_drawn(self.figures))
            box = self.gui.add_checkbox(layer.label, self.choices.shown.setdefault(layer.label, shown))
            for figure in self.figures:
                figure.show(layer.label, layer.draw, visible=box.value)

            @box.on_update
            def _(event: object, layer: Any = layer, box: Any = box) -> None:
                del event
                self._show_layer(layer, visible=box.value)

        self._add_grid()
        self._add_views()
        with self.gui.add_folder("Colors", expand_by_default=False):
            self.gui.add_html(words.legend(COLORS))

    def _add_views(self) -> None:
        group = self.gui.add_button_group("From", tuple(VIEWS), hint="Where the camera is")

        @group.on_click
        def _(event: Any) -> None:
            for camera in [event.client.camera] if event.client else []:
                aim(camera, self.figures, group.value)

    def _show_layer(self, layer: Layer, *, visible: bool) -> None:
        with self.lock:
            self.choices.shown[layer.label] = visible
            if self.ended:
                return
            for figure in self.figures:
                figure.show(layer.label, layer.draw, visible=visible)
            self._update_page()

    def _add_grid(self) -> None:
        has_ground = any(figure.has_ground for figure in self.figures)
        box = self.gui.add_checkbox("Grid", self.choices.shown.setdefault("Grid", not has_ground))
        self.grid.visible = box.value

        @box.on_update
        def _(event: object) -> None:
            del event
            self.choices.shown["Grid"] = self.grid.visible = box.value

    def _add_arrangement(self) -> None:
        first, second = self.figures
        where = self.gui.add_dropdown("B is", ["over A", "beside A", "hidden"])

        @where.on_update
        def _(event: object) -> None:
            del event
            least, greatest = first.bounds()
            aside = 1.2 * float(greatest[1] - least[1]) + 0.05 * first.size
            second.place((0.0, -aside if where.value == "beside A" else 0.0, 0.0), visible=where.value != "hidden")

    def _add_tree(self) -> None:
        """Add the trees, and a field that finds a link; a click on a row of a tree fills the field too."""
        found = self.gui.add_text("Find", "", hint="A link or joint, or the beginning of its name")

        @found.on_update
        def _(event: object) -> None:
            del event
            wanted = found.value.strip()
            if wanted:
                self._select_by_name(wanted)

        for subject, figure in zip(self.subjects, self.figures, strict=True):
            if figure.title:
                self.gui.add_html(words.paragraph(figure.title))
            self.gui.add_html(tree(subject.scene, self._find_marks(subject, figure)))

    def _select_by_name(self, wanted: str) -> None:
        names = {joint.name: joint.child for figure in self.figures for joint in figure.scene.joints}
        names |= {link: link for subject in self.subjects for link in subject.links}
        ranks = {name: rank for name in names if (rank := _rank_name(wanted, name)) is not None}
        if ranks:
            self.select([names[min(ranks, key=lambda name: (ranks[name], len(name)))]])

    def _find_marks(self, subject: ViewSubject, figure: Figure) -> dict[str, list[Mark]]:
        """Return the marks of links in the tree."""
        marks: dict[str, list[Mark]] = {}
        for link, about in subject.about.items():
            marks[link] = [words.mark(each) for each in about if isinstance(each, Diagnostic)]
        for link, _, problem in figure.problems():
            marks.setdefault(link, []).append(Mark("\N{WHITE SQUARE}", words.css(MARK), problem))
        for link, color in self._colors.items():
            marks.setdefault(link, []).append(Mark("\N{NOT EQUAL TO}", words.css(color), "differs"))
        return marks

    def _add_findings(self) -> None:
        self.gui.add_html(words.verdict(self.subjects))
        for subject in self.subjects:
            rows = sorted(subject.findings, key=words.severity_rank)
            for found in rows[:_MOST_ROWS]:
                label = f"{found.severity}: {found.rule.name}, {words.place(found)}"
                color = words.severity_color(found)
                self._add_row(label, words.finding(found), subject.links_at(found.location), color)
            if len(rows) > _MOST_ROWS:
                self.gui.add_html(words.more(len(rows) - _MOST_ROWS, "findings"))
        for figure in self.figures:
            for link, shape, problem in list(figure.problems())[:_MOST_ROWS]:
                self._add_row(
                    f"not drawn: {shortened(shape.name or shape.role)}", words.paragraph(problem), [link], MARK
                )

    def _add_differences(self, comparison: Comparison) -> None:
        self.gui.add_html(words.compared(comparison))
        few = len(comparison.counted) <= _FEW_ROWS
        for group, rows in groupby(comparison.counted[:_MOST_ROWS], key=lambda each: (each.group, each.name)):
            found = list(rows)
            label = shortened(" ".join(filter(None, group)))
            with self.gui.add_folder(f"{label} ({len(found)})", expand_by_default=few):
                for each in found:
                    self._add_difference(each)
        if len(comparison.counted) > _MOST_ROWS:
            self.gui.add_html(words.more(len(comparison.counted) - _MOST_ROWS, "differences"))

    def _add_difference(self, found: Difference) -> None:
        links = words.links_of(found, self.subjects)
        color = next((self._colors[link] for link in links if link in self._colors), words.QUIET)
        self._add_row(shortened(found.aspect or found.group), words.difference(found), links, color)

    def _add_row(self, label: str, text: str, links: Sequence[str], color: Rgb) -> None:
        if not links:
            self.gui.add_html(words.heading(label, color) + text)
            return
        button = self.gui.add_button(label, hint="Show the part that it is about", color=color)
        self.gui.add_html(text)

        @button.on_click
        def _(event: object) -> None:
            del event
            self.select(links, text)


def _few_are_drawn(figures: Sequence[Figure]) -> bool:
    """Return whether so few shapes can be drawn that nobody would recognize the robot."""
    every = [figure.triangles(shape) for figure in figures for _, _, shape in figure.shapes("visual")]
    return sum(not each.problem for each in every) <= _FEW_DRAWN * len(every)


def _rank_name(wanted: str, name: str) -> int | None:
    """Return how well a name matches, 0 at best; None if it does not match."""
    low, part = name.lower(), wanted.lower()
    if name == wanted:
        return 0
    return 1 if low.startswith(part) else 2 if part in low else None


MODIFIER = "shift"
"""The key to hold: without it the mouse turns the camera."""


@dataclass(slots=True)
class Drag:
    """A joint that is being moved: its axis, and the point where the part was grabbed, in the frame of the scene."""

    joint: SceneJoint
    axis: Vector3
    center: Vector3
    grip: Vector3
    position: float

    def position_at(self, pointer: Vector3) -> float:
        """Return the position in rad or m that brings the grip nearest to a point, at most half a turn away."""
        if self.joint.degrees[0].slides:
            return self.position + dot(self.axis, minus(pointer, self.grip))
        start, end = (across(self.axis, minus(each, self.center)) for each in (self.grip, pointer))
        # The angle is taken about the axis as it was when the drag began: computing it anew from
        # each message would lag behind what the browser shows, and the joint would swing.
        return self.position + math.atan2(dot(self.axis, cross(start, end)), dot(start, end))


def drag_of(figure: Figure, link: str, grip: Vector3, positions: Positions) -> Drag | None:
    """Return a drag of the nearest joint above a link that has one axis of its own; None if there is none."""
    kinematics = figure.kinematics
    while link in kinematics.hung:
        joint = kinematics.hung[link]
        if len(joint.degrees) == 1 and joint.degrees[0].leader is None:
            moved = _find_motion(figure, joint.parent)
            axis, center = moved.rotate(joint.degrees[0].axis), moved.apply(joint.frame.translation)
            return Drag(joint, axis, center, grip, kinematics.position(joint.name, 0, positions))
        link = joint.parent
    return None


def _find_motion(figure: Figure, link: str) -> Transform:
    """Return how a link has moved from its frame with all joints at zero."""
    pose = figure.poses.get(link)
    return pose.compose(figure.from_world(link)) if pose else Transform()


@dataclass(slots=True)
class Dragging:
    """The drags of one figure; `move` moves a joint to a position, within its limits."""

    figure: Figure
    positions: Positions
    move: Callable[[SceneJoint, Degree, float], None]
    _drag: Drag | None = field(default=None, init=False)

    def listen(self, handle: Any, link: str) -> None:
        """Move the joint above a link when a part of the link is dragged."""

        # Without the key, a drag turns the camera: a robot often fills the picture, and then there
        # would be nowhere to take it.
        @handle.on_drag("left", modifier=MODIFIER)
        async def _(event: Any) -> None:  # async: else updates may come before the start
            if event.phase == "start":
                self._drag = drag_of(self.figure, link, self._in_figure(event.start_position), self.positions)
            if self._drag is not None:
                drag = self._drag
                self.move(drag.joint, drag.joint.degrees[0], drag.position_at(self._in_figure(event.end_position)))
            if event.phase == "end":
                self._drag = None

    def _in_figure(self, point: Vector3) -> Vector3:
        """Return a point of the page in the frame of the figure, which may stand beside another one."""
        x, y, z = (float(each) for each in self.figure.base.position)
        return minus(point, (x, y, z))
