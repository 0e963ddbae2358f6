"""Where Gazebo does something else with the `<gazebo>` tags of a URDF than with the SDF made of it."""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir import Element, Format, Model
from twinform.passes.carriers.annotations import came_from
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.frame_links import is_massless
from twinform.passes.legalise.to_sdf.gazebo_sorting import place_of
from twinform.passes.shared.gazebo_tags import FALSE, lumped_links
from twinform.passes.structure.gazebo_blocks import (
    BODY_FLAGS,
    block_content,
    blocks_by_reference,
    body_settings,
    shape_elements,
)
from twinform.passes.structure.tag_shapes import KINDS, find_early_static, seen_shapes, tagging_links, unread_tags

_USUAL = FALSE | {"0.0"}
"""What says no more than a flag that is not there."""


class NoteLumping(ModelPass):
    """Report `<gazebo>` tags that Gazebo applies to more, or to less, where it reads the URDF itself.

    1. It makes one body of links that are fixed to each other, and a flag of one of them, such as `turnGravityOff`,
    is one of the body; in SDF it is one of the link. Links that become frames do not count. 2. It applies tags about
    shapes to those alone whose names begin with that of their link, and to none if it reads them wrong; in SDF all
    shapes have them. 3. Some of its releases forget `<static>` where a later `<gazebo>` does not repeat it.
    Changes: nothing.
    Diagnostics: `lumped-flag`, for information where the other link is a root without mass; `unreached-shape`;
    `early-static`.
    """

    name: ClassVar[str] = "note-lumping"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The same model."""
        # No author means either: a flag of one link that works on all that is fixed to it, or a tag
        # that misses a shape for its name. So our SDF has what is written, and this pass says where
        # Gazebo reads the URDF in another way.
        if model.extensions and not came_from(model, Format.SDF):
            hosts = lumped_links(model)
            _report_flags(model, hosts, sink)
            find_early_static(model, sink)
            for field in KINDS:
                _report_shapes(model, field, hosts, sink)
        return model


def _report_flags(model: Model, hosts: Mapping[str, str], sink: DiagnosticSink) -> None:
    """Report flags that are not those of the whole body that Gazebo makes."""
    own = _settings(model)
    if not own:
        return
    alike = defaultdict[tuple[str, str], dict[str, list[str]]](dict)
    massless = {link.name for link in model.links if is_massless(link)}
    for link in sorted(model.links, key=lambda link: link.name in massless):
        if link.name in massless and hosts[link.name] != link.name:  # which becomes a frame
            continue
        for flag in set(BODY_FLAGS.values()):
            alike[hosts[link.name], flag].setdefault(own.get(link.name, {}).get(flag, ""), []).append(link.name)
    for extension in model.extensions:
        name = extension.reference or ""
        for element in extension.content:
            flag = BODY_FLAGS.get(element.name, "")
            mine = own.get(name, {}).get(flag)
            others = [names[0] for value, names in alike[hosts.get(name, ""), flag].items() if value != mine]
            if others and mine is not None:
                other = min(others, key=massless.__contains__)
                # A massless root such as base_footprint has nothing that gravity could act on.
                severity = Severity.INFO if other in massless else Severity.WARNING
                message = (
                    f"<{element.name}> is about link {name!r} alone in SDF; where Gazebo reads the URDF, "
                    f"it is also about what is fixed to it, such as {other!r}"
                )
                where = place_of(element, extension)
                sink.report(rules.LUMPED_FLAG, message, where, found=element.name, severity=severity)


def _settings(model: Model) -> dict[str, dict[str, str]]:
    """The flags of each link that are not the usual ones, as text."""
    links = {link.name for link in model.links}
    found = defaultdict[str, list[Element]](list)
    for extension in model.extensions:
        flags = [element for element in extension.content if element.name in BODY_FLAGS]
        if flags and extension.reference in links:
            found[extension.reference] += flags
    return {
        name: {flag: _text(value) for flag, value in body_settings(elements).items()}
        for name, elements in found.items()
    }


def _text(value: object) -> str:
    if isinstance(value, Element):
        return " ".join(f"{each.name} {each.text or ''}" for each in value.walk())
    return str(value)


def _report_shapes(model: Model, field: str, hosts: Mapping[str, str], sink: DiagnosticSink) -> None:
    """Report shapes to which Gazebo applies other tags than those of their link."""
    there = {name: extensions for name, extensions in blocks_by_reference(model.extensions).items() if name}
    tags = {name: words for name in there if (words := _words(shape_elements(block_content(there, name), field)))}
    if not tags:
        return
    for seen in seen_shapes(model, field):
        seen_by = tagging_links(seen, KINDS[field], hosts) & tags.keys()
        own = {seen.link} & tags.keys()
        unread = _words(unread_tags(there[seen.link], field)) if own and seen_by == own else ""
        if seen_by == own and not unread:
            continue
        shape = f"the {KINDS[field]} {seen.shape.name!r}" if seen.shape.name else f"a {KINDS[field]} without a name"
        if own:
            words = unread or tags[seen.link]
            message = f"Gazebo does not apply {words} to {shape} of link {seen.link!r}; in SDF it has them"
        else:
            words = f"{tags[min(seen_by)]} of link {min(seen_by)!r}"
            message = f"Gazebo applies {words} to {shape} of link {seen.link!r}; in SDF it has none"
        sink.report(rules.UNREACHED_SHAPE, message, seen.shape.location, found=seen.shape.name)


def _words(elements: Iterable[Element]) -> str:
    """What elements are called, each once."""
    return ", ".join(dict.fromkeys(f"<{element.name}>" for element in elements))
