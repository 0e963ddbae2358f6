"""The one place that names lxml's element type, which the library keeps under a private name."""

from collections.abc import Iterator

from lxml.etree import _Element as XmlElement  # pyright: ignore[reportPrivateUsage] - lxml has no public name for it

__all__ = ["XmlElement", "children", "is_blank", "path_of", "step_of"]


def children(element: XmlElement) -> Iterator[XmlElement]:
    """Its child elements; comments and processing instructions are left out."""
    return (child for child in element if isinstance(child.tag, str))


def is_blank(text: str) -> bool:
    """Whether it is only what XML calls white space; Python also counts the no-break space and others."""
    return not text or (text.isspace() and text.isascii())


def step_of(element: XmlElement) -> str:
    """Its step in a path: by name where it has one, else by its place among its like."""
    name = element.get("name")
    if name is not None:
        return f"{element.tag}[@name='{name}']"
    parent = element.getparent()
    like = [] if parent is None else [child for child in parent if child.tag == element.tag]
    return f"{element.tag}[{like.index(element) + 1}]" if len(like) > 1 else str(element.tag)


def path_of(element: XmlElement) -> str:
    """An XPath that finds it, from the root down."""
    steps = [step_of(element), *(step_of(above) for above in element.iterancestors())]
    return "/" + "/".join(reversed(steps))
