"""Give mass to massless bodies that move."""

from collections.abc import Iterator
from typing import ClassVar, Literal, NamedTuple

from pydantic import Field

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import SPLIT_MASS, TOKEN_MASS
from twinform.ir import Document, Format, Inertial, Joint, Link, Model, Sphere, rewrite
from twinform.ir.defaults import MOMENT
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.scopes import outer_models, scoped_links
from twinform.ir.solids import NOTHING, ORIGIN, Solid, Symmetric, placed, solid, with_mass, with_tensor
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.passes.inertia.physical_consistency import has_mass, is_possible
from twinform.passes.shared.link_shapes import inertial_of
from twinform.passes.shared.moving_bodies import Body, ConnectedBodies, moving_bodies, neighbors


class _LinkAddress(NamedTuple):
    """The model at the root around a link, and the scoped name of the link in it."""

    root: Model
    name: str


class Masses:
    """The masses of the links of a document during the pass, by the identity of links: equal links are still two."""

    def __init__(self, document: Document) -> None:
        self._default = MOMENT[document.format]
        self._format = document.format
        self._link_addresses = dict(_link_addresses(document))
        self._graphs: dict[int, FrameGraph] = {}
        self._changed: dict[int, Inertial] = {}

    def of(self, link: Link) -> Inertial | None:
        """The inertial of a link."""
        return self._changed.get(id(link), link.inertial)

    def can_give(self, link: Link) -> bool:
        """Whether a link was written with a mass and inertia that can be divided; what it was given stays its own."""
        inertial = link.inertial
        return inertial is not None and not inertial.auto and is_possible(inertial, self._format)

    def mass(self, link: Link) -> float:
        """The mass of a link, in kg; zero where none is written."""
        inertial = self.of(link)
        return inertial.mass or 0.0 if inertial else 0.0

    def give(self, link: Link, what: Solid) -> None:
        """Set the inertial of a link to a solid in its own frame."""
        self._changed[id(link)] = inertial_of(what, link.inertial)

    def share(self, donor: Link, taker: Link, part: float) -> float:
        """Move a share of the mass of one link to another, at its place with all joints at zero; the mass in kg.

        Raises:
            FrameError: the poses of the links cannot be resolved.
        """
        inertial = self.of(donor) or Inertial()
        mass, matrix = inertial.mass or 0.0, inertia_matrix(inertial.inertia, self._default) or NOTHING.inertia
        address = self._link_addresses[id(donor)]
        graph = self._graph(address.root)
        at = graph.resolve(inertial.pose, address.name, self._link_addresses[id(taker)].name)
        # As if the body had been split at the joint: mass, center of mass and inertia at the zero
        # position stay exactly what they were. A token mass would change the robot, and is too
        # little for some solvers and too much for others.
        taken = placed(with_mass(Solid(mass, ORIGIN, matrix), part * mass), at)
        self._changed[id(donor)] = _scale_inertial(inertial, matrix, 1 - part)
        self.give(taker, taken)
        return taken.mass

    def apply(self, link: Link) -> Link:
        """The link with its new inertial."""
        changed = self._changed.get(id(link))
        return link if changed is None else link.copy(inertial=changed)

    def _graph(self, root: Model) -> FrameGraph:
        return self._graphs.setdefault(id(root), FrameGraph(root))


class SplitMassless(Pass):
    """Give bodies that move and weigh nothing a mass, so that simulators neither drop them nor divide by zero.

    A body is what fixed joints hold together.

    Changes bodies of which no link has a positive mass:

    1. a body that carries others by joints: it takes the part `share` of the nearest one with a mass, as if that had
       been split: with the joints at zero, mass, center of mass and inertia of the whole robot stay what they were;
    2. a body that carries nothing of any mass: with `ends=weigh` it gets a ball of `mass` and `radius` at the origin of
       its link, with `ends=fix` the joint that moves it becomes a fixed one, unless others mimic it.

    Bodies without an `<inertial>` are those of URDF; in SDF they weigh 1 kg, and a mass of zero has to be written.
    Never touches: bodies that weigh something, but for what they give, and what cannot move.
    Diagnostics: `split-mass` for case 1, and `token-mass` for case 2.
    """

    name = "split-massless"
    example: ClassVar[str] = "split-massless{share=0.05},check-inertia"

    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only bodies that have a link"))
    share: float = Field(default=0.01, gt=0, lt=1, description="The part of the carried body that the carrier takes.")
    ends: Literal["weigh", "fix"] = Field(
        default="weigh", description="Whether the end of a chain gets a small ball, or its joint is fixed."
    )
    mass: float = Field(default=0.001, ge=1e-50, le=1e50, description="The mass of the ball, in kg.")
    radius: float = Field(default=0.01, ge=1e-50, le=1e50, description="The radius of the ball, in m.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document without bodies that weigh nothing."""
        bodies = moving_bodies(document)
        light = [body for body in bodies if self._is_meant(body) and not _weighs(body, document.format)]
        if not light:
            return document
        tree, masses, fixed = _BodyTree(document), Masses(document), set[int]()
        for body in light:
            donor = tree.nearest_carried(body, masses)
            taker = tree.carrier(body)
            if donor is not None and self._split(donor, taker, masses, sink):
                continue
            joints = tree.moving(body)
            if self.ends == "fix" and joints and not tree.leads(joints):
                fixed.update(map(id, joints))
                _report_fixed(taker, joints, sink)
            else:
                self._weigh(taker, masses, sink)

        def fix(joint: Joint) -> Joint:
            return joint.copy(type="fixed", axis=None, axis2=None) if id(joint) in fixed else joint

        document = rewrite(document, Joint, fix)
        return rewrite(document, Link, masses.apply)

    def _is_meant(self, body: Body) -> bool:
        return any(matches(link.name, self.links) for link in body)

    def _split(self, donor: Link, taker: Link, masses: Masses, sink: DiagnosticSink) -> bool:
        """Move a share of the mass of one link to another; false where their poses are unknown."""
        try:
            mass = masses.share(donor, taker, self.share)
        except FrameError:
            return False
        message = f"link {taker.name!r}, which weighs nothing, took {mass:.4g} kg of what {donor.name!r} weighs"
        sink.report(SPLIT_MASS, message, taker.location, found="0 kg", related=(donor.location,))
        return True

    def _weigh(self, link: Link, masses: Masses, sink: DiagnosticSink) -> None:
        masses.give(link, with_mass(solid(Sphere(radius=self.radius), 1.0) or NOTHING, self.mass))
        message = (
            f"link {link.name!r}, which moves and weighs nothing, got a ball of {self.mass:g} kg and {self.radius:g} m"
        )
        sink.report(TOKEN_MASS, message, link.location, found="0 kg")


class _BodyTree:
    """Which body carries which, and by which joints; bodies are known by the identity of their first links."""

    def __init__(self, document: Document) -> None:
        self._carried: dict[int, list[ConnectedBodies]] = {}
        self._moving: dict[int, list[Joint]] = {}
        self._leaders: set[str] = set()
        for each in neighbors(document):
            self._moving.setdefault(id(each.child[0]), []).append(each.joint)
            axes = (each.joint.axis, each.joint.axis2)
            self._leaders.update(axis.mimic.joint or "" for axis in axes if axis and axis.mimic)
            if each.parent:
                self._carried.setdefault(id(each.parent[0]), []).append(each)

    def leads(self, joints: list[Joint]) -> bool:
        """Whether other joints mimic one of these joints."""
        return any(joint.name in self._leaders for joint in joints)

    def moving(self, body: Body) -> list[Joint]:
        """The joints whose child is the body."""
        return self._moving.get(id(body[0]), [])

    def carrier(self, body: Body) -> Link:
        """The link by which a body is held, or its first one."""
        ends = {joint.child for joint in self.moving(body)}
        return next((link for link in body if link.name in ends), body[0])

    def nearest_carried(self, body: Body, masses: Masses) -> Link | None:
        """The heaviest link of the nearest carried body that has a mass to give."""
        seen, queue = {id(body[0])}, [body]
        for each in queue:  # grows while it is walked
            for one in self._carried.get(id(each[0]), []):
                able = [link for link in one.child if masses.can_give(link)]
                if able:
                    return max(able, key=masses.mass)
                if id(one.child[0]) not in seen:
                    seen.add(id(one.child[0]))
                    queue.append(one.child)
        return None


def _weighs(body: Body, format_: Format) -> bool:
    return any(_has_mass(link, format_) for link in body)


def _has_mass(link: Link, format_: Format) -> bool:
    """Whether a link has a mass: its own, the default of SDF, or a computed one."""
    inertial = link.inertial
    if inertial is None or inertial.mass is None:
        return format_ is Format.SDF
    return bool(inertial.auto) or has_mass(inertial)


def _link_addresses(document: Document) -> Iterator[tuple[int, _LinkAddress]]:
    for root in outer_models(document):
        yield from ((id(link), _LinkAddress(root, name)) for name, link in scoped_links(root))


def _scale_inertial(inertial: Inertial, matrix: Symmetric, factor: float) -> Inertial:
    """The inertial with mass and inertia multiplied by a factor."""
    xx, yy, zz, xy, xz, yz = (factor * each for each in matrix)
    inertia = with_tensor(inertial.inertia, (xx, yy, zz, xy, xz, yz))
    return inertial.copy(mass=(inertial.mass or 0.0) * factor, inertia=inertia)


def _report_fixed(link: Link, joints: list[Joint], sink: DiagnosticSink) -> None:
    names = " and ".join(repr(joint.name) for joint in joints)
    message = f"joint {names} is fixed now: link {link.name!r} weighs nothing and carries nothing"
    sink.report(TOKEN_MASS, message, joints[0].location, found="0 kg")
