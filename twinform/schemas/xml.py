"""The one place that names lxml's element type, which the library keeps under a private name."""

from collections.abc import Iterable, Iterator
from typing import cast

from lxml import etree
from lxml.etree import _Element as XmlElement  # pyright: ignore[reportPrivateUsage] - lxml has no public name for it

from twinform.lazy import lazy_pattern

__all__ = [
    "BLANKS",
    "XmlElement",
    "children",
    "clark_name",
    "declared_namespaces",
    "has_prefixed_attributes",
    "in_usual_namespaces",
    "is_blank",
    "path_of",
    "prefix_of",
    "step_of",
    "undeclared_namespace",
    "undeclared_prefix",
    "usual_namespace",
]

BLANKS = " \t\r\n"
"""What XML calls white space."""
Places = dict[XmlElement, int]
"""The places of elements among their like."""
_UNDECLARED = "urn:twinform:undeclared:"
"""The beginning of the namespace that an undeclared prefix is given; the prefix is the end."""
_UNDECLARED_NAME = lazy_pattern(rf"(?<={{){_UNDECLARED}(?P<prefix>[^}}]*)(?=}})")
_USUAL = {
    "drake": "http://drake.mit.edu",
    "gz": "http://gazebosim.org/schema",
    "ignition": "http://gazebosim.org/schema",
    "xacro": "http://www.ros.org/wiki/xacro",
}
"""The namespaces that files declare for the prefixes of known readers."""
_ATTRIBUTE = etree.XPath("name(@*[local-name() = $local and namespace-uri() = $namespace])")
"""The name of an attribute as it was written."""
_PREFIXED = etree.XPath("boolean(/descendant::*/@*[namespace-uri()])")


def children(element: XmlElement) -> Iterator[XmlElement]:
    """List the child elements, without comments and processing instructions."""
    return (child for child in element if isinstance(child.tag, str))


def is_blank(text: str) -> bool:
    """Tell whether a text is only white space of XML; Python's `isspace` also accepts the no-break space and others."""
    return not text or (text.isspace() and text.isascii())


def step_of(element: XmlElement, places: Places | None = None) -> str:
    """Return an element's step in a path: its name, or else its place among siblings with its tag."""
    name, tag = element.get("name"), str(element.tag)
    prefix = prefix_of(element, tag)
    step = f"{prefix}:{tag.partition('}')[2]}" if prefix else tag
    if name is not None:
        return f"{step}[@name='{name}']"
    place = _place_of(element, tag, {} if places is None else places)
    alone = place == 1 and next(element.itersiblings(tag), None) is None
    return step if alone else f"{step}[{place}]"


def _place_of(element: XmlElement, tag: str, places: Places) -> int:
    """Count back to the nearest sibling with a known place, so that asking for all in order counts each once."""
    between = 1
    for sibling in element.itersiblings(tag, preceding=True):
        known = places.get(sibling)
        if known is not None:
            between += known
            break
        between += 1
    places[element] = between
    return between


def is_followed(element: XmlElement) -> bool:
    """Whether another element of its name stands behind it."""
    return next(element.itersiblings(str(element.tag)), None) is not None


def path_of(element: XmlElement, places: Places | None = None) -> str:
    """Return the XPath of an element from the root; `places` remembers counts for the next call."""
    steps = [step_of(element, places), *(step_of(above, places) for above in element.iterancestors())]
    return "/" + "/".join(reversed(steps))


def undeclared_namespace(prefix: str) -> str:
    """Return the namespace that stands for a prefix which nothing declares."""
    return _UNDECLARED + prefix


def undeclared_prefix(namespace: str) -> str | None:
    """Return the prefix that a namespace was made for, if it was made for one."""
    return namespace.removeprefix(_UNDECLARED) if namespace.startswith(_UNDECLARED) else None


def usual_namespace(prefix: str) -> str:
    """Return the usual namespace of a prefix: readers of these files go by the prefix alone."""
    return _USUAL.get(prefix, f"urn:{prefix}")


def clark_name(word: str) -> str:
    """The name of an element in Clark notation, for one with a usual prefix."""
    prefix, _, local = word.rpartition(":")
    return f"{{{usual_namespace(prefix)}}}{local}" if prefix else local


def in_usual_namespaces(names: str) -> str:
    """Replace namespaces of undeclared prefixes by their usual ones, in a name or a path of names."""
    return (
        _UNDECLARED_NAME.sub(lambda found: usual_namespace(found["prefix"]), names) if _UNDECLARED in names else names
    )


def prefix_of(element: XmlElement, name: str) -> str | None:
    """The prefix with which the name of the element, or of one of its attributes, was written."""
    if name[0] != "{":
        return None
    namespace = name[1:].partition("}")[0]
    given = undeclared_prefix(namespace)
    if given or name == element.tag:
        return given or element.prefix
    local = name.rpartition("}")[2]
    written = cast("str", _ATTRIBUTE(element, local=local, namespace=namespace))
    return written.rpartition(":")[0] or None


def declared_namespaces(root: XmlElement) -> set[tuple[str, str]]:
    """List each prefix that a tree declares, or uses without a declaration, with its namespace.

    To ask each element for its `nsmap` would go up to the root, and through all that is declared there, each time.
    """
    found = cast("Iterable[tuple[str, tuple[str, str]]]", etree.iterwalk(root, events=("start-ns",)))
    return {(undeclared_prefix(uri) or prefix, uri) for _, (prefix, uri) in found if prefix}


def has_prefixed_attributes(root: XmlElement) -> bool:
    """Tell whether any attribute has a namespace: some change how an element is checked."""
    return bool(_PREFIXED(root))
