"""Bodies of MJCF: the tree of links, with the joints that hold them, their poses, and free joints.

A link is a body in the body of its parent, and one that hangs from nothing or from the world is in `worldbody`. Without
a joint it is fixed there, as in a static model; one that is free has a `freejoint`.
"""

from collections.abc import Iterator
from typing import NamedTuple

from twinform.diagnostics import rules
from twinform.ir import Element, Link, Model
from twinform.ir.frames import WORLD
from twinform.ir.geometry import Empty
from twinform.ir.kinematic_tree import JointBetween
from twinform.passes.carriers.annotations import MADE_NAME, WORLDBODY, find_annotation, is_synthesized
from twinform.passes.carriers.joint_chains import part_of
from twinform.passes.legalise.to_mjcf.elements import make_element, placement
from twinform.passes.legalise.to_mjcf.geoms import geom_elements
from twinform.passes.legalise.to_mjcf.inertials import has_usual_weight, inertial_elements, report_weightless, weight_of
from twinform.passes.legalise.to_mjcf.joints import joint_elements
from twinform.passes.legalise.to_mjcf.kept_mjcf import is_shape, kept_elements, with_kept
from twinform.passes.legalise.to_mjcf.lights import body_lights
from twinform.passes.legalise.to_mjcf.sensors import body_sensors, joint_sensors
from twinform.passes.legalise.to_mjcf.sites import body_sites
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext
from twinform.passes.legalise.to_sdf.joint_types import FLOATING

_INSIDE = frozenset({"camera", "site", "light", "geom", "plugin", "composite", "flexcomp", "attach"})
"""What a link keeps of its body that SDF has nothing for, such as a camera that follows another body."""
_MOCAP = "mocap"
"""What says that only a program moves a body: it has no joint, and is a child of the world."""
MOST_DEEP = 400
"""So many bodies may be nested: MuJoCo's parser of XML refused 497, and what writes XML here calls itself for each."""


class Hold(NamedTuple):
    """How a link is held: the link that it hangs from, None for the world, and the joints between, parents first."""

    parent: str | None
    joints: tuple[JointBetween, ...]


def body_elements(context: MjcfContext) -> list[Element]:
    """The bodies in `worldbody`, each with all that hangs from it.

    Raises:
        FrameError: a frame is not known, or frames go round in a circle.
    """
    return _BodyTree(context).elements()


def _free_joint(context: MjcfContext, body: Body) -> Element:
    """The joint of a body that floats: one without settings, unless the link keeps one with a damping or the like.

    It has the name of the floating joint of a URDF, which SDF has no joint for. In a model beside others it has none,
    since what is read of MJCF has no scope there.
    """
    link = body.link
    if any(each.name == "joint" for each in kept_elements(link)):
        return with_kept(make_element("joint", [("type", "free")]), link)
    floating = None if context.is_of_mjcf or body.scope else find_annotation(link, FLOATING)
    name = None if floating is None else context.name("joint", floating.get("joint"), link)
    return with_kept(make_element("freejoint", [("name", name)]), link)


class _BodyTree:
    """Writes the bodies of a model or world, children before their parents."""

    def __init__(self, context: MjcfContext) -> None:
        self.context = context
        self.tree = context.tree
        self.folded = {name for name in self.tree.links if self._is_in_chain(name)}
        self.holds: dict[str, Hold] = {}
        self.world = _world_link(context)
        self.children: dict[str | None, list[str]] = {None: []}
        for name in self._in_order():
            hold = self.holds[name] = self._hold(name)
            self.children.setdefault(hold.parent, []).append(name)

    def elements(self) -> list[Element]:
        """The bodies at the top."""
        bodies: dict[str, Body] = {}
        depth: dict[str | None, int] = {None: 0}
        for name in self.holds:  # parents first, so that names are given in this order
            hold = self.holds[name]
            depth[name] = depth[hold.parent] + 1
            bodies[name] = self._body(name, hold, bodies)
        if (deepest := max(depth.values())) > MOST_DEEP:
            message = f"{deepest} links hang from each other, and no more than {MOST_DEEP} bodies can be nested in MJCF"
            help_ = "lump-fixed-joints makes one link of those that fixed joints hold together"
            where = self.context.holder.location
            self.context.sink.report(rules.NESTED_TOO_DEEPLY, message, where, found=str(deepest), help=help_)
            return []
        parts = {name: self._parts(bodies[name], self.holds[name]) for name in self.holds}
        made: dict[str, list[Element]] = {}
        for name in reversed(self.holds):
            inner = [each for child in self.children.get(name, ()) for each in made.pop(child)]
            content = [*parts.pop(name), *inner]
            if name == self.world:
                made[name] = [each for each in content if each.name != "inertial"]
            else:
                made[name] = [self._element(bodies[name], self.holds[name], content)]
        self._report_weightless(bodies)
        return [each for name in self.children[None] for each in made[name]]

    def _in_order(self) -> Iterator[str]:
        """Yield the links that become bodies, parents first."""
        for root in self.tree.roots:
            yield from (name for name in self.tree.below(root) if name not in self.folded)

    def _is_in_chain(self, name: str) -> bool:
        """Whether a link is one that a pass put between two joints of a chain: both move the body below it."""
        link = self.tree.links[name]
        if not (is_synthesized(link) or part_of(link)) or link.visuals or link.collisions or link.sensors:
            return False
        if not weight_of(link).is_nothing:
            return False
        below, above = self.tree.joints_below(name), self.tree.joint_above(name)
        # A fixed one was edited so, and holds a body of its own.
        return above is not None and len(below) == 1 and "fixed" not in {above.type, below[0].type}

    def _hold(self, name: str) -> Hold:
        found: list[JointBetween] = []
        between = self.tree.joint_above(name)
        while between is not None:
            found.append(between)
            if between.parent not in self.folded:
                break
            between = self.tree.joint_above(between.parent)
        if between is None or found[0] in self.context.closing:  # a static link stays in the world
            return Hold(None, ())
        parent = None if between.parent == WORLD and WORLD not in self.tree.links else between.parent
        return Hold(parent, tuple(reversed(found)))

    def _body(self, name: str, hold: Hold, above: dict[str, Body]) -> Body:
        link = self.tree.links[name]
        own = self.context.old_name("body", self.context.scope_of(name), link)
        # Of a link `world` MJCF has the name that SDF has in newer versions: the world itself has the other.
        own = f"{WORLD}_link" if own == link.name == WORLD else link.name if own == WORLD else own
        wish = self.context.wish("body", self.context.scope_of(name), own)
        written = WORLD if name == self.world else self.context.name("body", wish, link) or name
        self.context.note_made_name(
            "body", link, written, f"{above[hold.parent].link.name}_body" if hold.parent else "body"
        )
        self.context.written_bodies[name] = written
        moves = name not in self.context.static_links and (
            not hold.joints
            or any(each.type != "fixed" for each in hold.joints)
            or (hold.parent is not None and above[hold.parent].moves)
        )
        return Body(name, self.context.scope_of(name), link, written, moves)

    def _report_weightless(self, bodies: dict[str, Body]) -> None:
        """Report bodies that MuJoCo refuses because they move and weigh nothing, with all that is fixed to them."""
        heavy: set[str] = set()
        for name in reversed(self.holds):  # children first
            body, hold = bodies[name], self.holds[name]
            is_fixed = not body.moves or (bool(hold.joints) and all(each.type == "fixed" for each in hold.joints))
            if name in heavy or weight_of(body.link).can_move:
                if is_fixed and hold.parent is not None:
                    heavy.add(hold.parent)
            elif not is_fixed:
                report_weightless(self.context, body)

    def _parts(self, body: Body, hold: Hold) -> list[Element]:
        """What is in a body beside the bodies in it."""
        context = self.context
        is_free = body.moves and not hold.joints
        free = [_free_joint(context, body)] if is_free else []
        return [
            *inertial_elements(context, body),
            *free,
            *(joint_elements(context, body, hold.joints) if hold.joints else ()),
            *geom_elements(context, body),
            *body_sites(context, body),
            *(part for each in hold.joints for part in joint_sensors(context, body, each)),
            *body_sensors(context, body),
            *body_lights(context, body),
            *_kept_inside(context, body.link),
        ]

    def _element(self, body: Body, hold: Hold, children: list[Element]) -> Element:
        placed = placement(self.context.place(body.name, hold.parent))
        # Gravity is compensated for a link that it does not act on.
        weightless = [("gravcomp", "1")] if body.link.gravity is False else []
        element = make_element("body", [("name", body.written), *placed, *weightless], children, body.link.source)
        element = with_kept(element, body.link)
        if element.get(_MOCAP) != "true":
            return element
        if body.link.kinematic and not body.moves and hold.parent is None:
            self.context.mocap.add(body.name)
            return element
        return element.copy(attributes=tuple(pair for pair in element.attributes if pair[0] != _MOCAP))


def _kept_inside(context: MjcfContext, link: Link) -> Iterator[Element]:
    """Yield what a link keeps of what stood in its body; what says something of a geom that it lacks is stale."""
    for each in kept_elements(link):
        if each.name == "geom" and not is_shape(each):
            where = each.location if each.source else link.location
            message = f"link {link.name!r} keeps a <geom> without a shape, which none of its visuals and collisions has"
            context.drop_stale(message, where, "geom")
        elif each.name in _INSIDE:
            yield each


def _world_link(context: MjcfContext) -> str | None:
    """The link whose shapes are those of the world itself, if there is one."""
    found = (scope + model.links[0].name for scope, model in context.models if is_of_world(model))
    return next((name for name in found if name in context.static_links), None)


def is_of_world(model: Model) -> bool:
    """Whether a model is written as the shapes of the world itself: a static one without a name in MJCF."""
    if not model.static or model.pose or len(model.links) != 1 or find_annotation(model, MADE_NAME) is None:
        return False
    link = model.links[0]
    # The world has no mass, and no gravity that could be off: a link that is read of its shapes has what SDF gives to
    # any link. Without shapes there is nothing to read.
    is_usual = not link.pose and link.gravity is None and has_usual_weight(link)
    return link.name == model.name == WORLDBODY and is_usual and _has_shapes(link)


def _has_shapes(link: Link) -> bool:
    shapes = (each.geometry.shape for each in (*link.visuals, *link.collisions) if each.geometry)
    return any(not isinstance(each, Empty | None) for each in shapes) or any(map(is_shape, kept_elements(link)))
