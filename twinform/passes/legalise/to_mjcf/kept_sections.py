"""What models keep of sections of MJCF, such as actuators and tendons, added to those sections with today's names.

A model of SDF that was read of MJCF keeps `<tf:mjcf><actuator><motor joint="hip"/></actuator></tf:mjcf>`, and one that
was given actuators by a pass does too. In a world with several models the joint is called otherwise in MJCF.
"""

from collections.abc import Mapping

from twinform.diagnostics import rules
from twinform.ir import Element
from twinform.ir.scopes import SCOPE
from twinform.passes.legalise.to_mjcf.assets import file_path
from twinform.passes.legalise.to_mjcf.kept_mjcf import (
    KNOWN,
    LIMITED,
    NO_SECTION,
    SINGLE,
    TARGETS,
    WITHOUT_CONTROL_LIMIT,
    asset_name,
    kept_elements,
    merged,
)
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.passes.shared.document_uris import FILES_OF_MJCF
from twinform.schemas.facts import named_kinds

_RENAMED = frozenset({"joint", "body", "site"})
"""The kinds of parts that may have another name in MJCF than where they were kept."""
_BY_TYPE: Mapping[str, str] = {"objname": "objtype", "refname": "reftype"}
"""Attributes that name a part whose kind stands in another one."""
_LIMITED_SECTIONS = frozenset({"actuator", "tendon"})
"""Sections whose elements have ranges."""


class _Names:
    """The names that parts have in MJCF, by their kinds and scoped names, and by their own where only one has it.

    What is kept has the names of the file that it was read from, of which SDF could not have some.
    """

    def __init__(self, context: MjcfContext) -> None:
        # of several joints that stand for one, the last has its name
        joints = {name: written[-1] for name, written in context.written_joints.items() if written}
        kinds = {"joint": joints, "body": context.written_bodies, "site": context.written_sites}
        self._scoped: dict[tuple[str, str], str] = {}
        self._alone: dict[tuple[str, str], str | None] = {}
        for kind, names in kinds.items():
            for name, written in names.items():
                self._scoped[kind, name] = written
                self._scoped[kind, written] = written
                key = (kind, written.rpartition(SCOPE)[2])
                self._alone[key] = None if key in self._alone else written
        for (kind, name), now in context.former_names.items():
            written = kinds[kind].get(context.scope_of(name) + now)
            if written is not None:
                self._scoped.setdefault((kind, name), written)

    def of(self, kind: str, scope: str, name: str) -> str:
        """The name in MJCF of a part that is called so in a scope."""
        return self._scoped.get((kind, scope + name)) or self._alone.get((kind, name)) or name


def add_kept_sections(context: MjcfContext) -> bool:
    """Add what the holder and all models in it keep, and tell whether that is anything.

    All other sections are complete.
    """
    inner = [(scope, each) for scope, each in context.models if each is not context.holder]
    names, sections = _Names(context), _Sections(context)
    holders = (("", context.holder), *inner)
    for scope, each in holders:
        for kept in kept_elements(each):
            if kept.name in SINGLE:
                context.add(kept.name, kept)
                continue
            if kept.name not in KNOWN:
                context.add(NO_SECTION, kept)
                continue
            for part in kept.children:
                renamed = _renamed(part, names, scope)
                if kept.name == "actuator":
                    _check_target(context, renamed)
                if kept.name in _LIMITED_SECTIONS:
                    renamed = _with_limits(renamed)
                sections.add(kept.name, _with_paths(context, renamed) if kept.name == "asset" else renamed)
    for scope, reading in context.kept_readings:
        sections.add("sensor", _renamed(reading, names, scope))
    return bool(context.kept_readings) or any(kept_elements(each) for _, each in holders)


def _check_target(context: MjcfContext, actuator: Element) -> None:
    """Report an actuator from which somebody has taken what it drives: MuJoCo refuses it."""
    if actuator.name != "plugin" and not any(actuator.get(name) for name in TARGETS):
        where = actuator.location if actuator.source else context.holder.location
        message = f"<{actuator.name}> {actuator.get('name') or ''}".rstrip() + " is kept, and drives nothing"
        help_ = f"name what it drives, with {', '.join(TARGETS[:-1])} or {TARGETS[-1]}, or take it out"
        context.sink.report(rules.MISSING_ATTRIBUTE, message, where, help=help_)


def _with_limits(element: Element) -> Element:
    """The element, whose ranges limit unless it says otherwise, as they do in MuJoCo."""
    attributes = dict(element.attributes)
    limits = LIMITED.keys() - ({"range"} if element.name == "muscle" else ())  # that is the range of its length
    limits -= {"ctrlrange"} if element.name in WITHOUT_CONTROL_LIMIT else set()
    bare = [name for name in attributes if name in limits and LIMITED[name] not in attributes]
    said = ((LIMITED[name], "true" if _rises(attributes[name]) else "false") for name in bare)
    return element.copy(attributes=(*element.attributes, *said)) if bare else element


def _rises(value: str) -> bool:
    try:
        lower, upper = map(float, value.split())
    except ValueError:
        return False
    return lower < upper


class _Sections:
    """The sections of a context, where an element joins the one of its name, such as a material that visuals have."""

    def __init__(self, context: MjcfContext) -> None:
        self._sections = context.sections
        self._places = {
            (section, each.name, each.get("name")): place
            for section, elements in context.sections.items()
            for place, each in enumerate(elements)
        }

    def add(self, section: str, element: Element) -> None:
        """Add an element to a section."""
        there, key = self._sections[section], (section, element.name, element.get("name"))
        if key[-1] and key in self._places:
            place = self._places[key]
            there[place] = merged(there[place], element)
            return
        self._places[key] = len(there)
        there.append(element)


def _with_paths(context: MjcfContext, asset: Element) -> Element:
    """The asset with its name, and paths from the folder of the document, which another format may have as URIs."""
    paths = {key: file_path(context, value, asset.location) for key, value in asset.attributes if key in FILES_OF_MJCF}
    attributes = tuple((key, paths.get(key, value)) for key, value in asset.attributes)
    if asset.get("name") or not (name := asset_name(asset)):
        return asset.copy(attributes=attributes)
    return asset.copy(attributes=(("name", name), *attributes))


def _renamed(element: Element, names: _Names, scope: str) -> Element:
    """The element with the names that the parts of its model have in MJCF."""
    attributes = tuple(
        (key, names.of(kind, scope, value) if (kind := _kind(element, key)) else value)
        for key, value in element.attributes
    )
    return element.copy(
        attributes=attributes, children=tuple(_renamed(each, names, scope) for each in element.children)
    )


def _kind(element: Element, attribute: str) -> str | None:
    """The kind of part that an attribute of an element names."""
    if attribute in _BY_TYPE:
        return (element.get(_BY_TYPE[attribute]) or "").removeprefix("x")
    kind = named_kinds("mjcf").get(attribute)
    return kind if kind in _RENAMED else None
