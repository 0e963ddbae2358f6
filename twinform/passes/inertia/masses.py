"""Masses of the links of a document during a pass, and moving a share of one to another."""

from collections.abc import Iterator
from typing import NamedTuple

from twinform.ir import Document, Inertial, Link, Model
from twinform.ir.defaults import MOMENT
from twinform.ir.frames import FrameGraph
from twinform.ir.principal_moments import Symmetric
from twinform.ir.scopes import outer_models, scoped_links
from twinform.ir.solids import NOTHING, ORIGIN, Solid, placed, with_mass, with_tensor
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes.analyses.link_shapes import inertial_of
from twinform.passes.inertia.physical_consistency import is_possible


class _LinkAddress(NamedTuple):
    """Where a link is: the model at the root, and the link's name in it."""

    root: Model
    name: str


class Masses:
    """What the links of a document have by now. Links are known by their identity: equal ones are still two."""

    def __init__(self, document: Document) -> None:
        self._default = MOMENT[document.format]
        self._format = document.format
        self._addresses = dict(_addresses(document))
        self._graphs: dict[int, FrameGraph] = {}
        self._changed: dict[int, Inertial] = {}

    def of(self, link: Link) -> Inertial | None:
        """The inertial of a link."""
        return self._changed.get(id(link), link.inertial)

    def can_give(self, link: Link) -> bool:
        """Whether a link was written with a mass and an inertia that can be divided; what it was given is its own."""
        inertial = link.inertial
        return inertial is not None and not inertial.auto and is_possible(inertial, self._format)

    def mass(self, link: Link) -> float:
        """What a link weighs, in kg; zero where nothing is written."""
        inertial = self.of(link)
        return inertial.mass or 0.0 if inertial else 0.0

    def give(self, link: Link, what: Solid) -> None:
        """Set what a link weighs to a solid in its own frame."""
        self._changed[id(link)] = inertial_of(what, link.inertial)

    def share(self, donor: Link, taker: Link, part: float) -> float:
        """Let a link take a part of what another weighs, at the place that it has with the joints at zero.

        Gives the mass that it took, in kg.

        Raises:
            FrameError: where the links are cannot be resolved.
        """
        inertial = self.of(donor) or Inertial()
        mass, matrix = inertial.mass or 0.0, inertia_matrix(inertial.inertia, self._default) or NOTHING.inertia
        address = self._addresses[id(donor)]
        graph = self._graph(address.root)
        at = graph.resolve(inertial.pose, address.name, self._addresses[id(taker)].name)
        # As if the body had been split at the joint: mass, center of mass and inertia at the zero
        # position stay exactly what they were. A token mass would change the robot, and is too
        # little for some solvers and too much for others.
        taken = placed(with_mass(Solid(mass, ORIGIN, matrix), part * mass), at)
        self._changed[id(donor)] = _scaled(inertial, matrix, 1 - part)
        self.give(taker, taken)
        return taken.mass

    def applied(self, link: Link) -> Link:
        """The link with what it has by now."""
        changed = self._changed.get(id(link))
        return link if changed is None else link.copy(inertial=changed)

    def _graph(self, root: Model) -> FrameGraph:
        return self._graphs.setdefault(id(root), FrameGraph(root))


def _addresses(document: Document) -> Iterator[tuple[int, _LinkAddress]]:
    for root in outer_models(document):
        yield from ((id(link), _LinkAddress(root, name)) for name, link in scoped_links(root))


def _scaled(inertial: Inertial, matrix: Symmetric, factor: float) -> Inertial:
    """Return the inertial with mass and inertia scaled by a factor, so that their distribution stays."""
    xx, yy, zz, xy, xz, yz = (factor * each for each in matrix)
    inertia = with_tensor(inertial.inertia, (xx, yy, zz, xy, xz, yz))
    return inertial.copy(mass=(inertial.mass or 0.0) * factor, inertia=inertia)
