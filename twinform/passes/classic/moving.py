"""Moves parameters of Gazebo Classic plugins to what gz-sim reads, such as `camera/clip/near`, and reports it."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import field
from math import isfinite, pi, tan

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import Element, Plugin
from twinform.passes.classic.tables import Caveat, Migration, Move, Moves
from twinform.passes.plugins.sites import PluginSite, plugin_element
from twinform.schemas import format_value

_TRUTH_OF = {"true": "true", "True": "true", "1": "true", "false": "false", "False": "false", "0": "false"}
_FIELD_OF_VIEW = 1.047
"""The default of SDF for the field of view of a camera, in rad."""
# The default time in s over which a bias wanders: that of hector_gazebo's sensor models.
_DRIFT_TIME = "3600"


@dataclass(frozen=True, slots=True)
class DroppedParameter:
    """A parameter that has no counterpart, and why; `harmless` if its value makes no difference."""

    parameter: Element
    reason: str
    harmless: bool = False


@dataclass(slots=True)
class Moved:
    """The element into which parameters were moved, and the parameters that have no counterpart.

    Values at a path that `repeats` stand beside each other; elsewhere the first one stays. `is_valid` says whether the
    element is still valid; a parameter that makes it invalid is dropped.
    """

    element: Element
    repeats: Callable[[str], bool] = lambda _: False
    is_valid: Callable[[Element], bool] = lambda _: True
    moved: set[str] = field(default_factory=set[str])
    lost: list[DroppedParameter] = field(default_factory=list[DroppedParameter])
    frame: str | None = None
    offsets: dict[str, str] = field(default_factory=dict[str, str])

    def apply(self, parameters: Iterable[Element], moves: Moves) -> None:
        """Move the parameters that the table knows; others are not touched."""
        for parameter in parameters:
            move = moves.get(parameter.name)
            if move is not None:
                before = self.element
                self._move(parameter, move)
                self.moved.add(parameter.name)
                # One bad value (`<updateRate>$(arg rate)</updateRate>`) must not cost the whole
                # sensor: the step is taken back and the parameter reported.
                if self.element is not before and not self.is_valid(self.element):
                    self.element = before
                    self.lost.append(DroppedParameter(parameter, f"{parameter.text!r} is no value for it"))

    def _move(self, parameter: Element, move: Move) -> None:
        text = (parameter.text or "").strip()
        if any(_is_same_value(text, each) for each in move.harmless):
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
            self.element = add_child(self.element, parameter.copy(name=move.to or parameter.name))
        else:
            self._write_all(parameter, text, move)

    def _choose(self, parameter: Element, text: str, move: Move) -> None:
        choices = move.choose or {}
        chosen = choices.get(text, choices.get(_TRUTH_OF.get(text, text)))
        if chosen is None:
            self.lost.append(DroppedParameter(parameter, f"{text!r} is none of {', '.join(choices)}"))
            return
        for path, value in chosen.items():
            self.element = set_text(self.element, path, value)

    def _write_all(self, parameter: Element, text: str, move: Move) -> None:
        for part in text.split(move.split) if move.split else [text]:
            for path, value in self._values(part.strip(), move):
                self._write(parameter, path, value, move)
        for path, value in move.also.items():
            if text_at(self.element, path) is None:
                self.element = set_text(self.element, path, value)

    def _values(self, text: str, move: Move) -> Iterator[tuple[str, str]]:
        if move.each:
            numbers = text.split()
            # One number for all three axes, as hector_gazebo's sensor models take it.
            many = numbers if len(numbers) == len(move.each) else numbers[:1] * len(move.each)
            yield from zip(move.each, many, strict=False)
            return
        value = text.strip("/") if move.bare else self._scale(text, move)
        for path in (move.to or "", *move.same):
            yield path, value
        if move.mirror and (number := _parse_number(value)) is not None:
            yield move.mirror, format_value(-number)

    def _scale(self, text: str, move: Move) -> str:
        number, factor = _parse_number(text), move.scale
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
            value = _lower_rate(old, value)
        elif old is not None and self.repeats(path):
            self.element = add_child(self.element, Element(name=path, text=value))
            return
        # Settings of the sensor count more than what its plugin repeats (ranges, clips, fields of
        # view); the plugin's value that differs is reported.
        elif old is not None:
            if not _is_same_value(old, value):
                self.lost.append(DroppedParameter(parameter, f"the {self.element.name} itself has {path} {old}"))
            return
        self.element = set_text(self.element, path, value)
        if move.noise:
            self._make_noise(path.rpartition("/")[0], move)

    def _keep_offset(self, parameter: Element, name: str, value: str) -> None:
        numbers = _parse_numbers(value)
        if len(numbers) == len("xyz") and all(number is not None and isfinite(number) for number in numbers):
            self.offsets[name] = value
        else:
            self.lost.append(DroppedParameter(parameter, f"{value!r} is not three numbers"))

    def _make_noise(self, noise: str, move: Move) -> None:
        self.element = set_text(self.element, f"{noise}/@type", "gaussian")
        beside = {"mean": "0", "stddev": "0"}
        if move.drifts:
            beside["dynamic_bias_correlation_time"] = _DRIFT_TIME
        for name, value in beside.items():
            if text_at(self.element, f"{noise}/{name}") is None:
                self.element = set_text(self.element, f"{noise}/{name}", value)


def focal_length(sensor: Element) -> float:
    """The focal length of a camera in pixels, from its field of view and the width of its images."""
    fov = _parse_number(text_at(sensor, "camera/horizontal_fov") or "") or _FIELD_OF_VIEW
    fov = fov if 0 < fov < pi else _FIELD_OF_VIEW
    return camera_width(sensor) / (2 * tan(fov / 2))


def camera_width(sensor: Element) -> float:
    """The width of a camera's images in pixels."""
    return _parse_number(text_at(sensor, "camera/image/width") or "") or 320.0


def camera_height(sensor: Element) -> float:
    """The height of a camera's images in pixels."""
    return _parse_number(text_at(sensor, "camera/image/height") or "") or 240.0


def truth_of(text: str) -> bool | None:
    """Whether a text means true or false; None if it means neither."""
    truth = _TRUTH_OF.get(text.strip())
    return None if truth is None else truth == "true"


def _parse_number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _parse_numbers(text: str) -> list[float | None]:
    return [_parse_number(word) for word in text.split()]


def _is_same_value(one: str, other: str) -> bool:
    numbers = _parse_numbers(one)
    return (
        one == other
        or _TRUTH_OF.get(one, one) == _TRUTH_OF.get(other, other)
        or (bool(numbers) and None not in numbers and numbers == _parse_numbers(other))
    )


def _lower_rate(old: str, new: str) -> str:
    """The lower of two rates; zero means as often as possible."""
    rates = {text: _parse_number(text) or float("inf") for text in (old, new)}
    return new if rates[new] < rates[old] else old


def text_at(element: Element, path: str) -> str | None:
    """The text of an element or attribute at a path; None if there is none."""
    *steps, last = path.split("/")
    here: Element | None = element
    for step in steps:
        here = here.find(step) if here is not None else None
    if here is None:
        return None
    if last.startswith("@"):
        return here.get(last[1:])
    found = here.find(last)
    return found.text if found is not None else None


def set_text(element: Element, path: str, text: str) -> Element:
    """The element with a text at a path; missing elements on the path are made."""
    step, _, rest = path.partition("/")
    if step.startswith("@"):
        others = tuple(each for each in element.attributes if each[0] != step[1:])
        return element.copy(attributes=(*others, (step[1:], text)))
    child = element.find(step) or Element(name=step)
    new = set_text(child, rest, text) if rest else child.copy(text=text)
    return replace_child(element, child, new)


def replace_child(element: Element, old: Element, new: Element) -> Element:
    """The element with one child in place of another; the child is appended if the other is not there."""
    return element.exchange(old, new) if any(child is old for child in element.children) else add_child(element, new)


def add_child(element: Element, child: Element) -> Element:
    """The element with one more child."""
    return element.copy(children=(*element.children, child))


def trial_sink(sink: DiagnosticSink) -> DiagnosticSink:
    """A sink for findings about something that may fail, to be accepted if it does not."""
    return DiagnosticSink(sink.file, sink.strict, origins=sink.origins)


def accept_trial(sink: DiagnosticSink, tried: DiagnosticSink) -> None:
    """Take over the findings and ledger entries of a trial."""
    sink.diagnostics.extend(tried.diagnostics)
    sink.entries.extend(tried.entries)
    sink.has_errors = sink.has_errors or tried.has_errors


@dataclass(frozen=True, slots=True)
class MigrationReport:
    """Reports at the location of a plugin."""

    sink: DiagnosticSink
    plugin: Plugin
    site: PluginSite

    @property
    def where(self) -> Location:
        """The location of the plugin; if a pass has made it, that of its holder."""
        if self.plugin.source:
            return self.plugin.location
        holder = self.site.sensor or self.site.model or self.site.world
        return holder.location if holder else self.plugin.location

    @property
    def what(self) -> str:
        """The plugin as a part of a sentence."""
        return f"plugin {self.plugin.name!r} of {self.plugin.filename}"

    def migrated(self, became: str, lost: Iterable[DroppedParameter]) -> None:
        """Report what the plugin became, and which parameters have no counterpart."""
        self._account(f"{self.what} became {became}", lost)

    def needless(self, reason: str, lost: Iterable[DroppedParameter]) -> None:
        """Report that gz-sim does not need the plugin."""
        self._account(f"{self.what} is not needed: {reason}", lost)

    def _account(self, message: str, lost: Iterable[DroppedParameter]) -> None:
        self.sink.report(rules.MIGRATED_PLUGIN, message, self.where, found=self.plugin.filename)
        # The ledger counts elements and attributes of the source: what each lost parameter weighs
        # is taken off, so that nothing is counted twice.
        weight = plugin_element(self.plugin).weight
        for each in lost:
            weight -= each.parameter.weight
            self._report_lost(each)
        self.sink.account(Fate.APPROXIMATED, rules.MIGRATED_PLUGIN, message, self.where, max(weight, 0))

    def without(self, reason: str, *, keeps: bool) -> None:
        """Report that the plugin has no counterpart, and why."""
        end = "it is kept" if keeps else "it is left out"
        message = f"{self.what} has no counterpart in gz-sim, so {end}: {reason}"
        self.sink.report(rules.PLUGIN_WITHOUT_COUNTERPART, message, self.where, found=self.plugin.filename)
        if not keeps:
            weight = plugin_element(self.plugin).weight
            self.sink.account(Fate.DROPPED, rules.PLUGIN_WITHOUT_COUNTERPART, message, self.where, weight)

    def renamed(self, modern: Plugin) -> None:
        """Report the current name of the plugin."""
        message = f"{self.what} is called {modern.filename} now"
        if modern.filename == self.plugin.filename:
            message = f"{self.what} uses the current names of its parameters"
        self.sink.report(rules.IGNITION_NAME, message, self.where, found=self.plugin.filename)
        weight = plugin_element(self.plugin).weight
        self.sink.account(Fate.APPROXIMATED, rules.IGNITION_NAME, message, self.where, weight)

    def missing(self, what: str) -> None:
        """Report what the author has to add."""
        message = f"{self.what} was migrated, but {what}"
        self.sink.report(rules.INCOMPLETE_MIGRATION, message, self.where, found=self.plugin.filename)

    def _report_lost(self, lost: DroppedParameter) -> None:
        parameter, where = lost.parameter, self._location_of(lost.parameter)
        message = f"<{parameter.name}> of {self.what} has no counterpart: {lost.reason}"
        if not lost.harmless:
            found = parameter.text
            self.sink.report(rules.PARAMETER_WITHOUT_COUNTERPART, message, where, found=found)
        self.sink.account(Fate.DROPPED, rules.PARAMETER_WITHOUT_COUNTERPART, message, where, parameter.weight)

    def _location_of(self, parameter: Element) -> Location:
        return parameter.location if parameter.source else self.where


def needed_checks(migration: Migration, plugin: Plugin, sensor: str | None = None) -> Iterator[str]:
    """What the author has to add or to know after a migration; `sensor` is the type that the plugin became."""
    if migration.geometry:
        yield migration.geometry
    for caveat in migration.caveats:
        if caveat.type in {None, sensor} and _caveat_applies(caveat, plugin):
            yield caveat.text


def _caveat_applies(caveat: Caveat, plugin: Plugin) -> bool:
    written = {child.name: child.text or "" for child in plugin.content}
    if any(name in written for name in caveat.unless):
        return False
    return not caveat.where or any(truth_of(written.get(name, "")) for name in caveat.where)
