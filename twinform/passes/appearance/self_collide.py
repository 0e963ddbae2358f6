"""Let the links of a model touch each other, but for the pairs whose collisions an SRDF file disables."""

from collections.abc import Iterable, Iterator
from itertools import combinations
from typing import ClassVar

from lxml import etree
from pydantic import Field

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import NOTHING_MATCHED, UNREAD_DOCUMENT
from twinform.ir import Document, Element, Format, Link, Model, Opaque, rewrite
from twinform.passes.appearance.set_surface import set_tags
from twinform.passes.carriers.carriers import KEPT, declare_carriers
from twinform.passes.framework.assets import AssetError
from twinform.passes.framework.pass_base import AssetPass
from twinform.schemas import XmlElement

_LARGEST = 2**22
Pair = tuple[str, str]


class SelfCollide(AssetPass):
    """Let the links of a model touch each other, but for the pairs whose collisions an SRDF file disables.

    Gazebo and our MJCF let no links of one model touch, unless it is written that they do. MoveIt lets all of them
    touch, but for the pairs that its SRDF names.

    Changes models, nested ones too: 1. links with collisions get `self_collide`, in URDF as `selfCollide` of a
    `<gazebo>` element; 2. with `srdf`, the pairs of `disable_collisions`, and those of a link of
    `disable_default_collisions` that no `enable_collisions` names, are excluded in MJCF. URDF and SDF have no word for
    that, and keep it in an element of our own namespace.
    Never touches: links without collisions. Links that a joint connects never touch, in SDF and in our MJCF.
    Diagnostics: `unread-document` where the SRDF cannot be read; `nothing-matched` for a link of the SRDF that is not
    there, or that has no mass, whose shapes stand in the link that it is fixed to: nothing is excluded for it.
    """

    name: ClassVar[str] = "self-collide"
    example: ClassVar[str] = "self-collide"

    srdf: str | None = Field(
        default=None,
        min_length=1,
        description="The SRDF file, or xacro of one: a path from the folder of the model, or a `package://`.",
    )

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document whose links touch."""
        pairs = self._disabled(document, sink)
        if pairs is None:
            return document
        changed = rewrite(document, Model, lambda model: _touching(model, document.format))
        if not pairs:
            return changed
        known = {link.name for model in _models(changed) for link in model.links}
        for name in sorted({name for pair in pairs.named for name in pair} - known):
            _report(sink, document, name, f"no link is called {name!r}, which {self.srdf!r} names")
        excluded = rewrite(changed, Model, lambda model: _excluding(model, pairs, changed, sink))
        return changed if excluded is changed else declare_carriers(excluded)

    def _disabled(self, document: Document, sink: DiagnosticSink) -> "Disabled | None":
        """The pairs of the SRDF; none without one, and None after an error."""
        if self.srdf is None:
            return Disabled()
        try:
            text = self._assets.xml(self._assets.find(self.srdf), _LARGEST)
            root = etree.fromstring(text, etree.XMLParser(resolve_entities=False, no_network=True))
        except (AssetError, ValueError, etree.XMLSyntaxError) as error:
            message = f"{self.srdf!r} cannot be read: {error}"
            sink.report(UNREAD_DOCUMENT, message, document.location, found=self.srdf)
            return None
        return Disabled(
            tuple(_pairs(root.iterchildren("disable_collisions"))),
            tuple(each.get("link") or "" for each in root.iterchildren("disable_default_collisions")),
            frozenset(map(_sorted, _pairs(root.iterchildren("enable_collisions")))),
        )


@dataclass(frozen=True, slots=True)
class Disabled:
    """What an SRDF disables: pairs of links, and links that touch nothing but what is enabled."""

    named: tuple[Pair, ...] = ()
    alone: tuple[str, ...] = ()
    enabled: frozenset[Pair] = frozenset()

    def __bool__(self) -> bool:
        return bool(self.named or self.alone)

    def among(self, links: Iterable[str]) -> dict[Pair, None]:
        """Return the pairs of these links that do not touch, each once."""
        names = list(links)
        known, alone = set(names), set(self.alone)
        found = dict.fromkeys(_sorted(pair) for pair in self.named if known.issuperset(pair) and pair[0] != pair[1])
        kept = (_sorted(pair) for pair in combinations(names, 2) if not alone.isdisjoint(pair))
        return found | dict.fromkeys(pair for pair in kept if pair not in self.enabled)


def _pairs(elements: Iterable[XmlElement]) -> Iterator[Pair]:
    for each in elements:
        yield each.get("link1") or "", each.get("link2") or ""


def _sorted(pair: Pair) -> Pair:
    return (pair[0], pair[1]) if pair[0] <= pair[1] else (pair[1], pair[0])


def _models(document: Document) -> Iterator[Model]:
    pending = [*document.models, *(each for world in document.worlds for each in world.models)]
    while pending:
        model = pending.pop()
        yield model
        pending += model.models


def _touching(model: Model, format_: Format) -> Model:
    """The model with links that touch each other."""
    if format_ is Format.URDF:
        names = [link.name for link in model.links if link.collisions]
        return set_tags(model, names, {"selfCollide": "true"}) if names else model
    links = tuple(link.copy(self_collide=True) if link.collisions else link for link in model.links)
    return model.copy(links=links)


def _excluding(model: Model, disabled: Disabled, document: Document, sink: DiagnosticSink) -> Model:
    """The model with the pairs of its links that must not touch."""
    solid = [link for link in model.links if link.collisions]
    lent = {link.name for link in solid if document.format is Format.URDF and _is_lent(link, model)}
    pairs = disabled.among(link.name for link in solid)
    for name in sorted({name for pair in pairs for name in pair} & lent):
        _report(sink, document, name, f"link {name!r} has no mass, so that no pair with it can be excluded")
    done = set(_excluded(model))
    found = [pair for pair in pairs if lent.isdisjoint(pair) and pair not in done]
    if not found:
        return model
    elements = (Element.unchecked(name="exclude", attributes=(("body1", a), ("body2", b))) for a, b in found)
    section = Element.unchecked(name="contact", children=tuple(elements))
    kept = Element.unchecked(name=KEPT, children=(section,))
    return model.copy(opaque=(*model.opaque, Opaque.unchecked(element=kept)))


def _excluded(model: Model) -> Iterator[Pair]:
    """Yield the pairs that a model keeps excluded already."""
    for part in model.opaque:
        kept = part.element.children if part.element is not None and part.element.name == KEPT else ()
        for section in kept:
            if section.name == "contact":
                for each in section.children:
                    yield _sorted((each.get("body1") or "", each.get("body2") or ""))


def _is_lent(link: Link, model: Model) -> bool:
    """Whether a link of URDF becomes a part of the link that it is fixed to."""
    return link.inertial is None and any(each.child == link.name and each.type == "fixed" for each in model.joints)


def _report(sink: DiagnosticSink, document: Document, name: str, message: str) -> None:
    sink.report(NOTHING_MATCHED, message, document.location, found=name)
