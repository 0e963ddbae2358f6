"""What only MJCF says: elements `<tf:mjcf>` in the node that it belongs to, and an entry in the ledger for each part.

    <joint name="hip" type="revolute"> ... <tf:mjcf><joint armature="0.1"/></tf:mjcf></joint>
    <model name="ant"> ... <tf:mjcf><actuator><motor joint="hip" gear="150"/></actuator></tf:mjcf></model>

Such an element holds only what the node around it does not say. Where the document is written as MJCF, attributes that
the written element lacks are added, and what the node says wins.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TypeVar

from twinform.compiler.input.mjcf.pieces import Piece
from twinform.diagnostics import DiagnosticSink, Fate, LedgerEntry, Location, Rule, rules
from twinform.ir import Document, Element, Node, Opaque
from twinform.ir.rewrite import walk
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.carriers import NAMESPACE, without_ours
from twinform.passes.carriers.old_names import NAME
from twinform.passes.legalise.to_mjcf.kept_mjcf import KNOWN
from twinform.schemas import XmlElement

MJCF = "mjcf"
"""The kind of the element of our namespace that holds the remainder of a part of MJCF."""

AnyNode = TypeVar("AnyNode", bound=Node)

_SOLVER = "it is a setting of MuJoCo's contact and constraint solver"
_SHOWN = "it is a setting of MuJoCo's viewer"
_REASONS: Mapping[str, str] = {
    "armature": "SDF and URDF have no inertia of rotors",
    "ref": "SDF and URDF call the drawn position zero; limits and springs are moved by it",
    "user": "these are numbers of the user",
    **dict.fromkeys(
        (
            "condim", "gap", "margin", "priority", "solimp", "solimpfriction", "solimplimit", "solmix", "solref",
            "solreffriction", "solreflimit",
        ),
        _SOLVER,
    ),
    "friction": "SDF has rolling friction only for Bullet, and no friction that contacts leave out",
    "contype": "SDF has one mask for both sides of a contact",
    "conaffinity": "SDF has one mask for both sides of a contact",
    "group": _SHOWN,
    "material": "SDF writes the colors into each visual",
    "mass": "the mass of the link is written, and that of its shapes does not count",
    "density": "the mass of the link is written, and that of its shapes does not count",
    "actuator": "SDF and URDF have no actuators",
    "asset": "SDF and URDF name files and colors where they are used",
    "contact": "SDF and URDF do not name pairs of shapes",
    "custom": "these are data of the user",
    "deformable": "SDF and URDF have rigid bodies alone",
    "equality": "SDF and URDF have no such constraint",
    "extension": "these are plugins of MuJoCo",
    "keyframe": "SDF and URDF have no states of MuJoCo",
    "option": "it is a setting of MuJoCo",
    "compiler": "it is a setting of MuJoCo",
    "sensor": "SDF and URDF have no sensor of that kind",
    "size": "it is a setting of MuJoCo",
    "statistic": _SHOWN,
    "tendon": "SDF and URDF have no tendons",
    "visual": _SHOWN,
}  # fmt: skip
"""Why SDF does not say an attribute, or an element of a section."""
_IS_KEPT = "is kept as it is"
_OTHER_REASON = "only MJCF has it"


class RemainderKeeper:
    """Makes the remainders of elements and enters each part of them into the ledger.

    What an element of the tree `file` has from a default class counts as no part of it: it is written once in the file,
    and stands in all elements of the class.
    """

    def __init__(self, sink: DiagnosticSink, file: XmlElement) -> None:
        self.sink = sink
        self._written = _written_attributes(file)

    def rest(self, piece: Piece, *, is_marked: bool = False) -> tuple[Opaque, ...]:
        """Return what no node says of an element; with `is_marked` also where that is nothing.

        The element is settled by that, and so is what is in it, but for the bodies, shapes and so on in a body.
        """
        element = self.rest_element(piece, with_inside=piece.tag != "body")
        return (holder(element),) if element.attributes or element.children or is_marked else ()

    def rest_element(self, piece: Piece, *, with_inside: bool = True) -> Element:
        """Return the element with the attributes that no node says, and with all in it that is not settled yet."""
        piece.is_settled = True
        left = piece.untaken
        if left:
            where, written = piece.location, self._attributes_of(piece)
            what = f"<{piece.tag}>{_called(piece)} {_IS_KEPT}"
            for name, _ in left:
                piece.kept.add(name)
                message = f"{name} of {what}: {reason(name, piece.tag)}"
                self._carry(message, where.at(f"@{name}"), int(name in written))
        inside = tuple([self.whole(each) for each in piece.inside if not each.is_settled]) if with_inside else ()
        return Element.unchecked(name=piece.tag, attributes=left, children=inside, source=piece.source)

    def whole(self, piece: Piece, section: str = "", why: str | None = None) -> Element:
        """Return a whole element of a section, which no node says."""
        weight = 0
        for each in piece.walk():
            each.is_settled = True
            each.kept.update(each.attributes)
            weight += 1 + len(each.kept & self._attributes_of(each))
        element = piece.whole()
        message = f"<{piece.tag}>{_called(piece)} {_IS_KEPT}: {why or reason(piece.tag, section)}"
        self._carry(message, piece.location, weight)
        return element.copy(source=piece.source)

    def approximate(self, message: str, where: Location, rule: Rule = rules.MJCF_ONLY) -> None:
        """Enter a part that the document says, but not exactly."""
        self.sink.account(Fate.APPROXIMATED, rule, message, where, 0)

    def _attributes_of(self, piece: Piece) -> frozenset[str]:
        """Return the attributes that an element has in the file itself."""
        return self._written.get((piece.source.line, piece.tag), frozenset())

    def _carry(self, message: str, where: Location, weight: int) -> None:
        self.sink.account(Fate.CARRIED, rules.MJCF_ONLY, message, where, weight)


def _written_attributes(file: XmlElement) -> Mapping[tuple[int, str], frozenset[str]]:
    """Return the attributes in a file by the line and the name of their elements."""
    found: dict[tuple[int, str], frozenset[str]] = {}
    for each in file.iter():
        key, names = (each.sourceline or 0, str(each.tag)), frozenset(map(str, each.keys()))
        before = found.get(key)
        found[key] = before | names if before else names
    return found


def holder(*elements: Element) -> Opaque:
    """Return an element of ours with remainders."""
    return Opaque.unchecked(element=Element.unchecked(name=f"{{{NAMESPACE}}}{MJCF}", children=elements))


def in_sections(sections: Mapping[str, Iterable[Element]]) -> tuple[Opaque, ...]:
    """Return one element of ours with remainders in the sections of MJCF that they belong to."""
    made = [
        each if each.name == name else Element.unchecked(name=name, children=(each,))
        for name, elements in sections.items()
        for each in elements
    ]
    return (holder(*_joined(made)),) if made else ()


def _joined(sections: Iterable[Element]) -> tuple[Element, ...]:
    """Join what belongs to one section; what is none of MJCF stays as it is."""
    alike: dict[str | int, list[Element]] = {}
    for place, each in enumerate(sections):
        alike.setdefault(each.name if each.name in KNOWN else place, []).append(each)
    return tuple(found[0] if len(found) == 1 else _join(found) for found in alike.values())


def _join(sections: Sequence[Element]) -> Element:
    """Return one section with all that several of its name have."""
    return sections[0].copy(
        attributes=tuple(pair for each in sections for pair in each.attributes),
        children=tuple(child for each in sections for child in each.children),
    )


@lru_cache(maxsize=1024)  # a file has few attributes, and many elements with them
def reason(*words: str) -> str:
    """Return why SDF does not say a part of MJCF: by its own name, or by that of what it is in."""
    if any(word.startswith("{") for word in words):
        return "another program has put it there"
    return next((_REASONS[word] for word in words if word in _REASONS), _OTHER_REASON)


def _called(piece: Piece) -> str:
    return f" {piece.name!r}" if piece.name else ""


def with_rest(node: AnyNode, rest: tuple[Opaque, ...]) -> AnyNode:
    """Return the node with remainders behind its other untyped parts."""
    return node.copy(opaque=(*node.opaque, *rest)) if rest else node


def without_remainders(document: Document, sink: DiagnosticSink) -> Document:
    """Return the document without remainders and annotations, which the ledger calls dropped; others unchanged."""
    if document.source is None or document.source.step != "mujoco":
        return document
    sink.entries[:] = [_dropped(each) if each.fate is Fate.CARRIED else each for each in sink.entries]
    _account_names(document, sink)
    return without_ours(document).copy(namespaces=())


def _dropped(entry: LedgerEntry) -> LedgerEntry:
    return replace(entry, fate=Fate.DROPPED, message=entry.message.replace(_IS_KEPT, "is left out"))


def _account_names(document: Document, sink: DiagnosticSink) -> None:
    """Enter the names that SDF writes otherwise, such as `left::hip`; a shape that is seen and touched has one."""
    found = ((each.location, find_annotation(each, NAME)) for each in walk(document))
    for where, mark in {where: mark for where, mark in found if mark is not None}.items():
        was = mark.text or mark.get("was")
        message = f"the name {was!r} is not kept; the part is called {mark.get('instead_of')!r}"
        sink.account(Fate.DROPPED, rules.RENAMED, message, where.at("@name"))
