"""Base class of the passes between versions of SDF, and how they edit untyped elements."""

from abc import abstractmethod
from collections.abc import Callable
from typing import TypeVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import DANGLING_FRAME, INCLUDE_NOT_EXPANDED
from twinform.ir import PLAIN, Document, Element, Format, Frame, Node, bits_of, census_of, replace_fields, rewrite, walk
from twinform.ir.frames import FrameError
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.nodes import map_elements
from twinform.schemas import Version, parse_version, print_version, version_read

AnyNode = TypeVar("AnyNode", bound=Node)


class VersionPass(Pass):
    """A pass in the conversion to `version`, which does nothing where an error has been reported before.

    With `carriers`, what the version lacks travels in carriers; without, the ledger lists it as dropped.
    """

    version: str
    carriers: bool = True

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document after `change`; the one that came in where a frame cannot be resolved, which is reported."""
        if sink.has_errors:
            return document
        try:
            return self.change(document, VersionKeeper(sink, self.carriers))
        except FrameError as error:
            _report(error, document, self.version, sink)
            return document

    @abstractmethod
    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document in the syntax of the version."""

    @property
    def number(self) -> Version:
        """The target version as a pair of numbers."""
        return parse_version(self.version)


def _report(error: FrameError, document: Document, version: str, sink: DiagnosticSink) -> None:
    """Report a frame that cannot be resolved, and that expanding the includes may help."""
    # An unknown frame is a mistake in the file, unless an include that was not read defines it.
    if error.rule is not DANGLING_FRAME or not _has_includes(document):
        error.report(sink)
        return
    message = f"SDF {version} needs to know where {error.found!r} is, and only the file of an include can say"
    hint = "expand the includes, or write a newer version"
    sink.report(INCLUDE_NOT_EXPANDED, message, error.location, found=error.found, help=hint)


def _has_includes(node: Node) -> bool:
    """Whether a document, world or model has an include that was not expanded."""
    inner = (*getattr(node, "worlds", ()), *getattr(node, "models", ()))
    return bool(getattr(node, "includes", ())) or any(map(_has_includes, inner))


def sdf_version_read(declared: str | None) -> str:
    """The version that an SDF file is read as, which the passes go by as the reader does."""
    return print_version(version_read("sdf", declared))


NAMED_FRAMES: Version = (1, 7)
"""Since this version a pose may name a frame."""


def has_early_frames(document: Document) -> bool:
    """Whether a document before SDF 1.7 has frames, which mean nothing there."""
    # Some files of 1.5 and 1.6 have <frame> elements in models; their meaning came with 1.7.
    early = document.format is Format.SDF and parse_version(sdf_version_read(document.version)) < NAMED_FRAMES
    if not early or not census_of(document) & bits_of(Frame):
        return False
    return any(isinstance(node, Frame) for node in walk(document))


def map_own_elements(node: AnyNode, change: Callable[[Element], Element]) -> AnyNode:
    """The node with its untyped elements changed, but for those of other namespaces, such as carriers."""
    if not any(part.element for part in node.opaque):
        return node
    opaque = map_elements(node.opaque, lambda element: element if is_foreign(element) else change(element))
    return replace_fields(node, opaque=opaque)


def map_elements_named(
    name: str, document: Document, kind: type[Node], change: Callable[[Element], Element]
) -> Document:
    """The document with the untyped elements of one name changed in all nodes of one class."""

    def change_named(element: Element) -> Element:
        return change(element) if element.name == name else element

    return rewrite(document, kind, lambda node: map_own_elements(node, change_named), having=PLAIN)


def map_inside(element: Element, change: Callable[[Element], Element]) -> Element:
    """The element after a change of all elements below it, the innermost first, and of itself; plugins stay."""
    # A plugin may call an element of its own `pose` or `state` and mean something else by it.
    if element.name == "plugin" or is_foreign(element):
        return element
    return change(replace_fields(element, children=tuple(map_inside(child, change) for child in element.children)))


def take_element(element: Element, path: tuple[str, ...]) -> tuple[Element, Element | None]:
    """The element without the first descendant at a path, and that descendant; its parent stays, even if empty."""
    found = element.find(path[0])
    if found is None:
        return element, None
    if len(path) == 1:
        return element.copy(children=tuple(each for each in element.children if each is not found)), found
    inner, taken = take_element(found, path[1:])
    return (element.exchange(found, inner), taken) if taken is not None else (element, None)


def put_element(element: Element, path: tuple[str, ...], made: Element) -> Element:
    """The element with a new last child in the descendant at a path, which is made where it is missing."""
    if not path:
        return element.copy(children=(*element.children, made))
    found = element.find(path[0])
    if found is None:
        inner = put_element(Element.unchecked(name=path[0]), path[1:], made)
        return element.copy(children=(*element.children, inner))
    return element.exchange(found, put_element(found, path[1:], made))


def has_element(element: Element, path: tuple[str, ...]) -> bool:
    """Whether an element has a descendant at a path."""
    found: Element | None = element
    for name in path:
        found = found.find(name) if found is not None else None
    return found is not None


def is_foreign(element: Element) -> bool:
    """Whether an element belongs to another namespace, such as that of our carriers."""
    return element.name[0] == "{"
