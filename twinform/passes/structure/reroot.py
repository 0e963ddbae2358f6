"""Choose another root link."""

from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Joint, Model
from twinform.ir.frames import WORLD, FrameGraph
from twinform.ir.scopes import outer_models
from twinform.passes.structure.gazebo_blocks import blocks, content
from twinform.passes.structure.model_edit import EditContext, ModelEdit
from twinform.passes.structure.reversal import REVERSIBLE, block_measures_in_sensor, measures_in_sensor


class Reroot(ModelEdit):
    """Make another link the root; the joints on the path to the old root are reversed exactly.

    Changes: 1. parent and child of the joints between the two roots; 2. their axes, which point the other way, so that
    positions, limits, damping, springs, mimics and calibrations keep their meaning; 3. in URDF their origins; where a
    link's origin is beside the axis on which it now hangs, a link without mass, `JOINT_reversed`, is put on the axis,
    so that no link's frame moves; it goes again when the root comes back; 4. in SDF frames that moved with a reversed
    joint, which are attached to the link that they moved with; 5. sensors of force and torque on these joints count
    from the other side.
    Never touches: where links are in each other, names, masses, shapes, the canonical link of SDF.
    Diagnostics: `unknown-name`; `irreversible-joint` for joints with two axes, planar joints, a joint to the world, and
    one with a sensor that measures in axes of its own.
    """

    name: ClassVar[str] = "reroot"
    example: ClassVar[str] = "reroot{link=imu_link}"

    link: str = Field(min_length=1, description="The link that becomes the root.")

    def edit(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with another root."""
        models = (model for model in outer_models(document) if self.model in (None, model.name))
        links = {link.name for model in models for link in model.links}
        if self.link not in links:
            sink.report(rules.UNKNOWN_NAME, f"no link is called {self.link!r}", document.location, found=self.link)
            return document
        return super().edit(document, sink)

    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model with another root."""
        if all(link.name != self.link for link in model.links):
            return model
        way = _way_up(model, self.link)
        if not way or self._refuses(model, way, place):
            return model
        # imported here: a document needs one way only
        if place.format is Format.URDF:
            from twinform.passes.structure.reroot_urdf import reroot_urdf  # noqa: PLC0415 - see above

            return reroot_urdf(model, self.link, way)
        from twinform.passes.structure.reroot_sdf import reroot_sdf  # noqa: PLC0415 - see above

        return reroot_sdf(model, way)

    def _refuses(self, model: Model, way: list[Joint], place: EditContext) -> bool:
        there = blocks(model.extensions)
        found = False
        for joint in way:
            why = _why_not(joint)
            if joint.type != "fixed" and block_measures_in_sensor(content(there, joint.name)):
                why = "a sensor on it measures in axes of its own"
            if why:
                message = f"joint {joint.name!r} cannot be reversed to make {self.link!r} the root: {why}"
                place.sink.report(rules.IRREVERSIBLE_JOINT, message, joint.location, found=joint.type)
                found = True
        return found


def _way_up(model: Model, link: str) -> list[Joint]:
    """The joints from a link up to its root; of several joints with one child, the first holds it."""
    graph = FrameGraph(model)
    links = {each.name for each in model.links}
    above: dict[str, tuple[Joint, str]] = {}
    for joint in model.joints:
        if joint.type != "gearbox" and joint.parent and joint.child:
            child = joint.child if joint.child in links else graph.body(joint.child)
            parent = joint.parent if joint.parent in links else graph.body(joint.parent)
            above.setdefault(child, (joint, parent))
    way: list[Joint] = []
    seen = {link}
    while link in above:
        joint, parent = above[link]
        way.append(joint)
        if parent in seen:
            break
        seen.add(parent)
        link = parent
    return way


def _why_not(joint: Joint) -> str:
    if joint.parent == WORLD:
        return "it holds the robot to the world"
    if joint.type not in REVERSIBLE:
        # A chain of two rotations cannot be expressed the other way round by one axis each with the
        # same positions.
        return f"a {joint.type} joint moves in several ways, one after the other"
    if measures_in_sensor(joint):
        return "a sensor on it measures in axes of its own"
    return ""
