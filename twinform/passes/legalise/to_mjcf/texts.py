"""Carriers in MJCF: what it cannot say, as `<custom><text name="twinform:..." data="..."/></custom>`.

Each link, joint, frame, model or world has one text, which holds the partial node with all that MJCF leaves unsaid:
`twinform:link:arm::hand` is about the link `hand` in the model `arm`. `twinform:document` holds the format and version
of the source, and what stands beside the model or world that is written.
"""

from twinform.ir import PLAIN, Frame, Joint, Light, Model, Node, Sensor, World, rewrite
from twinform.ir.frames import MODEL
from twinform.passes.carriers.annotations import with_annotation
from twinform.passes.carriers.carriers import bits_of_ours, is_carrier
from twinform.passes.carriers.mjcf_texts import DOCUMENT, FIRST
from twinform.passes.carriers.partial_nodes import remainder
from twinform.passes.carriers.repeated_parts import wrap_repeated
from twinform.passes.legalise.to_mjcf.added_texts import AddedTexts
from twinform.passes.legalise.to_mjcf.text_list import TextList
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.passes.shared.joint_ends import joint_pose_attributes
from twinform.passes.shared.poses import POSE


def add_texts(context: MjcfContext) -> None:
    """Add a text to the `custom` section for each part that MJCF leaves unsaid. All other sections are complete."""
    if context.is_of_mjcf:
        AddedTexts(context).add()
    else:
        _AllTexts(context).add()


class _AllTexts(TextList):
    """Adds the texts of a document that was not read of MJCF: of all parts."""

    def add(self) -> None:
        """Add the texts of all parts."""
        model, holder, document = self.file.flat, self.context.holder, self.context.document
        worlds = tuple(each for each in document.worlds if each is not holder)
        self._add(DOCUMENT, "", document.copy(worlds=worlds, models=document.models if document.worlds else ()))
        if isinstance(holder, Model):
            self._add("model", "", self._with_canonical_link(model))
        elif document.worlds:
            self._add("world", "", holder)
        for link in model.links:
            self._add("link", link.name, link)
        for joint in model.joints:
            self._add("joint", joint.name, self._in_its_child(joint))
        for each in model.frames:
            self._add("frame", each.name, self._in_its_link(each))

    def _add(self, kind: str, name: str, node: Node) -> None:
        """Add the text of a node, unless MJCF says all of it, and enter what it holds into the ledger."""
        self.file.part = node
        whole = rewrite(self._without_kept(node), Node, wrap_repeated, having=PLAIN)
        left = remainder(whole, self.said, self.notes)
        if left is None and isinstance(node, World):  # what is a model has no world around it
            left = World.unchecked(name=node.name)
        if left is not None:
            self.add_text(kind, name, left, node)

    def _without_kept(self, node: Node) -> Node:
        """The node without what only MJCF has, which stands in its elements; what comes back as a whole keeps it."""
        return rewrite(node, Node, self._without_own_kept, having=bits_of_ours("mjcf"))

    def _without_own_kept(self, node: Node) -> Node:
        if not node.opaque or isinstance(node, Light) or (isinstance(node, Sensor) and self.what.left_of(node)):
            return node
        return node.copy(opaque=tuple(part for part in node.opaque if not is_carrier(part, "mjcf")))

    def _with_canonical_link(self, model: Model) -> Model:
        """The model, which names its first link if that is not the first body of the file."""
        first = next(iter(self.context.written_bodies), None)
        is_named = self.file.is_back or model.canonical_link or not model.links
        if is_named or first in {None, model.links[0].name}:
            return model
        return with_annotation(model, FIRST, attributes={"link": model.links[0].name})

    def _in_its_child(self, joint: Joint) -> Joint:
        """A joint that is posed in the frame of a placed model, which a file does not have, posed in its child."""
        child = joint.child or ""
        is_in_model = joint.pose is not None and joint.pose.relative_to == MODEL
        if not is_in_model or not self.file.graph.knows(child):
            return joint
        pose = self.file.graph.pose(joint.name, child, kind="joint", base="link").to_pose()
        attributes = joint_pose_attributes(joint)
        joint = joint.copy(pose=pose)
        return with_annotation(joint, POSE, attributes=attributes) if attributes else joint

    def _in_its_link(self, frame: Frame) -> Frame:
        """A frame that has no site, such as that of a nested model, posed in the link that it moves with."""
        if self.file.has_site(frame):
            return frame
        graph = self.file.graph
        body = graph.body(frame.name, kind="frame")
        if not graph.knows(body) or body == MODEL:
            return frame
        pose = graph.pose(frame.name, body, kind="frame", base="link").to_pose()
        return frame.copy(attached_to=body, pose=pose)
