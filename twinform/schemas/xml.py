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

Places = dict[XmlElement, int]
"""The places of elements among their like."""
_UNDECLARED = "urn:twinform:undeclared:"
"""The beginning of the namespace that an undeclared prefix is given; the prefix is the end."""


def children(element: XmlElement) -> Iterator[XmlElement]:
    """Its child elements; comments and processing instructions are left out."""
    return (child for child in element if isinstance(child.tag, str))


def is_blank(text: str) -> bool:
    """Whether it is only what XML calls white space; Python also counts the no-break space and others."""
    return not text or (text.isspace() and text.isascii())


def step_of(element: XmlElement, places: Places | None = None) -> str:
    """Its step in a path: by name where it has one, else by its place among its like."""
    name, tag = element.get("name"), str(element.tag)
    prefix = prefix_of(element, tag)
    step = f"{prefix}:{tag.partition('}')[2]}" if prefix else tag
    if name is not None:
        return f"{step}[@name='{name}']"
    place = _place_of(element, tag, {} if places is None else places)
    alone = place == 1 and next(element.itersiblings(tag), None) is None
    return step if alone else f"{step}[{place}]"


def _place_of(element: XmlElement, tag: str, places: Places) -> int:
    """Counted back to the nearest sibling whose place is known: whoever asks for all of them in order, counts once."""
    between = 1
    for sibling in element.itersiblings(tag, preceding=True):
        known = places.get(sibling)
        if known is not None:
            between += known
            break
        between += 1
    places[element] = between
    return between


def path_of(element: XmlElement, places: Places | None = None) -> str:
    """An XPath that finds it, from the root down; `places` remembers what was counted for the next one."""
    steps = [step_of(element, places), *(step_of(above, places) for above in element.iterancestors())]
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
