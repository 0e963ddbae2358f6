"""Kept elements of MJCF that fit nothing any more: they go, and are reported as stale.

An actuator, a sensor, a tendon or a constraint is nothing without what it is about, and neither is what is about that.
So is a camera or light that follows a body, a geom without the mesh or terrain that is its shape, and what is about a
joint that has another type or no limits now.
"""

from collections.abc import Iterable, Iterator
from functools import cached_property

from twinform.ir import Element
from twinform.ir.frames import WORLD
from twinform.passes.legalise.to_mjcf.kept_mjcf import NO_SECTION, SINGLE
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.schemas.mjcf_references import (
    KINDS,
    OF_LIMITS,
    WITH_COORDINATES,
    kind_of_tag,
    most_coordinates,
    naming_attributes,
    takes,
)

_MAKERS = frozenset({"composite", "flexcomp"})
"""Elements of which MuJoCo makes parts with names of its own."""
_MADE = frozenset(KINDS.values())
_SCENE = frozenset({"worldbody", "asset"})
"""Sections whose elements are something without what they name."""
_UNASKED = _SCENE | SINGLE | {NO_SECTION}
"""Settings name no parts, and what stands beside the sections, as in a file to include, names parts of other files."""
_NEEDED = ("target", "mesh", "hfield")
"""What an element of a body is nothing without: what a camera or light follows, and the asset that a geom shows."""
_MOVING = frozenset({"joint", "freejoint"})
Name = tuple[str, str]
"""The kind and the name of a part."""


def drop_dangling_parts(context: MjcfContext) -> None:
    """Leave out what names a part that is not there or is another one. All sections are complete but for the texts."""
    scene = context.sections.get("worldbody", ())
    made = _MADE if any(each.name in _MAKERS for body in scene for each in body.walk()) else frozenset[str]()
    left = _Left(context, made)
    for name in _SCENE & context.sections.keys():
        context.sections[name] = [*left.among(context.sections[name])]
    # What names an element that has gone goes too.
    left = _Left(context, made)
    while left.drop_once():
        continue


class _Left:
    """What is left of the sections; of kinds that are `made`, names may be none of the file."""

    def __init__(self, context: MjcfContext, made: frozenset[str]) -> None:
        self._context = context
        self._made = made
        self._there = frozenset(_named(context))

    def drop_once(self) -> bool:
        """Leave out the elements of all sections that name nothing, and tell whether there were any."""
        has_gone = False
        for section, elements in self._context.sections.items():
            if section in _UNASKED:
                continue
            kept = [each for each in elements if not self._is_stale(each)]
            has_gone = has_gone or len(kept) < len(elements)
            elements[:] = kept
        self._there = frozenset(_named(self._context)) if has_gone else self._there
        return has_gone

    def in_scene(self, element: Element) -> Element:
        """An element of a body, and those in it, without attributes that name nothing."""
        gone = dict(self._gone(element))
        for name in gone.values():
            self._report(element, _is_gone(name))
        attributes = tuple(pair for pair in element.attributes if pair[0] not in gone)
        return element.copy(attributes=attributes, children=self.among(element.children))

    def among(self, elements: Iterable[Element]) -> tuple[Element, ...]:
        """Those of some elements of bodies that do not follow or show something which is not there."""
        return tuple(self.in_scene(each) for each in elements if not self._is_nothing(each))

    def _is_nothing(self, element: Element) -> bool:
        gone = dict(self._gone(element))
        found = next((gone[key] for key in _NEEDED if key in gone), None)
        if found is not None:
            self._report(element, _is_gone(found))
        return found is not None

    def _is_stale(self, element: Element) -> bool:
        why = next((why for each in element.walk() for why in self._reasons(each)), None)
        if why is not None:
            self._report(element, why)
        return why is not None

    def _reasons(self, element: Element) -> Iterator[str]:
        """Yield why an element does not fit what there is."""
        for _, name in self._gone(element):
            yield _is_gone(name)
        attributes = dict(element.attributes)
        for key, kind in naming_attributes(element.name, attributes):
            called = attributes[key]
            joint = self._joints.get(called) if kind == "joint" else None
            if joint is not None and not takes(element.name, _type_of(joint)):
                yield f"kept for joint {called!r}, which is of type {_type_of(joint)!r} now"
            limited = joint or self._tendons.get(called) if OF_LIMITS.get(element.name) == kind else None
            if limited is not None and limited.get("limited") != "true":
                yield f"kept for the limits of {kind} {called!r}, which has none now"
        if element.name == "key" and self._most is not None:
            for name, most in self._most.items():
                if (count := len((element.get(name) or "").split())) > most:
                    yield f"kept for {count} coordinates, and the joints have {most} now"

    def _gone(self, element: Element) -> Iterator[tuple[str, Name]]:
        """Yield the attributes of an element that name a part which is not there, with that part."""
        attributes = dict(element.attributes)
        for key, kind in naming_attributes(element.name, attributes):
            name = (kind, attributes[key])
            if not (name in self._there or kind in self._made or name == ("body", WORLD)):
                yield key, name

    @cached_property
    def _joints(self) -> dict[str, Element]:
        """The joints of the file by their names."""
        return {name: each for each in _all_joints(self._context) if (name := each.get("name"))}

    @cached_property
    def _tendons(self) -> dict[str, Element]:
        """The tendons of the file by their names."""
        return {each.get("name") or "": each for each in self._context.sections.get("tendon", ())}

    @cached_property
    def _most(self) -> dict[str, int] | None:
        """How many numbers the attributes of a keyframe may have; None where that is not known."""
        found = (each.name for section in self._context.sections.values() for outer in section for each in outer.walk())
        if not WITH_COORDINATES.isdisjoint(found):
            return None
        return most_coordinates(map(_type_of, _all_joints(self._context)))

    def _report(self, element: Element, why: str) -> None:
        where = element.location if element.source else self._context.holder.location
        own = f" {found}" if (found := element.get("name")) else ""
        self._context.drop_stale(f"<{element.name}>{own} is {why}", where, element.name)


def _is_gone(name: Name) -> str:
    kind, called = name
    return f"kept for {kind} {called!r}, which is not there any more"


def _all_joints(context: MjcfContext) -> Iterator[Element]:
    """Yield the joints of all bodies."""
    bodies = (body for body in context.sections.get("worldbody", ()) if body.name == "body")
    return (each for body in bodies for each in body.walk() if each.name in _MOVING)


def _type_of(joint: Element) -> str:
    return "free" if joint.name == "freejoint" else joint.get("type") or "hinge"


def _named(context: MjcfContext) -> Iterator[Name]:
    """Yield the kinds and names of all parts of the file."""
    for section, elements in context.sections.items():
        for outer in elements:
            for each in outer.walk() if section == "worldbody" else (outer,):
                kind, name = kind_of_tag(each.name, section), each.get("name")
                if kind and name:
                    yield kind, name
