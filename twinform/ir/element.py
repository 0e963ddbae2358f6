"""Untyped XML elements, which the IR keeps as they are, and the namespaces of documents."""

from collections.abc import Iterable
from typing import Annotated, Self

from twinform.diagnostics import Location
from twinform.ir.record import Constraint, Sourced, record

# Names are checked where they come from people: no writer could make XML of `a b`. Beyond ASCII
# the writer asks libxml2, which knows the tables of Unicode.
_LOCAL = "[A-Z_a-z\x80-\U0010ffff][A-Z_a-z0-9.\\-\x80-\U0010ffff]*"
Name = Annotated[str, Constraint(pattern=rf"^(\{{[^{{}}]+\}})?{_LOCAL}$")]
"""The name of an element or attribute, in Clark notation where it has a namespace."""
_Prefix = Annotated[str, Constraint(pattern=rf"^({_LOCAL})?$")]
"""What stands for a namespace; the empty one is the default."""
_Uri = Annotated[str, Constraint(pattern=r"^[^{}]+$")]
Namespace = tuple[_Prefix, _Uri]
"""A prefix and what it stands for."""
_Path = Annotated[str, Constraint(pattern=rf"^({_LOCAL}(/{_LOCAL})*)?$")]
Attribute = tuple[Name, str]
Attributes = tuple[Attribute, ...]


@record
class Element(Sourced):
    """A subtree without a typed form.

    Only what stands in free content, such as `<gazebo>`, or has a namespace, knows where it was written.

    Attributes:
        name: in Clark notation, `{namespace}name`, where it has a namespace.
        attributes: names, in Clark notation too, and values as written, in their order.
        text: the text before the first child, stripped; `None` where it is blank.
        children: the elements in it, in their order.
        tail: the text after the end tag, stripped; `None` where it is blank.
    """

    name: Name
    attributes: Attributes = ()
    text: str | None = None
    children: tuple[Self, ...] = ()
    tail: str | None = None

    def get(self, attribute: str) -> str | None:
        """The value of an attribute, or None."""
        for (
            name,
            value,
        ) in self.attributes:  # it is asked more often than anything: a generator takes three times as long
            if name == attribute:
                return value
        return None

    def find(self, name: str) -> Self | None:
        """The first child of this name, or None."""
        return next((child for child in self.children if child.name == name), None)

    def find_all(self, name: str) -> list[Self]:
        """Return the children of this name, in their order."""
        return [child for child in self.children if child.name == name]

    def exchange(self, child: "Element", new: "Element") -> Self:
        """Return the element with another one in place of a child."""
        return self.copy(children=tuple([new if each is child else each for each in self.children]))

    def walk(self) -> list[Self]:
        """Return this element and all below it, in document order."""
        # a list: an iterator would be resumed once for each element above the one that it yields
        found = [self]
        for child in self.children:
            if child.children:
                found += child.walk()
            else:
                found.append(child)
        return found

    @property
    def weight(self) -> int:
        """How many elements and attributes it holds, itself included."""
        return sum(1 + len(element.attributes) for element in self.walk())


@record
class Opaque(Sourced):
    """A part of a node that has no typed field, kept where it was: an element, an attribute or text.

    Exactly one of `element`, `attribute` and `text` is there.

    Attributes:
        at: the path from the node's own element to the one that holds it, such as `limit`; `""` is the node's own.
        element: the element with all below it.
        attribute: the name and the value.
        text: the text.
    """

    at: _Path = ""
    element: Element | None = None
    attribute: Attribute | None = None
    text: str | None = None

    @property
    def weight(self) -> int:
        """How many elements and attributes it stands for."""
        return self.element.weight if self.element else int(self.attribute is not None)

    @property
    def name(self) -> str:
        """A name for it in messages."""
        if self.element:
            return f"<{self.element.name}>"
        return f"@{self.attribute[0]}" if self.attribute else "text"

    def location_in(self, holder: Sourced) -> Location:
        """Return where it was read if that is known, otherwise its place in the element that holds it."""
        if self.source is not None or holder.source is None:
            return self.location
        name = self.element.name if self.element else f"@{self.attribute[0]}" if self.attribute else ""
        return holder.location.at("/".join(filter(None, (self.at, name)))) if self.at or name else holder.location


Namespaces = tuple[tuple[str, str], ...]
"""Prefixes, each with its namespace; the empty prefix is the default."""


def joined(first: Namespaces, others: Iterable[Namespaces]) -> Namespaces:
    """Merge namespace declarations: those of the first document win; others add prefixes that are still free."""
    found, known = dict(first), {uri for _, uri in first}
    for prefix, uri in (pair for each in others for pair in each):
        if prefix and uri not in known and found.setdefault(prefix, uri) == uri:
            known.add(uri)
    return tuple(found.items())
