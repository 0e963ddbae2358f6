"""Checking the parameters of a plugin against those of its system: names, counts, types of values, references, topics.

gz-transport accepts some topic names, and Gazebo makes others of the rest; patterns of topics have placeholders.
"""

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, Location, Severity, rules
from twinform.ir import Element, Model, Plugin
from twinform.ir.scopes import scoped_models
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.catalog import modern_class, suggestion
from twinform.passes.plugins.catalog_types import PluginKind, PluginParameter
from twinform.passes.shared.gazebo_tags import TRUE
from twinform.schemas import parse_value

# Characters that gz-transport accepts in no topic.
_NOT_IN_TOPICS = ("@", ":=", "//", "~")
_TRUTHS = frozenset({"true", "false", "0", "1"})


class ModelNames:
    """The names of joints and links of models, each model searched once."""

    def __init__(self) -> None:
        self._known: dict[tuple[int, str], set[str] | None] = {}

    def of(self, model: Model, kind: str) -> set[str] | None:
        """The names in a model; None where they are not all known."""
        key = (id(model), kind)
        if key not in self._known:
            self._known[key] = names_in(model, kind)
        return self._known[key]


class ParameterContext(NamedTuple):
    """What a plugin is compared with: its kind, the release (None for any), and the model whose parts it names."""

    kind: PluginKind
    release: str | None
    model: Model | None
    names: ModelNames
    sink: DiagnosticSink


def check_parameters(plugin: Plugin, context: ParameterContext) -> None:
    """Report mistakes in the parameters of a plugin."""
    _check_elements(plugin.content, context.kind.parameters, context, plugin.location)


def names_in(model: Model, kind: str) -> set[str] | None:
    """The names of the joints or links of a model, scoped names for those in nested models.

    None where includes that were not read may add more.
    """
    names = set[str]()
    for scope, inner in scoped_models(model):
        if any(include.merge for include in inner.includes):
            return None
        names.update(f"{scope}{each.name}" for each in (inner.joints if kind == "joint" else inner.links))
    return names


def _check_elements(
    elements: Sequence[Element], rows: tuple[PluginParameter, ...], context: ParameterContext, where: Location
) -> None:
    counts = Counter[str]()
    for element in elements:
        if _is_foreign(element.name):
            continue
        at = element.location if element.source else where
        row = next((each for each in rows if each.matches(element.name)), None)
        if row is None and context.kind.free:
            continue
        if row is None or (context.release and context.release not in row.releases):
            _report_unknown(element.name, row, rows, context, at)
            continue
        counts[element.name] += 1
        if counts[element.name] > 1 and not row.is_many:
            message = f"<{element.name}> occurs twice; {_short_name(context.kind)} reads the first"
            context.sink.report(rules.PLUGIN_PARAMETER_COUNT, message, at, found=element.name)
        _check_element(element, row, context, at)
    present, on = {*counts}, {each.name for each in elements if (each.text or "").strip().lower() in TRUE}
    for row in rows:
        if (
            (_is_needed(row, context) or row.beside in on)
            and not row.is_attribute
            and not any(row.matches(name) for name in present)
        ):
            message = f"{_short_name(context.kind)} needs <{row.name}>"
            context.sink.report(rules.PLUGIN_PARAMETER_COUNT, message, where, expected=row.name)


def _is_needed(row: PluginParameter, context: ParameterContext) -> bool:
    """Whether a plugin does not work without a parameter in the release, or else in any that has the plugin."""
    releases = (context.release,) if context.release else context.kind.releases
    return all(map(row.is_required_in, releases))


def _is_foreign(name: str) -> bool:
    """Whether a name has a prefix, so that it is for another program."""
    return name.startswith("{") or ":" in name


def _check_element(element: Element, row: PluginParameter, context: ParameterContext, at: Location) -> None:
    if row.free:
        return
    _check_attributes(element, row, context, at)
    if row.type == "element":
        _check_elements(element.children, row.children, context, at)
    else:
        _check_value(row, element.text or "", f"<{element.name}>", context, at)


def _check_attributes(element: Element, row: PluginParameter, context: ParameterContext, at: Location) -> None:
    rows = {each.name[1:]: each for each in row.children if each.is_attribute}
    for name, value in element.attributes:
        if _is_foreign(name):
            continue
        found = rows.get(name)
        if found is None:
            _report_unknown(f"@{name}", None, tuple(rows.values()), context, at)
        else:
            _check_value(found, value, f"{name!r} of <{element.name}>", context, at)
    for name, each in rows.items():
        if each.is_required and element.get(name) is None:
            message = f"{_short_name(context.kind)} needs {name!r} of <{element.name}>"
            context.sink.report(rules.PLUGIN_PARAMETER_COUNT, message, at, expected=name)


def _check_value(row: PluginParameter, text: str, what: str, context: ParameterContext, at: Location) -> None:
    problem = problem_of(row, text)
    if problem:
        message = f"{what} of {_short_name(context.kind)} is {text!r}, and has to be {problem}"
        context.sink.report(rules.PLUGIN_PARAMETER_VALUE, message, at, found=text, expected=problem)
        return
    if row.type in {"joint", "link"} and context.model is not None:
        _check_reference(row.type, text.strip(), what, context, at)


def _check_reference(kind: str, name: str, what: str, context: ParameterContext, at: Location) -> None:
    known = context.names.of(context.model, kind) if context.model else None
    if known is None or name in known or (context.model and context.model.includes and "::" in name):
        return
    message = f"{what} of {_short_name(context.kind)} names {name!r}, and the model has no such {kind}"
    context.sink.report(rules.PLUGIN_REFERENCE, message, at, found=name, help=suggestion(name, sorted(known)))


def _report_unknown(
    name: str, row: PluginParameter | None, rows: Sequence[PluginParameter], context: ParameterContext, at: Location
) -> None:
    called = f"<{name}>" if not name.startswith("@") else f"the attribute {name[1:]!r}"
    if row is not None and context.release:
        message = f"{_short_name(context.kind)} does not read {called} in {context.release}"
    else:
        message = f"{_short_name(context.kind)} does not read {called}"
    read = [each for each in rows if not context.release or context.release in each.releases]
    readable = [each.name for each in read if "[" not in each.name]
    help_ = suggestion(name, readable)
    # Whoever asks about a release wants to know all; elsewhere, what is no typo is mostly of another version.
    severity = None if help_ or context.release else Severity.INFO
    found = name.lstrip("@")
    context.sink.report(rules.UNKNOWN_PLUGIN_PARAMETER, message, at, found=found, help=help_, severity=severity)


def _short_name(kind: PluginKind) -> str:
    return kind.class_name.rsplit("::", 1)[-1]


def problem_of(row: PluginParameter, text: str) -> str | None:
    """What a parameter has to be if its text is wrong, as the end of a sentence; None if the text is right."""
    value = text.strip()
    if row.choices and value not in row.choices:
        return f"one of {', '.join(row.choices)}"
    fits, expected = _TYPES.get(row.type, (_is_not_empty, "text"))
    return None if fits(value) else expected


def _is_not_empty(text: str) -> bool:
    return bool(text)


def _is_of_type(type_: str) -> Callable[[str], bool]:
    def fits(text: str) -> bool:
        try:
            parse_value(type_, text)
        except ValueError:
            return False
        return True

    return fits


def _are_numbers(*counts: int) -> Callable[[str], bool]:
    is_number = _is_of_type("double")

    def fits(text: str) -> bool:
        words = text.split()
        return (len(words) in counts if counts else bool(words)) and all(map(is_number, words))

    return fits


def is_topic(text: str) -> bool:
    """Whether gz-transport accepts a text as the name of a topic."""
    return bool(text) and not any(map(str.isspace, text)) and not any(part in text for part in _NOT_IN_TOPICS)


def _is_truth(text: str) -> bool:
    return text.lower() in _TRUTHS


_TYPES: dict[str, tuple[Callable[[str], bool], str]] = {
    "number": (_is_of_type("double"), "a number"),
    "integer": (_is_of_type("int"), "a whole number"),
    "bool": (_is_truth, "true or false"),
    "vector": (_are_numbers(3), "three numbers"),
    "numbers": (_are_numbers(), "numbers"),
    "pose": (_are_numbers(6, 7), "a pose: six numbers"),
    "color": (_are_numbers(3, 4), "a color: three or four numbers"),
    "topic": (is_topic, "a topic, without blanks and `@`, `~`, `:=`, `//`"),
    "joint": (_is_not_empty, "the name of a joint"),
    "link": (_is_not_empty, "the name of a link"),
    "collision": (_is_not_empty, "the name of a collision"),
    "text": (lambda _: True, "text"),
    "element": (lambda _: True, "elements"),
}


_REMOVED = lazy_pattern("@|~|//|:=")
_REFUSED = (" ", *_REMOVED.pattern.split("|"))
_LONGEST = 65535
_PLACE = lazy_pattern(r"\{([^{}]++)\}")
"""A placeholder: names of values, of which the first that is known is taken."""
_PIECE = lazy_pattern(r"\(([^()]++)\)")
_CHOICE = lazy_pattern(r"\|(?![^{}]{0,100}+\})")
"""Separates the texts of a piece, of which the first that can become a topic is taken; braces are short."""


def is_valid_topic(name: str) -> bool:
    """Whether gz-transport accepts a text as a topic (`TopicUtils.cc`, IsValidTopic)."""
    return 0 < len(name.encode()) <= _LONGEST and name != "/" and not any(each in name for each in _REFUSED)


def as_valid_topic(text: str) -> str | None:
    """The topic that Gazebo makes of a text; None if nothing is left of it (`TopicUtils.cc`, AsValidTopic)."""
    name = _REMOVED.sub("", text.replace(" ", "_"))
    return name if is_valid_topic(name) else None


def qualified(name: str) -> str:
    """A valid topic as the bridge and `gz topic` name it (`TopicUtils.cc`, FullyQualifiedName)."""
    return "/" + name.removeprefix("/").removesuffix("/")


def fill_pattern(pattern: str, values: Mapping[str, str]) -> str | None:
    """A pattern with its values, `{a|b}` with the first of these that is known; None if a value is unknown."""
    if not all(_available_values(found, values) for found in _PLACE.finditer(pattern)):
        return None
    return _PLACE.sub(lambda found: _available_values(found, values)[0], pattern)


def fill_topic_pattern(pattern: str, values: Mapping[str, str], *, raw: bool = False) -> str | None:
    """The topic that a pattern stands for; None if Gazebo has no such topic.

    The text becomes a valid topic, except where `raw`: then it has to be one. If parts of a pattern are in parentheses,
    only these become valid topics, each by itself, or nothing, and the rest stays as it is.
    """
    pieces = _PIECE.split(pattern)
    if len(pieces) == 1 and not raw:
        return as_valid_topic(fill_pattern(pattern, values) or "")
    texts = [
        _fill_piece(piece, values) if number % 2 else fill_pattern(piece, values) or ""
        for number, piece in enumerate(pieces)
    ]
    name = "".join(texts)
    return name if is_valid_topic(name) else None


def _fill_piece(piece: str, values: Mapping[str, str]) -> str:
    topics = (as_valid_topic(fill_pattern(each, values) or "") for each in _CHOICE.split(piece))
    return next(filter(None, topics), "")


def placeholders(pattern: str) -> list[str]:
    """The names in the placeholders of a pattern."""
    return [name for found in _PLACE.findall(pattern) for name in found.split("|")]


def without_parentheses(pattern: str) -> str:
    """A pattern for people to read."""
    return _PIECE.sub(lambda piece: _CHOICE.split(piece[1])[0], pattern)


def _available_values(place: re.Match[str], values: Mapping[str, str]) -> list[str]:
    return [values[name] for name in place[1].split("|") if name in values]


def find_class(plugin: Plugin, kinds: tuple[PluginKind, ...], sink: DiagnosticSink) -> PluginKind | None:
    """The system that is meant, the one with the class name or the only one in the file; report a class of none."""
    if not plugin.name:
        return kinds[0] if len(kinds) == 1 else None
    name = modern_class(plugin.name)
    found = next((kind for kind in kinds if kind.class_name == name), None)
    if found is None:
        classes = " or ".join(kind.class_name for kind in kinds)
        message = f"{plugin.filename} has no class {plugin.name}; the name has to be {classes}"
        sink.report(rules.WRONG_PLUGIN_CLASS, message, plugin.location, found=plugin.name, expected=classes)
    return found or (kinds[0] if len(kinds) == 1 else None)
