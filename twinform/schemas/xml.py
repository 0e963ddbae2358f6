"""The one place that names lxml's element type, which the library keeps under a private name."""

from collections.abc import Iterator

from lxml.etree import _Element as XmlElement  # pyright: ignore[reportPrivateUsage] - lxml has no public name for it

__all__ = [
    "XmlElement",
    "children",
    "is_blank",
    "path_of",
    "prefix_of",
    "step_of",
    "undeclared_namespace",
    "undeclared_prefix",
]

_UNDECLARED = "urn:twinform:undeclared:"
"""The beginning of the namespace that an undeclared prefix is given; the prefix is the end."""


def children(element: XmlElement) -> Iterator[XmlElement]:
    """Its child elements; comments and processing instructions are left out."""
    return (child for child in element if isinstance(child.tag, str))


def is_blank(text: str) -> bool:
    """Whether it is only what XML calls white space; Python also counts the no-break space and others."""
    return not text or (text.isspace() and text.isascii())


def step_of(element: XmlElement) -> str:
    """Its step in a path: by name where it has one, else by its place among its like."""
    name, tag = element.get("name"), str(element.tag)
    prefix = prefix_of(element, tag)
    step = f"{prefix}:{tag.partition('}')[2]}" if prefix else tag
    if name is not None:
        return f"{step}[@name='{name}']"
    parent = element.getparent()
    like = [] if parent is None else [child for child in parent if child.tag == element.tag]
    return f"{step}[{like.index(element) + 1}]" if len(like) > 1 else step


def path_of(element: XmlElement) -> str:
    """An XPath that finds it, from the root down."""
    steps = [step_of(element), *(step_of(above) for above in element.iterancestors())]
    return "/" + "/".join(reversed(steps))


def undeclared_namespace(prefix: str) -> str:
    """The namespace that stands for a prefix which nobody has declared."""
    return _UNDECLARED + prefix


def undeclared_prefix(namespace: str) -> str | None:
    """The prefix that a namespace was made for, if it was."""
    return namespace.removeprefix(_UNDECLARED) if namespace.startswith(_UNDECLARED) else None


def prefix_of(element: XmlElement, name: str) -> str | None:
    """The prefix with which the name of the element, or of one of its attributes, was written."""
    if name[0] != "{":
        return None
    namespace = name[1:].partition("}")[0]
    given = undeclared_prefix(namespace)
    return given or next((prefix for prefix, uri in element.nsmap.items() if prefix and uri == namespace), None)
