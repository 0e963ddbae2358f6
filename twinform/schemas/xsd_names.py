"""Keys of the XSD 1.1 schemas: names that must be unique, and references to them."""

from typing import NamedTuple

from lxml import etree

from twinform.schemas.xml import XmlElement
from twinform.schemas.xsd_values import XS, xs


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
