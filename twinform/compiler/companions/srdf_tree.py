"""SRDF as a tree: of a file, or of the text that a xacro file expands to."""

from collections.abc import Iterator
from dataclasses import field
from pathlib import Path

from twinform.compiler.companions.name_places import Leaf, Step
from twinform.compiler.companions.possible_names import PossibleNames, possible_names
from twinform.compiler.input.load_options import LoadOptions, expanded_name
from twinform.compiler.input.parsing import UnreadableError, parse
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.schemas import XmlElement, path_of
from twinform.schemas.xml import Places, children

_DEEPEST = 8
"""So many steps to an element are kept; no name stands deeper, whatever macros or expressions are around it."""


@dataclass(frozen=True, slots=True)
class SrdfTree:
    """The root of an SRDF file, the name of its text in locations, and names `possible` with other arguments."""

    name: str
    root: XmlElement
    possible: PossibleNames = field(default_factory=PossibleNames)
    _places: Places = field(default_factory=dict[XmlElement, int], repr=False, compare=False)

    def names(self, tag: str) -> list[str]:
        """Return the names of all elements of a tag directly in the root."""
        return [each.get("name") or "" for each in self.root.iterchildren(tag)]

    def place_of(self, element: XmlElement, attribute: str = "") -> Location:
        """Return the place of an element, or of an attribute of it."""
        path = path_of(element, self._places)
        return Location(line=element.sourceline or 0, path=f"{path}/@{attribute}" if attribute else path)


def read_srdf(path: Path, data: bytes, sink: DiagnosticSink, load_options: LoadOptions) -> SrdfTree:
    """Read an SRDF file, which is expanded if it is xacro.

    Raises:
        UnreadableError: it is no XML, or cannot be expanded.
    """
    name = sink.file
    if path.suffix.lower() == ".xacro":
        from twinform.compiler.input.expand_xacro import expand  # noqa: PLC0415 - few files need it

        if load_options.xacro is False:
            sink.report(rules.XACRO_REFUSED, "this is a xacro file, and xacro is refused here", Location(line=1))
            raise UnreadableError
        expansion = expand(path, load_options, sink)
        name, data = expanded_name(name), expansion.text
        sink.origins[name] = expansion.origins
    root = parse(data, sink, load_options.limits)
    if root.tag != "robot":
        where = Location(line=root.sourceline or 0, path=f"/{root.tag}")
        message = f"the root element is <{root.tag}>; SRDF has <robot>"
        sink.report(rules.UNKNOWN_ROOT, message, where, found=str(root.tag), expected="robot")
        raise UnreadableError
    return SrdfTree(name, root, possible_names(path, load_options.search))


def leaves_of(srdf: SrdfTree) -> Iterator[Leaf[Location]]:
    """Yield the attributes of a file with the elements that lead to them."""
    pending = [(each, ()) for each in reversed(list(children(srdf.root)))]
    steps: tuple[Step[Location], ...]
    while pending:
        element, steps = pending.pop()
        where = srdf.place_of(element)
        here = (*steps[-_DEEPEST:], Step(str(element.tag), where))
        for name, value in element.items():
            place = where._replace(path=f"{where.path}/@{name}")
            yield Leaf((*here, Step(f"@{name}", place)), Step(str(value).strip(), place))
        pending += [(each, here) for each in reversed(list(children(element)))]


def elements(element: XmlElement, *tags: str) -> Iterator[XmlElement]:
    """Yield the children of an element with one of some tags, in their order."""
    return (each for each in children(element) if each.tag in tags)
