"""Completion in plugins: their files and classes by where they stand, their parameters, and the values of these."""

from collections.abc import Iterator

from twinform.passes.plugins.catalog import classic_plugins, classic_plugins_of_file, systems, systems_of_file
from twinform.passes.plugins.catalog_types import PluginKind, PluginParameter
from twinform.server.completion.proposals import ITEM, ElementPlace, Proposal, ValuePlace, literal, values
from twinform.server.schema import described, parameter_of, parameters_in
from twinform.server.tolerant_tree import TolerantNode

BOOLS = ("true", "false")
_SCOPES = frozenset({"world", "model", "link", "joint", "sensor", "visual", "actor", "gui"})


def propose_files_of_plugins(place: ValuePlace) -> Iterator[Proposal]:
    """Propose the files of the plugins that can stand there, those of gz-sim first."""
    scope = _scope_of(place.node)
    for rank, kinds in enumerate((systems().values(), _classic()), start=1):
        for each in kinds:
            if scope is None or scope in each.scopes:
                yield Proposal(each.file, literal(each.file), ITEM.Module, each.name, rank=rank)


def propose_classes(place: ValuePlace) -> Iterator[Proposal]:
    """Propose the classes in the file of a plugin; without a file, all that can stand there."""
    file, scope = place.node.get("filename") or "", _scope_of(place.node)
    if file:
        kinds = systems_of_file(file)
        # in Gazebo Classic the name is free
        names = [each.class_name for each in kinds] or [each.name for each in classic_plugins_of_file(file).values()]
    else:
        names = [each.class_name for each in systems().values() if scope is None or scope in each.scopes]
    yield from values(names, ITEM.Module)


def propose_parameters(place: ElementPlace) -> Iterator[Proposal]:
    """Propose the parameters of a plugin, or those in one of them."""
    there = place.siblings
    for parameter in parameters_in(place.parent):
        if (
            not parameter.is_attribute
            and "[" not in parameter.name
            and (parameter.is_many or parameter.name not in there)
        ):
            yield _parameter(parameter, bare=place.bare)


def propose_attributes_of_parameter(node: TolerantNode, *, named: bool) -> Iterator[Proposal]:
    """Propose the attributes of a parameter of a plugin."""
    for each in parameters_in(node):
        name = each.name.removeprefix("@")
        if each.is_attribute and name not in node.attributes:
            yield Proposal(name, name if named else f'{name}="$1"', ITEM.Property, each.type, described(each))


def propose_values_of_parameter(place: ValuePlace) -> Iterator[Proposal]:
    """Propose the choices and the default of a parameter."""
    parameter = parameter_of(place.node) if place.attribute is None else None
    if parameter is not None:
        default = (parameter.default,) if parameter.default else ()
        yield from values(parameter.choices or (BOOLS if parameter.type == "bool" else default))


def _parameter(parameter: PluginParameter, *, bare: bool) -> Proposal:
    name = parameter.name
    ending = ">\n  $0\n</" if parameter.children else ">$1</"
    new = name if bare else f"{name}{ending}{name}>"
    rank = 0 if parameter.is_required else 1
    return Proposal(name, new, ITEM.Field, parameter.type, described(parameter), rank)


def _scope_of(plugin: TolerantNode) -> str | None:
    """Return what a plugin stands in; None if it may be anything."""
    around = plugin.parent
    while around is not None and around.tag not in _SCOPES | {"gazebo", "robot", "include"}:
        around = around.parent
    if around is None or around.tag == "include":
        return None
    if around.tag in {"gazebo", "robot"}:
        return "model"
    return around.tag


def _classic() -> list[PluginKind]:
    kinds = (*classic_plugins("ros2").values(), *classic_plugins("noetic").values())
    return list({each.file: each for each in reversed(kinds)}.values())[::-1]
