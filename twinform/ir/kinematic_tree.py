"""`KinematicTree`: links and joints by name, and what hangs from what."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple, TypeVar

from twinform.ir.document import World
from twinform.ir.frames import WORLD, FrameGraph
from twinform.ir.joint import Joint
from twinform.ir.link import Link
from twinform.ir.model import Model, look_up
from twinform.ir.motion import spanning_tree
from twinform.ir.scopes import SCOPE, scoped_models

AnyPart = TypeVar("AnyPart")


class JointBetween(NamedTuple):
    """A joint with the links that its two ends move with; a joint may name frames instead of links."""

    name: str
    type: str
    parent: str
    child: str
    joint: Joint


class KinematicTree:
    """The links and joints of a model or world.

    Those of nested models are called `inner::link`, as they are in the scope of the whole. Of several with one name the
    first is meant. Of joints that close a loop the first of the innermost model is in the tree; `closing` has others.

    Attributes:
        links: by their names, in the order of the file.
        joints: by their names, in the order of the file.
        frames: where all of these are.
        closing: the joints that are not in the tree: they would give a link a second parent, or make a circle.

    Raises:
        FrameError: an end of a joint is not known, or frames go round in a circle.
    """

    # What hangs from what needs the frames of the whole model. A method of a frozen node would
    # resolve them at each call, or keep them where nobody sees it.
    def __init__(self, holder: Model | World) -> None:
        scopes = [*_scopes(holder)]
        self.frames = FrameGraph(holder)
        self.links: Mapping[str, Link] = _by_name(
            (prefix + link.name, link) for prefix, each in scopes if isinstance(each, Model) for link in each.links
        )
        self.joints: Mapping[str, Joint] = _by_name(
            (prefix + joint.name, joint) for prefix, each in scopes for joint in each.joints
        )
        between = [found for prefix, each in scopes for found in _between(each, prefix, self.frames)]
        self._above = spanning_tree(between)
        self._below: dict[str, list[JointBetween]] = defaultdict(list)
        for each in between:
            if self._above.get(each.child) is each:
                self._below[each.parent].append(each)
        self.closing = tuple(each for each in between if self._above.get(each.child) is not each)

    def link(self, name: str) -> Link:
        """The link of a name.

        Raises:
            KeyError: there is none; the message has the name that may be meant.
        """
        return look_up(self.links, name, "link")

    def joint(self, name: str) -> Joint:
        """The joint of a name.

        Raises:
            KeyError: there is none; the message has the name that may be meant.
        """
        return look_up(self.joints, name, "joint")

    @property
    def roots(self) -> tuple[str, ...]:
        """The links that hang from no other link: one in a robot of URDF."""
        return tuple(name for name in self.links if self.parent(name) not in self.links)

    def joint_above(self, link: str) -> JointBetween | None:
        """The joint that a link hangs from; None where it hangs from nothing.

        Raises:
            KeyError: there is no such link.
        """
        self._look_up(link)
        return self._above.get(link)

    def joints_below(self, link: str) -> tuple[JointBetween, ...]:
        """The joints that hang from a link, or from `world`, in the order of the file.

        Raises:
            KeyError: there is no such link.
        """
        self._look_up(link)
        return tuple(self._below.get(link, ()))

    def parent(self, link: str) -> str | None:
        """The link, or `world`, that a link hangs from; None where it hangs from nothing.

        Raises:
            KeyError: there is no such link.
        """
        above = self.joint_above(link)
        return above.parent if above else None

    def children(self, link: str) -> tuple[str, ...]:
        """The links that hang from a link.

        Raises:
            KeyError: there is no such link.
        """
        return tuple(each.child for each in self.joints_below(link))

    def below(self, link: str) -> Iterator[str]:
        """Return the link and all links that move with it, parents first.

        Raises:
            KeyError: there is no such link.
        """
        self._look_up(link)
        waiting = [link]
        while waiting:
            here = waiting.pop()
            yield here
            waiting += [each.child for each in reversed(self._below.get(here, ()))]

    def chain(self, base: str, tip: str) -> tuple[JointBetween, ...]:
        """Return the joints between a link and a descendant of it, in order.

        Raises:
            KeyError: there is no such link.
            ValueError: the tip does not hang from the base.
        """
        self._look_up(base)
        found, here = list[JointBetween](), tip
        while here != base:
            above = self.joint_above(here)
            if above is None:
                raise ValueError(f"{tip!r} does not hang from {base!r}")
            found.append(above)
            here = above.parent
        return tuple(reversed(found))

    def _look_up(self, link: str) -> None:
        if link != WORLD or WORLD in self.links:
            self.link(link)


def _scopes(holder: Model | World) -> Iterator[tuple[str, Model | World]]:
    """Yield a model or world and all models inside it, each with the prefix of its names."""
    yield "", holder
    for model in holder.models:
        yield from scoped_models(model, model.name + SCOPE)


def _between(holder: Model | World, prefix: str, frames: FrameGraph) -> Iterator[JointBetween]:
    for joint in holder.joints:
        if joint.parent and joint.child:
            parent, child = (_body_at_end(joint, name, prefix, frames) for name in (joint.parent, joint.child))
            yield JointBetween(prefix + joint.name, joint.type, parent, child, joint)


def _body_at_end(joint: Joint, name: str, prefix: str, frames: FrameGraph) -> str:
    scoped = name if name == WORLD and not frames.knows(prefix + name) else prefix + name
    return frames.body(scoped, source=joint.source)


def _by_name(parts: Iterable[tuple[str, AnyPart]]) -> dict[str, AnyPart]:
    found: dict[str, AnyPart] = {}
    for name, part in parts:
        found.setdefault(name, part)
    return found
