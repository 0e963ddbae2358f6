"""Bodies of one tree, or of several, as the model that they are: links, joints and frames.

A body is a link in the frame of the link around it. Where it has several joints, links without mass stand between them,
all in the place of the body, and the joints keep their names and their order: the first is nearest to the parent. A
body without a joint is fixed to its parent, or to the world.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import NamedTuple

from twinform.compiler.input.mjcf.contact_masks import Bits
from twinform.compiler.input.mjcf.lower_equalities import JointFollowing, mimic_of
from twinform.compiler.input.mjcf.lower_geoms import GeomLowering
from twinform.compiler.input.mjcf.lower_inertials import WrittenInertia, inertial_of
from twinform.compiler.input.mjcf.lower_joints import FREE, joint_type, lower_joint
from twinform.compiler.input.mjcf.lower_lights import lower_camera, lower_light
from twinform.compiler.input.mjcf.names import NameScope
from twinform.compiler.input.mjcf.pieces import Piece, pose_of
from twinform.compiler.input.mjcf.remainders import RemainderKeeper, holder, in_sections, with_rest
from twinform.ir import Element, Frame, Joint, Light, Link, Mimic, Opaque, Pose, Sensor
from twinform.ir.frames import WORLD
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import MADE_NAME, annotate_synthesized, with_annotation
from twinform.passes.carriers.token_mass import TOKEN
from twinform.passes.legalise.changed_names import fixed_joint_name

JOINTS = ("joint", "freejoint")


class TreeParts(NamedTuple):
    """What the bodies of a model are in SDF.

    `masks` are those of the collisions of each link. `links_of` has the names of links by those of bodies, `sites` the
    link and the frame of each named site.
    """

    links: list[Link]
    joints: list[Joint]
    frames: list[Frame]
    masks: list[list[Bits]]
    links_of: dict[str, str]
    sites: dict[str, tuple[str, str]]


class _Placed(NamedTuple):
    """A body and the link that it stands on; None for the world."""

    body: Piece
    parent: str | None


class TreeLowering:
    """Lowers the bodies of a tree, or of several, which become one model.

    The frame of the model is that of its only root, unless it is said where the model is: then all roots are placed in
    that frame. `inertias` has the mass of each body, `followers` the equalities that are mimics by the names of their
    followers, and `efforts` what actuators do to joints; `names` is new.
    """

    def __init__(
        self,
        roots: Sequence[Piece],
        at: Transform | None,
        geoms: GeomLowering,
        keeper: RemainderKeeper,
        inertias: Mapping[Piece, WrittenInertia],
        scale: float,
        followers: Mapping[str, tuple[Piece, JointFollowing]],
        efforts: Mapping[str, float],
        names: NameScope,
    ) -> None:
        self.roots = tuple(roots)
        self.names = names
        self._at = at
        self._geoms = geoms
        self._keeper = keeper
        self._inertias = inertias
        self._scale = scale
        self._followers = followers
        self._efforts = efforts
        self._joint_names: dict[str, str] = {}
        self.parts = TreeParts([], [], [], [], {}, {})

    @property
    def is_static(self) -> bool:
        """Whether nothing in the model moves."""
        return not any(each.tag in JOINTS for root in self.roots for each in root.walk())

    @cached_property
    def mocap(self) -> frozenset[str | None]:
        """The names of bodies that only a program moves: what holds another one to them is no joint."""
        found = (each for root in self.roots for each in root.walk())
        return frozenset(each.name for each in found if each.peek("mocap") == "true")

    def lower(self) -> TreeParts:
        """Build the links, joints and frames of all bodies, parents first."""
        self._name([body for root in self.roots for body in root.bodies()])
        waiting = [_Placed(root, None) for root in reversed(self.roots)]
        while waiting:
            here = waiting.pop()
            link = self._body(here)
            waiting += [_Placed(each, link) for each in reversed(tuple(here.body.all_of("body")))]
        return self.parts

    def _name(self, bodies: list[Piece]) -> None:
        """Give names to links first, then to joints, then to frames; those that are written come first."""
        self._name_links(bodies)
        joints = [(body, each) for body in bodies for each in body.all_of(*JOINTS) if joint_type(each) != FREE]
        for body, joint in sorted(joints, key=lambda each: each[1].name is None):
            name = self.names.give(joint, f"{self.names.of(body)}_joint", "joint")
            if joint.name is not None:
                self._joint_names[joint.name] = name
        sites = [(body, each) for body in bodies for each in body.all_of("site") if each.name is not None]
        for body, site in sites:
            self.parts.sites[site.name or ""] = (self.names.of(body), self.names.give(site, "", "frame"))

    def _name_links(self, bodies: list[Piece]) -> None:
        """Give links the names of their bodies; one without a name is called after the body around it."""
        for body in bodies:
            if body.name is not None:
                self.parts.links_of[body.name] = self.names.give(body, "", "link")
        for root in self.roots:
            if root.name is None:
                self.names.give(root, "body", "link")
        unnamed = [(body, each) for body in bodies for each in body.all_of("body") if each.name is None]
        for body, inner in unnamed:
            self.names.give(inner, f"{self.names.of(body)}_body", "link")

    def _body(self, here: _Placed) -> str:
        """Build the link of a body and what holds it, and return the name of the link."""
        body = here.body
        body.is_settled = True
        name = self.names.of(body)
        pose = self._pose(here)
        inertial, weightless = inertial_of(self._inertias[body], self._scale, self._keeper)
        shapes = self._geoms.lower(body, name)
        self.parts.masks.append([*shapes.bits])
        gravity = None
        if body.peek_numbers("gravcomp") == (1.0,):
            body.take("gravcomp")
            gravity = False
        joints = [each for each in body.all_of(*JOINTS) if joint_type(each) != FREE]
        between = self._between(joints, pose)
        rest = (*self._keeper.rest(body), *weightless, *shapes.rest, *self._free_joint(body))
        link = Link.unchecked(
            name=name,
            pose=pose,
            gravity=gravity,
            kinematic=True if body.peek("mocap") == "true" else None,
            inertial=inertial,
            visuals=shapes.visuals,
            collisions=shapes.collisions,
            sensors=tuple(self._cameras(body, name)),
            lights=tuple(self._lights(body, name)),
            opaque=rest,
            source=body.source,
        )
        link = link.copy(opaque=(*link.opaque, *self._unread(body)))
        self.parts.links.append(self.names.marked(link, body))
        self.parts.links.extend(between)
        self._hold(here, name, joints, [each.name for each in between])
        self._frames(body, name)
        return name

    def _pose(self, here: _Placed) -> Pose | None:
        """Return where a body is in the link that it stands on, and a root in the frame of the model."""
        at = here.body.transform()
        if here.parent is not None:
            return pose_of(at, here.parent, here.body.source)
        if self._at is None:
            return None
        if not self._at.is_identity:
            at = self._at.inverse().compose(at)
        return pose_of(at, source=here.body.source)

    def _between(self, joints: list[Piece], pose: Pose | None) -> list[Link]:
        """Return the links between the joints of a body, all in its place."""
        made = [self.names.make(f"{self.names.of(each)}_link") for each in joints[:-1]]
        return [
            annotate_synthesized(Link.unchecked(name=each, pose=pose, inertial=TOKEN, source=joint.source))
            for each, joint in zip(made, joints[:-1], strict=True)
        ]

    def _hold(self, here: _Placed, name: str, joints: list[Piece], between: list[str]) -> None:
        """Build the joints of a body, or the fixed one where it has none and is no floating or static root."""
        if not joints:
            if here.parent is not None or not (_is_free(here.body) or self.is_static):
                self.parts.joints.append(self._fixed(here, name))
            return
        ends = [here.parent or WORLD, *between, name]
        for joint, parent, child in zip(joints, ends[:-1], ends[1:], strict=True):
            given = self.names.of(joint)
            effort = self._efforts.get(joint.name or "")
            mimic, rest = self._mimic(joint)
            made = lower_joint(joint, given, parent, child, mimic, effort, self._keeper)
            self.parts.joints.append(self.names.marked(with_rest(made, rest), joint))

    def _fixed(self, here: _Placed, name: str) -> Joint:
        made = self.names.make(fixed_joint_name(name))
        joint = Joint.unchecked(
            name=made, type="fixed", parent=here.parent or WORLD, child=name, source=here.body.source
        )
        return with_annotation(joint, MADE_NAME, made)

    def _mimic(self, joint: Piece) -> tuple[Mimic | None, tuple[Opaque, ...]]:
        """Return what a joint follows, if both are in this tree and slide or turn, and the rest of the equality."""
        piece, said = self._followers.get(joint.name or "", (None, None))
        if piece is None or said is None or said.leader not in self._joint_names or joint_type(joint) == "ball":
            return None, ()
        mimic = mimic_of(piece, said, self._joint_names[said.leader])
        element = self._keeper.rest_element(piece)
        return mimic, in_sections({"equality": (element,)}) if element.attributes else ()

    def _free_joint(self, body: Piece) -> tuple[Opaque, ...]:
        """Return what is left of the free joint of a root, which SDF says by having no joint."""
        found = [each for each in body.all_of(*JOINTS) if joint_type(each) == FREE]
        return tuple(part for each in found for part in self._rest_of_free(each))

    def _rest_of_free(self, piece: Piece) -> tuple[Opaque, ...]:
        if piece.tag == "joint":
            piece.take("type")
        return self._keeper.rest(piece, is_marked=piece.tag == "joint")  # it is no `freejoint`

    def _frames(self, body: Piece, link: str) -> None:
        for site in body.all_of("site"):
            if site.name is None:
                continue
            pose = pose_of(site.transform(), source=site.source)
            rest = self._keeper.rest(site, is_marked=True)
            frame = Frame.unchecked(
                name=self.names.of(site), attached_to=link, pose=pose, opaque=rest, source=site.source
            )
            self.parts.frames.append(self.names.marked(frame, site))

    def _cameras(self, body: Piece, link: str) -> Iterator[Sensor]:
        for number, piece in enumerate(body.all_of("camera")):
            made = lower_camera(piece, piece.name or f"{link}_camera{number or ''}", self._keeper)
            if made is not None:
                yield made if piece.name else with_annotation(made, MADE_NAME, made.name)

    def _lights(self, body: Piece, link: str) -> Iterator[Light]:
        for number, piece in enumerate(body.all_of("light")):
            made = lower_light(piece, piece.name or f"{link}_light{number or ''}", self._keeper)
            if made is not None:
                yield made if piece.name else with_annotation(made, MADE_NAME, made.name)

    def _unread(self, body: Piece) -> tuple[Opaque, ...]:
        """Return what stands in a body and is no part of SDF: unnamed sites, cameras that follow, plugins, cables."""
        left: list[Element] = []
        for each in body.inside:
            if each.tag in {"body", *JOINTS} or each.is_settled or (each.tag == "site" and each.name):
                continue
            left.append(self._keeper.whole(each))
        return (holder(*left),) if left else ()


def _is_free(body: Piece) -> bool:
    """Whether a body floats."""
    return any(joint_type(each) == FREE for each in body.all_of(*JOINTS))
