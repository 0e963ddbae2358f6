"""Links and joints that plugins and transmissions refer to, and that must not become frames."""

from collections.abc import Iterator
from dataclasses import dataclass

from twinform.ir import Element, Model, Node, Plugin, ReferenceKind, walk
from twinform.passes.structure.reference_words import kind_of_attribute, kind_of_text


@dataclass(frozen=True, slots=True)
class Mentions:
    """Who names a link or a joint as such, by its name."""

    links: dict[str, str]
    joints: dict[str, str]


def mentions(model: Model) -> Mentions:
    """What is named in a model and in those in it, by elements without a typed form."""
    found = Mentions({}, {})
    for node in walk(model):
        for element in _elements(node):
            holder = f"plugin {node.name!r}" if isinstance(node, Plugin) else f"<{element.name}>"
            _collect(element, "", holder, found)
    return found


def _elements(node: Node) -> Iterator[Element]:
    content: tuple[Element, ...] = getattr(node, "content", ())
    yield from content
    for part in node.opaque:
        if part.element is not None:
            yield part.element


def _collect(element: Element, around: str, holder: str, found: Mentions) -> None:
    named = element.get("name")
    if element.name == "plugin":
        holder = f"plugin {named!r}"
    for attribute, value in element.attributes:
        if not (attribute == "name" and element.name == "sensor"):
            _note(kind_of_attribute(element, attribute), value, holder, found)
    if element.text:
        _note(kind_of_text(element, around), element.text, holder, found)
    for child in element.children:
        _collect(child, element.name, holder, found)


def _note(kind: ReferenceKind | None, text: str, holder: str, found: Mentions) -> None:
    where = {"link": found.links, "joint": found.joints}.get(kind or "")
    if where is not None:
        # Some plugins take lists of names in one text.
        for name in (text, *text.replace(",", " ").split()):
            where.setdefault(name.rpartition("::")[2], holder)
