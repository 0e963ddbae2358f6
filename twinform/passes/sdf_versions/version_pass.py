"""Base class of the passes between versions of SDF."""

from abc import abstractmethod
from collections.abc import Callable
from typing import TypeVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import DANGLING_FRAME, INCLUDE_NOT_EXPANDED
from twinform.ir import Document, Element, Node, replace_fields
from twinform.ir.frames import FrameError
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.framework.pass_base import Pass
from twinform.passes.transforms.nodes import map_elements
from twinform.schemas import Version, parse_version, versions_of

AnyNode = TypeVar("AnyNode", bound=Node)


class VersionPass(Pass):
    """A pass in the conversion to `version`. After an error there is nothing left to do.

    `carriers` is whether parts that this version lacks travel in carriers or only into the ledger.
    """

    version: str
    carriers: bool = True

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document in other syntax."""
        if sink.has_errors:
            return document
        try:
            return self.change(document, VersionKeeper(sink, self.carriers))
        except FrameError as error:
            _report(error, document, self.version, sink)
            return document

    @abstractmethod
    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document after the pass."""

    @property
    def number(self) -> Version:
        """The version that is asked for, as a pair of numbers."""
        return parse_version(self.version)


def _report(error: FrameError, document: Document, version: str, sink: DiagnosticSink) -> None:
    """Report which frame cannot be resolved, and how it could be where an include was not read."""
    # A frame that nobody knows is a mistake in the file, unless there are includes that were not
    # read: then it may be theirs.
    if error.rule is not DANGLING_FRAME or not _has_includes(document):
        error.report(sink)
        return
    message = f"SDF {version} needs to know where {error.found!r} is, and only the file of an include can say"
    hint = "expand the includes, or write a newer version"
    sink.report(INCLUDE_NOT_EXPANDED, message, error.location, found=error.found, help=hint)


def _has_includes(node: Node) -> bool:
    inner = (*getattr(node, "worlds", ()), *getattr(node, "models", ()))
    return bool(getattr(node, "includes", ())) or any(map(_has_includes, inner))


def map_own_elements(node: AnyNode, change: Callable[[Element], Element]) -> AnyNode:
    """The node with its untyped elements changed; those of other namespaces and of carriers are left alone."""
    if not any(part.element for part in node.opaque):
        return node
    return replace_fields(
        node, opaque=map_elements(node.opaque, lambda element: element if is_foreign(element) else change(element))
    )


def map_inside(element: Element, change: Callable[[Element], Element]) -> Element:
    """The element with all below it changed, from the inside out, and then itself; plugins are left alone."""
    # A plugin may call an element of its own `pose` or `state` and mean something else by it.
    if element.name == "plugin" or is_foreign(element):
        return element
    return change(replace_fields(element, children=tuple(map_inside(child, change) for child in element.children)))


def is_foreign(element: Element) -> bool:
    """Whether it is of another namespace, such as that of the carriers."""
    return element.name[0] == "{"


def known_version(declared: str | None) -> str:
    """The version that a file is read as: the newest where it declares none that exists."""
    versions = versions_of("sdf")
    # What declares a version that does not exist is reported elsewhere, and most likely has today's
    # syntax.
    return declared if declared in versions else versions[-1]
