"""Checking the parameters of one plugin against those of its system."""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Element, Model, Plugin
from twinform.ir.scopes import scoped_models
from twinform.passes.plugins.catalog import nearest
from twinform.passes.plugins.catalog_types import PluginKind, PluginParameter
from twinform.passes.plugins.parameter_types import problem_of


class ModelNames:
    """The joints and links of models by name, each looked up once."""

    def __init__(self) -> None:
        self._known: dict[tuple[int, str], set[str] | None] = {}

    def of(self, model: Model, kind: str) -> set[str] | None:
        """The names in a model; None where they are not all known."""
        key = (id(model), kind)
        if key not in self._known:
            self._known[key] = names_in(model, kind)
        return self._known[key]


class ParameterContext(NamedTuple):
    """What a plugin is held against: its kind, the release, and the model that it names parts of."""

    kind: PluginKind
    release: str
    model: Model | None
    names: ModelNames
    sink: DiagnosticSink


def check_parameters(plugin: Plugin, context: ParameterContext) -> None:
    """Report what is wrong with the parameters of a plugin."""
    _check_inside(plugin.content, context.kind.parameters, context, plugin.location)


def names_in(model: Model, kind: str) -> set[str] | None:
    """The names of the joints or links of a model, those of nested models in full.

    None where includes that were not read may bring others.
    """
    names = set[str]()
    for scope, inner in scoped_models(model):
        if any(include.merge for include in inner.includes):
            return None
        names.update(f"{scope}{each.name}" for each in (inner.joints if kind == "joint" else inner.links))
    return names


def _check_inside(
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
        if row is None or context.release not in row.releases:
            _unknown(element.name, row, rows, context, at)
            continue
        counts[element.name] += 1
        if counts[element.name] > 1 and not row.is_many:
            message = f"<{element.name}> occurs twice; {_called(context.kind)} reads the first"
            context.sink.report(rules.PLUGIN_PARAMETER_COUNT, message, at, found=element.name)
        _check_element(element, row, context, at)
    present = {*counts}
    for row in rows:
        if (
            row.is_required_in(context.release)
            and not row.is_attribute
            and not any(row.matches(name) for name in present)
        ):
            message = f"{_called(context.kind)} needs <{row.name}>"
            context.sink.report(rules.PLUGIN_PARAMETER_COUNT, message, where, expected=row.name)


def _is_foreign(name: str) -> bool:
    """Whether it has a prefix: then it is for somebody else."""
    return name.startswith("{") or ":" in name


def _check_element(element: Element, row: PluginParameter, context: ParameterContext, at: Location) -> None:
    if row.free:
        return
    _check_attributes(element, row, context, at)
    if row.type == "element":
        _check_inside(element.children, row.children, context, at)
    else:
        _check_value(row, element.text or "", f"<{element.name}>", context, at)


def _check_attributes(element: Element, row: PluginParameter, context: ParameterContext, at: Location) -> None:
    rows = {each.name[1:]: each for each in row.children if each.is_attribute}
    for name, value in element.attributes:
        if _is_foreign(name):
            continue
        found = rows.get(name)
        if found is None:
            _unknown(f"@{name}", None, tuple(rows.values()), context, at)
        else:
            _check_value(found, value, f"{name!r} of <{element.name}>", context, at)
    for name, each in rows.items():
        if each.is_required and element.get(name) is None:
            message = f"{_called(context.kind)} needs {name!r} of <{element.name}>"
            context.sink.report(rules.PLUGIN_PARAMETER_COUNT, message, at, expected=name)


def _check_value(row: PluginParameter, text: str, what: str, context: ParameterContext, at: Location) -> None:
    problem = problem_of(row, text)
    if problem:
        message = f"{what} of {_called(context.kind)} is {text!r}, and has to be {problem}"
        context.sink.report(rules.PLUGIN_PARAMETER_VALUE, message, at, found=text, expected=problem)
        return
    if row.type in {"joint", "link"} and context.model is not None:
        _check_reference(row.type, text.strip(), what, context, at)


def _check_reference(kind: str, name: str, what: str, context: ParameterContext, at: Location) -> None:
    known = context.names.of(context.model, kind) if context.model else None
    if known is None or name in known or (context.model and context.model.includes and "::" in name):
        return
    near = nearest(name, sorted(known))
    message = f"{what} of {_called(context.kind)} names {name!r}, and the model has no such {kind}"
    context.sink.report(rules.PLUGIN_REFERENCE, message, at, found=name, help=_meant(near))


def _unknown(
    name: str, row: PluginParameter | None, rows: Sequence[PluginParameter], context: ParameterContext, at: Location
) -> None:
    called = f"<{name}>" if not name.startswith("@") else f"the attribute {name[1:]!r}"
    if row is not None:
        message = f"{_called(context.kind)} does not read {called} in {context.release}"
    else:
        message = f"{_called(context.kind)} does not read {called}"
    near = nearest(name, list(_readable(rows, context.release)))
    context.sink.report(rules.UNKNOWN_PLUGIN_PARAMETER, message, at, found=name.lstrip("@"), help=_meant(near))


def _readable(rows: Sequence[PluginParameter], release: str) -> Iterator[str]:
    return (row.name for row in rows if release in row.releases and "[" not in row.name)


def _meant(near: str | None) -> str | None:
    return f"did you mean {near.lstrip('@')}?" if near else None


def _called(kind: PluginKind) -> str:
    return kind.class_name.rsplit("::", 1)[-1]
