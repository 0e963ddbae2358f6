"""Completion of SRDF: its elements and attributes, and the names of the robot that it is for."""

from collections.abc import Iterator

from twinform.compiler.companions.name_places import paths_of_srdf
from twinform.server.companions import parts_of_robots
from twinform.server.completion.proposals import ITEM, ElementPlace, Proposal, ValuePlace, element_snippet, values
from twinform.server.documents import TextDocument
from twinform.server.schema import is_of_xacro
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

Path = tuple[str, ...]
_OWN: dict[Path, tuple[str, ...]] = {
    ("group",): ("name",),
    ("group_state",): ("name",),
    ("group_state", "joint"): ("value",),
    ("end_effector",): ("name",),
    ("virtual_joint",): ("name", "type", "parent_frame"),
    ("disable_collisions",): ("reason",),
    ("joint_property",): ("property_name", "value"),
}
"""The attributes that name no part of the robot and no group."""
_OPTIONAL = frozenset({"parent_group"})
_WORDS: dict[Path, tuple[str, ...]] = {
    ("virtual_joint", "@type"): ("fixed", "floating", "planar"),
    ("disable_collisions", "@reason"): ("Adjacent", "Never", "Default", "Always", "User"),
}


def propose_elements_of_srdf(place: ElementPlace) -> Iterator[Proposal]:
    """Propose the elements of SRDF that may stand in another."""
    path = _path(place.parent)
    for name in _below(path):
        if not name.startswith("@"):
            yield Proposal(name, name if place.bare else _snippet((*path, name)), ITEM.Class)


def propose_attributes_of_srdf(_: Session, __: TextDocument, node: TolerantNode, *, named: bool) -> Iterator[Proposal]:
    """Propose the attributes of SRDF that an element does not have yet."""
    for name in _attributes(_path(node)):
        if name not in node.attributes:
            rank = 1 if name in _OPTIONAL else 0
            yield Proposal(name, name if named else f'{name}="$1"', ITEM.Property, rank=rank)


def propose_values_of_srdf(place: ValuePlace) -> Iterator[Proposal]:
    """Propose links and joints of the robot, groups of the file, and the words of SRDF."""
    path = (*_path(place.node), f"@{place.attribute}")
    yield from values(_WORDS.get(path, ()))
    kind = paths_of_srdf().get(path)
    there = {value for name, value in place.node.values.items() if name.startswith("link") and name != place.attribute}
    if kind in {"link", "joint"}:
        parts = parts_of_robots(place.session, place.document, kind)
        yield from values((each for each in parts if each not in there), ITEM.Reference, kind)
    elif kind == "group":
        root = place.document.tree.root
        around = place.node.parent
        groups = (each.get("name") for each in root.children if each.tag == kind and each is not around) if root else ()
        yield from values(filter(None, groups), ITEM.Reference, kind)


def _path(node: TolerantNode) -> Path:
    """Return the tags that lead to an element from below the root on, without those of xacro."""
    steps: list[str] = []
    here = node
    while here.parent is not None:
        steps += [] if is_of_xacro(here.tag) else [here.tag]
        here = here.parent
    return tuple(reversed(steps))


def _below(path: Path) -> list[str]:
    """Return the steps that the table has below a path, each once."""
    known = (*paths_of_srdf(), *((*each, f"@{name}") for each, names in _OWN.items() for name in names))
    return list(dict.fromkeys(each[len(path)] for each in known if len(each) > len(path) and each[: len(path)] == path))


def _attributes(path: Path) -> list[str]:
    found = (each.removeprefix("@") for each in _below(path) if each.startswith("@"))
    return sorted(found, key=lambda name: name != "name")


def _snippet(path: Path) -> str:
    needed = (name for name in _attributes(path) if name not in _OPTIONAL)
    return element_snippet(path[-1], needed, holds=any(not each.startswith("@") for each in _below(path)))
