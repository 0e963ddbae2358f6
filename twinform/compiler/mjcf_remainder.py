"""What only MJCF says of a robot, for files that follow a URDF or SDF: actuators, armatures, sites.

No other format has words for it, so that a source which says nothing of it has not taken it away. It is left out of
what a file of MJCF is compared with, stays where a part of the text is changed, and goes along where a file is written
anew: what is kept of a link, joint or shape goes to the one of the same name.
"""

from collections.abc import Iterable, Iterator, Mapping
from math import degrees
from typing import ClassVar, Self, TypeVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Collision,
    Document,
    Element,
    Frame,
    Joint,
    Link,
    Model,
    Node,
    Opaque,
    Visual,
    replace_fields,
    rewrite,
)
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import MADE_NAME, find_annotation
from twinform.passes.carriers.carriers import ROOT
from twinform.passes.carriers.old_names import NAME
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.to_mjcf.elements import make_element, placement
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT, with_kept
from twinform.schemas import XmlElement, format_value

Part = TypeVar("Part", Link, Joint, Frame, Visual, Collision, Model)
_SITE = "site"


class DropKept(Pass):
    """Leave out what only MJCF says, which another file says better.

    Changes: elements that keep MJCF are gone from all nodes.
    Never touches: anything else.
    Diagnostics: none.
    """

    name: ClassVar[str] = "drop-kept"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """Return the document without what is kept of MJCF."""
        del sink
        return rewrite(document, Node, _without_kept)


def _without_kept(node: Node) -> Node:
    parts = tuple(each for each in node.opaque if each.element is None or each.element.name != KEPT)
    return replace_fields(node, opaque=parts) if len(parts) < len(node.opaque) else node


def without_own_sites(before: Document, after: Document) -> Document:
    """Return a document of MJCF without the sites that another one lacks: the source has no words for most of them."""
    names = {each.get("name") for part in after.opaque for each in _sites(part.element)}
    parts = (each.copy(element=_without_sites(each.element, names)) if each.element else each for each in before.opaque)
    return before.copy(opaque=tuple(parts))


def _sites(element: Element | None) -> Iterator[Element]:
    return (each for each in element.walk() if each.name == _SITE) if element else iter(())


def _without_sites(element: Element, names: Iterable[str | None]) -> Element:
    children = (each for each in element.children if each.name != _SITE or each.get("name") in names)
    return element.copy(children=tuple(_without_sites(each, names) for each in children))


def is_in_degrees(root: XmlElement) -> bool:
    """Whether the angles of joints in a file of MJCF are degrees, which they are unless it says otherwise."""
    said = [each.get("angle") for each in root.iter("compiler") if each.get("angle")]
    return not said or said[-1] == "degree"


_ANGLES = frozenset({"range", "ref", "springref"})
"""The attributes of joints that are angles, unless the joint slides."""


def in_degrees(document: Document) -> Document:
    """Return a document of MJCF in radians with the angles of joints in degrees, as a file has them that follows it."""
    parts = (each.copy(element=_in_degrees(each.element)) if each.element else each for each in document.opaque)
    return document.copy(opaque=tuple(parts))


def _in_degrees(element: Element) -> Element:
    attributes = element.attributes
    if element.name == "joint" and element.get("type") != "slide":
        attributes = tuple((key, _degrees(text) if key in _ANGLES else text) for key, text in attributes)
    return element.copy(attributes=attributes, children=tuple(map(_in_degrees, element.children)))


def _degrees(text: str) -> str:
    """Write numbers in degrees, without the noise of the multiplication."""
    return format_value(tuple(float(f"{degrees(float(each)):.13g}") for each in text.split()))


class AdoptKept(Pass):
    """Give the parts of a document what an MJCF file keeps of parts that have the same names.

    Changes: 1. links, joints, shapes and the model get the elements of MJCF; 2. links get the sites that are in the
    file alone.
    Never touches: a part that keeps elements of MJCF itself.
    Diagnostics: none.
    """

    name: ClassVar[str] = "adopt-kept"

    # It has no entry point, so nobody but `sync` makes one.
    _old: Model

    @classmethod
    def of(cls, old: Model) -> Self:
        """Make a pass that takes from a model of an MJCF file, in the terms of SDF."""
        return cls.unchecked(_old=old)

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """Return the document with what the file keeps."""
        del sink
        first = next(iter(document.models), None)
        return rewrite(document, Model, lambda each: adopt_kept(each, self._old) if each is first else each)


def adopt_kept(model: Model, old: Model) -> Model:
    """Return a model with what another one keeps of parts that have the same names."""
    known = {each.name for part in (model.links, model.frames, model.joints) for each in part}
    links = {each.name: _with_sites(each, [one for one in old.frames if one.name not in known]) for each in old.links}
    return _adopt(model, old).copy(
        links=tuple(_adopt_in_link(each, links) for each in model.links),
        joints=_adopt_all(model.joints, old.joints),
        frames=_adopt_all(model.frames, old.frames),
    )


def _with_sites(link: Link, frames: Iterable[Frame]) -> Link:
    """Return a link with the frames on it as the sites that they are."""
    sites = [_site(each) for each in frames if each.attached_to == link.name and _is_in_link(each, link)]
    if not sites:
        return link
    body = Element.unchecked(name="body", children=tuple(sites))
    return link.copy(opaque=(*link.opaque, Opaque.unchecked(element=Element.unchecked(name=KEPT, children=(body,)))))


def _is_in_link(frame: Frame, link: Link) -> bool:
    return frame.pose is None or frame.pose.relative_to in {None, link.name}


def _site(frame: Frame) -> Element:
    site = make_element(_SITE, [("name", _name_in_mjcf(frame)), *placement(Transform.from_pose(frame.pose))])
    return with_kept(site, frame)


def _name_in_mjcf(frame: Frame) -> str | None:
    """Return the name of a site, which may also be that of a body, or None where the site has none."""
    if find_annotation(frame, MADE_NAME) is not None:
        return None
    other = find_annotation(frame, NAME)
    return frame.name if other is None else other.text


def _adopt_in_link(link: Link, before: Mapping[str, Link]) -> Link:
    old = before.get(link.name)
    if old is None:
        return link
    return _adopt(link, old).copy(
        visuals=_adopt_all(link.visuals, old.visuals), collisions=_adopt_all(link.collisions, old.collisions)
    )


def _adopt_all(parts: tuple[Part, ...], before: Iterable[Part]) -> tuple[Part, ...]:
    old = {each.name: each for each in before}
    return tuple(_adopt(each, old[each.name]) if each.name in old else each for each in parts)


def _adopt(part: Part, old: Part) -> Part:
    """Return a part with what another one keeps, unless it keeps something itself."""
    kept = tuple(_kept(old))
    return part if not kept or any(_kept(part)) else part.copy(opaque=(*part.opaque, *kept))


def _kept(node: Node) -> Iterator[Opaque]:
    """Yield what a node keeps, but for the mark of what was read of MJCF, which another source was not."""
    for part in node.opaque:
        if part.element is not None and part.element.name == KEPT:
            children = tuple(each for each in part.element.children if each.name != ROOT)
            if children:
                yield part.copy(element=part.element.copy(children=children))
