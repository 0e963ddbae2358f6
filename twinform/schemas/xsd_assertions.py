"""Assertions and keys of the XSD 1.1 schemas: what readers refuse and no type or count can express.

The reader and the rules on models report the same, so validation checks them no more than keys.
"""

from collections.abc import Iterator
from typing import NamedTuple

from lxml import etree

from twinform.schemas.facts import Fact, Table, Version
from twinform.schemas.meanings import Path
from twinform.schemas.xml import XmlElement
from twinform.schemas.xsd_values import XS, xs

_NO_RESERVED_NAME = "not(@name = 'world' or matches(@name, '^__.*__$'))"
_NO_SCOPED_NAME = "not(contains(@name, '::'))"
_RESERVED_SINCE = (1, 7)
_SCOPED_SINCE = (1, 8)
_NAMED = frozenset({"world", "model", "link", "joint", "frame", "visual", "collision", "sensor", "light"})
"""Definitions of SDF whose names libsdformat checks."""

_MOVED = (
    "joint or actuator or passive_joint or leftActuator or rightActuator or flexJoint or rollJoint or gap_joint or "
    "simulated_actuated_joint"
)
# What a schema should refuse was asked of libsdformat 12 and urdfdom. Both take negative sizes, and
# a box or sphere without any; physics engines do not. A sphere without a radius is in a world of
# gz-sim, so only boxes must have their size.
_TESTS: dict[tuple[str, str], tuple[str, ...]] = {
    ("urdf", "joint"): ("not(@type = ('revolute', 'prismatic')) or limit",),
    ("urdf", "geometry"): ("*",),
    ("urdf", "transmission"): (f"(@type or type) and ({_MOVED})",),
    ("sdf", "box_shape"): ("size",),
}
"""By format and definition. Other shapes than boxes are simulated without their sizes, in worlds of gz-sim too."""

_SHAPES = ("geometry", "_shape")
"""How the names of definitions of shapes end; nothing in them is less than zero."""


def declare_assertions(facts: Table, version: Version, fact: Fact, complex_type: XmlElement, path: Path) -> None:
    """Add to the end of a complex type what must hold for the element of a row."""
    for test in _tests(facts, version, fact, path):
        xs(complex_type, "assert", test=test)


def without_assertions(schema: str) -> str:
    """The same schema without its assertions."""
    root = etree.fromstring(schema.encode())
    etree.strip_elements(root, XS + "assert", with_tail=False)
    return etree.tostring(root, encoding="unicode")


def _tests(facts: Table, version: Version, fact: Fact, path: Path) -> Iterator[str]:
    if len(path) == 1:
        yield from _TESTS.get((facts.format, path[0]), ())
    if facts.format == "sdf" and len(path) == 1 and path[0] in _NAMED:
        yield from [_NO_RESERVED_NAME] if version >= _RESERVED_SINCE else []
        yield from [_NO_SCOPED_NAME] if version >= _SCOPED_SINCE else []
    rows = [row for row in fact.rows if row.exists_in(version) and row.dialect is None]
    if path[0].endswith(_SHAPES):
        yield from (_not_negative(row) for row in rows if row.min == 0 and (row.is_attribute or row.type))
    if facts.format == "sdf":  # libsdformat takes no default for an attribute that the format asks for
        yield from (row.name for row in rows if row.is_attribute and row.expected)


def _not_negative(row: Fact) -> str:
    if row.type == "double":
        return f"not(number({row.name}) lt 0)"
    numbers = f"tokenize(normalize-space(string({row.name})), ' ')"
    return f"every $number in {numbers} satisfies not(number($number) lt 0)"


class _Reference(NamedTuple):
    """An attribute that holds a name of a key."""

    name: str
    key: str
    selector: str
    field: str


_REFERENCES = {
    "urdf": (
        _Reference("parent", "link", "joint/parent", "@link"),
        _Reference("child", "link", "joint/child", "@link"),
        _Reference("mimic", "joint", "joint/mimic", "@joint"),
    ),
    "sdf": (),  # its names have scopes, which no key can follow
}


# Keys are in the normative XSD 1.1 only, which no run asks: they cost about as much as all other
# checks together, give messages without a path, and cannot follow SDF's scopes. `ir/verify` checks
# the same and more.
def declare_names(format: str, element: XmlElement, named: list[str], path: str) -> None:
    """Declare that each kind of the named children has its names once; where others refer to them, as a key."""
    references = [reference for reference in _REFERENCES[format] if reference.key in named]
    keys = {reference.key for reference in references}
    for name in named:
        unique = xs(element, "key" if name in keys else "unique", name=f"{path}.{name}")
        _select(unique, name, "@name")
    for reference in references:
        keyref = xs(element, "keyref", name=f"{path}.{reference.name}", refer=f"{path}.{reference.key}")
        _select(keyref, reference.selector, reference.field)


def without_names(schema: str) -> str:
    """The same schema without its keys."""
    root = etree.fromstring(schema.encode())
    etree.strip_elements(root, XS + "key", XS + "keyref", XS + "unique", with_tail=False)
    return etree.tostring(root, encoding="unicode")


def _select(constraint: XmlElement, selector: str, field: str) -> None:
    xs(constraint, "selector", xpath=selector)
    xs(constraint, "field", xpath=field)
