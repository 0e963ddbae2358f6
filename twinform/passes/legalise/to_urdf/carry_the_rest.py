"""Carrying all remaining parts of SDF, and changing the format to URDF."""

from functools import partial
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Joint, Link, Model, Node, Opaque, replace_fields
from twinform.ir.frames import WORLD
from twinform.passes.carriers.absorb import has_first, inside, is_repeated
from twinform.passes.carriers.annotations import with_provenance, without_provenance, without_synthesized
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX, SECOND, has_ours
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.to_urdf.map_surfaces import OF_ALL_COLLISIONS
from twinform.passes.legalise.to_urdf.remainder import KnownFields, take_remainder, urdf_fields
from twinform.passes.legalise.to_urdf_pass import UrdfKeeper
from twinform.passes.shared.poses import BODY
from twinform.request_options import UrdfVersion

AnyNode = TypeVar("AnyNode", bound=Node)

_NO_EQUIVALENT = "has no equivalent in URDF"
_IMPLIED = KnownFields({"relative_to": None})
"""The frame of the pose of a joint or link, which is implied in URDF."""


class CarryTheRest(Pass):
    """Carry every part that URDF cannot express, and call the document URDF.

    Changes: 1. typed fields and opaque parts that the table of URDF has no row for go into carriers on the nearest
    element that URDF has, where a repeated element is marked as such; 2. `world` becomes a link where a joint hangs
    from it; 3. the document is URDF of the version asked for; 1.0, which every reader takes, goes without saying.
    Diagnostics: `unsayable-number`; in the ledger `sdf-only`.
    """

    name: ClassVar[str] = "carry-the-rest"

    carriers: bool = True
    urdf_version: UrdfVersion = "1.0"
    words: UrdfVersion = "1.0"
    """The version whose elements and attributes may be written: 1.2 for a file that has some of a newer version."""

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document as URDF."""
        if sink.has_errors:
            return document
        keeper = UrdfKeeper.of(document, sink, carriers=self.carriers)
        models = tuple(
            _finish_model(model, document, _RemainderCarrier(keeper, self.words)) for model in document.models
        )
        if not self.carriers:
            models = tuple(without_synthesized(model) for model in models)
        namespaces = tuple(pair for pair in document.namespaces if pair[0] not in ("", PREFIX))
        if any(map(has_ours, models)):
            namespaces = (*namespaces, (PREFIX, NAMESPACE))
        # urdfdom reads a missing version as 1.0, so a plain robot needs no attribute.
        version = None if self.urdf_version == "1.0" else self.urdf_version
        update = {"format": Format.URDF, "version": version, "models": models, "namespaces": namespaces}
        return document.copy(**update)


def _finish_model(model: Model, document: Document, rest: "_RemainderCarrier") -> Model:
    keeper = rest.keeper
    model = _without_usual_root(model, keeper)
    model = model.copy(links=tuple(map(rest.link, model.links)), joints=tuple(map(rest.joint, model.joints)))
    model = rest.take(model, "model", rest.fields("robot"))
    model = model.copy(links=tuple(_annotate_world(link, keeper) for link in model.links))
    has_world = any(link.name == WORLD for link in model.links)  # which SDF before 1.7 did not forbid
    if not has_world and any(joint.parent == WORLD for joint in model.joints):
        model = model.copy(links=(Link.unchecked(name=WORLD), *model.links))
    is_of_mjcf = document.source is not None and document.source.step == "mujoco"
    if document.version is not None and not is_of_mjcf:
        message = f"the file is SDF {document.version}"
        keeper.account(rules.SDF_ONLY, message, document.location.at("@version"), 1)
    if keeper.back or not keeper.carriers:
        return model
    return with_provenance(without_provenance(model), document)


def _annotate_world(link: Link, keeper: UrdfKeeper) -> Link:
    """A link called `world` (legal before SDF 1.7) annotated as a body, since URDF's `world` is SDF's world."""
    return keeper.annotate(link, BODY) if link.name == WORLD else link


def _without_usual_root(model: Model, keeper: UrdfKeeper) -> Model:
    """The model without the canonical link that a conversion from URDF set: the root."""
    children = {joint.child for joint in model.joints}
    root = next((link.name for link in model.links if link.name not in children), None)
    usual = keeper.back and root is not None and model.canonical_link == root
    return model.copy(canonical_link=None) if usual else model


class _RemainderCarrier:
    """Carries what URDF cannot express, from the innermost nodes outwards."""

    def __init__(self, keeper: UrdfKeeper, words: UrdfVersion) -> None:
        self.keeper = keeper
        self.fields = partial(urdf_fields, words)
        self.link_fields = KnownFields({**self.fields("link"), "pose": _IMPLIED, "inertial": None})
        joint = self.fields("joint")
        self.joint_fields = KnownFields({**joint, "pose": KnownFields({**(joint["pose"] or {}), **_IMPLIED})})
        self.fixed_fields = KnownFields({name: inner for name, inner in self.joint_fields.items() if name != "axis"})

    def link(self, link: Link) -> Link:
        update: dict[str, object] = {
            "visuals": tuple(self.take(visual, "visual", self.fields("link", "visual")) for visual in link.visuals),
            "collisions": tuple(
                self.take(one, "collision", self.fields("link", "collision")) for one in link.collisions
            ),
        }
        if link.inertial is not None:
            update["inertial"] = self.take(link.inertial, "inertial", self.fields("link", "inertial"))
        return self.take(replace_fields(link, **update), "link", self.link_fields)

    def joint(self, joint: Joint) -> Joint:
        # the axis of a fixed joint would be written, and mean nothing
        return self.take(joint, "joint", self.fixed_fields if joint.type == "fixed" else self.joint_fields)

    def take(self, node: AnyNode, tag: str, known: KnownFields) -> AnyNode:
        again = [part for part in node.opaque if is_repeated(part, node)]
        if again:  # they are no rest of what they repeat
            node = node.copy(opaque=tuple(part for part in node.opaque if part not in again))
            for part in again:
                message = f"<{part.name}> occurs more than once"
                node = self.keeper.keep(node, [part], rules.SDF_ONLY, message, part.location_in(node), about=SECOND)
        kept, pieces, endless = take_remainder(node, tag, known)
        if not (pieces or endless):
            return kept
        name = getattr(node, "name", None)
        of = f"{tag} {name!r}" if name else f"an {tag}"
        for piece in pieces:
            what = f"{piece.at}/{piece.name}" if piece.at else piece.name
            unshared = tag == "collision" and what.partition("/")[0].strip("<>") in OF_ALL_COLLISIONS
            why = "is not that of all collisions of its link: Gazebo reads none of it" if unshared else _NO_EQUIVALENT
            message = f"{what} of {of} {why}"
            about = SECOND if _is_second(piece, node, kept) else ()
            kept = self.keeper.keep(kept, [piece], rules.SDF_ONLY, message, piece.location_in(node), about=about)
        for path, text in endless:
            message = f"{path} of {of} is {text}, and numbers in URDF are finite"
            self.keeper.sink.report(rules.UNSAYABLE_NUMBER, message, node.location, found=text)
        return kept


def _is_second(piece: Opaque, node: Node, kept: Node) -> bool:
    """Whether a piece repeats an element deeper in a node, such as a second limit of an axis.

    The first one is in the `kept` node, or expressed otherwise, such as the color of a material.
    """
    if piece.element is None or not piece.at:
        return False
    name = piece.element.name
    holder, left = inside(node, piece.at), inside(kept, piece.at)
    if left is not None and has_first(left, name):
        return True
    if holder is None or has_first(holder.copy(opaque=()), name):
        return False
    return any(part.element == piece.element and is_repeated(part, holder) for part in holder.opaque)
