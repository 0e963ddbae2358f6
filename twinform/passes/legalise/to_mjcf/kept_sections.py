"""What models keep of sections of MJCF, such as actuators and tendons, added to those sections with today's names.

A model of SDF that was read of MJCF keeps `<tf:mjcf><actuator><motor joint="hip"/></actuator></tf:mjcf>`, and one that
was given actuators by a pass does too. In a world with several models the joint is called otherwise in MJCF.
"""

from collections.abc import Mapping

from twinform.ir import Element
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

SINGLE = frozenset({"compiler", "option", "size", "visual", "statistic"})
"""Sections that are one element with attributes: what is added to them is merged."""
_ONES: Mapping[str, str] = {
    **dict.fromkeys(("joint", "joint1", "joint2", "jointinparent"), "joint"),
    **dict.fromkeys(("body", "body1", "body2"), "body"),
    **dict.fromkeys(("site", "site1", "site2", "slidersite", "cranksite", "refsite"), "site"),
}
"""The kind of part that an attribute names."""


def add_kept_sections(context: MjcfContext) -> None:
    """Add what the holder and all models in it keep. All other sections are complete."""
    inner = [(scope, each) for scope, each in context.models if each is not context.holder]
    for scope, each in (("", context.holder), *inner):
        for kept in kept_elements(each):
            _add(context, kept, scope)


def _add(context: MjcfContext, kept: Element, scope: str) -> None:
    if kept.name in SINGLE:
        context.add(kept.name, kept)
        return
    for each in kept.children:
        context.add(kept.name, _renamed(context, each, scope))


def _renamed(context: MjcfContext, element: Element, scope: str) -> Element:
    """The element with the names that the parts of its model have in MJCF."""
    attributes = tuple((key, _name(context, _ONES.get(key), scope, value)) for key, value in element.attributes)
    children = tuple(_renamed(context, each, scope) for each in element.children)
    return element.copy(attributes=attributes, children=children)


def _name(context: MjcfContext, kind: str | None, scope: str, value: str) -> str:
    scoped = scope + value
    if kind == "joint":
        # of several joints that stand for one, the last has its name
        names = context.written_joints.get(scoped)
        return names[-1] if names else value
    if kind == "body":
        return context.written_bodies.get(scoped, value)
    if kind == "site":
        return scoped if scoped in context.names.get("site", ()) else value
    return value
