"""Base class of the passes from SDF to URDF, and how they keep what URDF cannot express."""

from abc import abstractmethod
from collections.abc import Iterable, Mapping
from typing import Self, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, Rule
from twinform.ir import Document, Format, Joint, Model, Node, Opaque, replace_fields
from twinform.ir.frames import FrameError, Kind
from twinform.passes.carriers.annotations import came_from, with_annotation
from twinform.passes.carriers.carriers import Attributes, Keeper, carry
from twinform.passes.framework.pass_base import Pass

AnyNode = TypeVar("AnyNode", bound=Node)


@dataclass(frozen=True, slots=True)
class UrdfKeeper(Keeper):
    """Carries or annotates the parts that URDF cannot express, and enters them into the ledger.

    `back` is for a model that came from URDF, where nothing needs to remember the notation of SDF.
    """

    back: bool = False

    @classmethod
    def of(cls, document: Document, sink: DiagnosticSink, *, carriers: bool) -> Self:
        """Return the keeper for the models of a document."""
        return cls(sink, carriers, any(came_from(model, Format.URDF) for model in document.models))

    def keep(
        self,
        node: AnyNode,
        pieces: Iterable[Opaque],
        rule: Rule,
        message: str,
        location: Location,
        weight: int | None = None,
        about: Attributes = (),
    ) -> AnyNode:
        """The node with the pieces in carriers, and a ledger entry that by default has the weight of the pieces.

        `about` are further attributes of the carriers.
        """
        listed = tuple(pieces)
        if not listed:
            return node
        total = sum(piece.weight for piece in listed) if weight is None else weight
        self.account(rule, message, location, total)
        return carry(node, listed, "sdf", about) if self.carriers else node

    def annotate(
        self,
        node: AnyNode,
        kind: str,
        *,
        text: str | None = None,
        attributes: Mapping[str, str | None] | None = None,
        always: bool = False,
    ) -> AnyNode:
        """The node with an annotation on how SDF wrote it; in a model that came from URDF only with `always`."""
        return with_annotation(node, kind, text, attributes) if self.carriers and (always or not self.back) else node

    def frame_of(self, link: str, joint: Joint | None) -> tuple[str, Kind]:
        """The frame that a link gets in URDF: that of the joint which holds it, or its own without a joint.

        In a model that came from URDF, a link on a fixed joint keeps its frame, and the joint moves there.
        """
        # <origin> is what everybody reads in URDF; where a fixed joint itself is means nothing to
        # them.
        if joint is None or (self.back and joint.type == "fixed"):
            return link, "link"
        return joint.name, "joint"


class ToUrdfPass(Pass):
    """A pass over the model that becomes the robot, which does nothing where an error has been reported before.

    With `carriers`, what URDF cannot express travels in carriers; without, the ledger lists it as dropped.
    """

    carriers: bool = True

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with its model after the pass."""
        if sink.has_errors:
            return document
        keeper = UrdfKeeper.of(document, sink, carriers=self.carriers)
        try:
            return replace_fields(document, models=tuple(self.run_model(model, keeper) for model in document.models))
        except FrameError as error:
            error.report(sink)
            return document

    @abstractmethod
    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model after the pass."""
