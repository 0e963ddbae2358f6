"""What the catalog knows of the plugins in a document, and of the parameters in them."""

from twinform.passes.plugins.catalog import (
    classic_plugins_of_file,
    system_of_class,
    systems_of_file,
)
from twinform.passes.plugins.catalog_types import PluginKind, PluginParameter
from twinform.server.tolerant_tree import TolerantNode


def plugin_around(node: TolerantNode | None) -> TolerantNode | None:
    """The plugin that an element is in, or is."""
    while node is not None and node.tag != "plugin":
        node = node.parent
    return node


def kind_of(plugin: TolerantNode) -> PluginKind | None:
    """What a plugin is, by its class or its file."""
    file = plugin.get("filename") or ""
    of_class = system_of_class(plugin.get("name") or "")
    if of_class is not None:
        return of_class
    found = (*systems_of_file(file), *classic_plugins_of_file(file).values()) if file else ()
    return found[0] if found else None


def parameter_of(node: TolerantNode) -> PluginParameter | None:
    """What an element in a plugin is."""
    plugin = plugin_around(node)
    if plugin is None or plugin is node:
        return None
    steps: list[str] = []
    here: TolerantNode | None = node
    while here is not None and here is not plugin:
        steps.append(here.tag)
        here = here.parent
    kind = kind_of(plugin)
    return kind.parameter(*reversed(steps)) if kind else None


def parameters_in(node: TolerantNode) -> tuple[PluginParameter, ...]:
    """What may stand in a plugin, or in a parameter of one."""
    if node.tag == "plugin":
        kind = kind_of(node)
        return kind.parameters if kind else ()
    parameter = parameter_of(node)
    return parameter.children if parameter else ()


def described(parameter: PluginParameter) -> str:
    """Type, unit, default and choices of a parameter."""
    words = [f"Type: {parameter.type}" + (f" ({parameter.unit})" if parameter.unit else "") + "."]
    words += [f"Default: {parameter.default}."] if parameter.default is not None else []
    words += [f"One of {', '.join(parameter.choices)}."] if parameter.choices else []
    words += ["Required."] if parameter.is_required else []
    return " ".join(words)
