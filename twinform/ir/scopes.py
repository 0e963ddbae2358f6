"""The models of a document and those nested in them, with the scopes that their names have outside."""

from collections.abc import Collection, Iterator
from itertools import chain

from twinform.ir.document import Document
from twinform.ir.element import Element, Opaque
from twinform.ir.link import Link
from twinform.ir.model import Include, Model
from twinform.ir.node import Node
from twinform.ir.rewrite import PLAIN, census_of, children_of
from twinform.ir.sensor import Light, Plugin

SCOPE = "::"
"""What stands between the name of a model and that of a part of it."""
_OUTSIDE_WORLDS = frozenset({"model", "light", "actor"})


def outer_models(document: Document) -> Iterator[Model]:
    """The models of a document and of its worlds, without those nested in them."""
    return chain(document.models, *(world.models for world in document.worlds))


def outside_worlds(document: Document) -> tuple[Model | Light | Opaque, ...]:
    """The models, lights and actors of a document that are in no world, also those that its version does not have."""
    more = (part for part in document.opaque if part.element and part.element.name in _OUTSIDE_WORLDS)
    return (*document.models, *document.lights, *more)


def scoped_models(model: Model, scope: str = "") -> Iterator[tuple[str, Model]]:
    """Yield a model and all models nested in it, from the outside in, each with the prefix of its names outside.

    `scope` is the prefix of the outermost one.
    """
    stack = [(scope, model)]
    while stack:
        scope, each = stack.pop()
        yield scope, each
        stack.extend((f"{scope}{inner.name}{SCOPE}", inner) for inner in reversed(each.models))


def nested_models(model: Model) -> Iterator[Model]:
    """A model and all models nested in it, from the outside in."""
    return (each for _, each in scoped_models(model))


def nested_names(model: Model) -> Iterator[str]:
    """The scoped names of the models nested in a model."""
    return (scope.removesuffix(SCOPE) for scope, _ in scoped_models(model) if scope)


def scoped_links(model: Model) -> Iterator[tuple[str, Link]]:
    """The links of a model and of all models nested in it, with their scoped names."""
    return ((f"{scope}{link.name}", link) for scope, each in scoped_models(model) for link in each.links)


def scopes_of(name: str) -> Iterator[str]:
    """Yield the models that a scoped name is in, from the outside in: `a` and `a::b` for `a::b::c`."""
    end = name.find(SCOPE)
    while end >= 0:
        yield name[:end]
        end = name.find(SCOPE, end + 1)


def scope_in(name: str, scopes: Collection[str]) -> str:
    """The longest of some scopes that a name is in, such as `arm::` of `arm::hand`; the empty one where it is in none.

    Before SDF 1.8 `::` may stand in the name of what is in no such model.
    """
    end = name.rfind(SCOPE)
    while end >= 0 and name[: end + len(SCOPE)] not in scopes:
        end = name.rfind(SCOPE, 0, end + 1)
    return name[: end + len(SCOPE)] if end >= 0 else ""


def nested_includes(model: Model) -> Iterator[Include]:
    """The includes of a model and of all models nested in it."""
    return (include for each in nested_models(model) for include in each.includes)


_PLUGIN = "plugin"


def scoped_elements(element: Element) -> Iterator[Element]:
    """Yield the elements, of one and all inside it, that libsdformat refuses for their names."""
    if element.name == _PLUGIN or ":" in element.name:
        return
    if SCOPE in (element.get("name") or ""):
        yield element
    for child in element.children:
        yield from scoped_elements(child)


def scoped_parts(node: Node) -> tuple[Opaque, ...]:
    """Return the opaque parts of a node that contain such elements; those in plugins are allowed."""
    if not node.opaque or isinstance(node, Plugin):
        return ()
    return tuple(part for part in node.opaque if part.element and any(scoped_elements(part.element)))


def scoped_parts_below(node: Node) -> Iterator[Opaque]:
    """Yield the scoped untyped parts of a node and of all nodes inside it."""
    stack = [node]
    while stack:
        node = stack.pop()
        if census_of(node) & PLAIN:
            yield from scoped_parts(node)
            stack += reversed([*children_of(node)])
