"""Values in carriers count as if they were written in the file: conversion does not change a robot."""

from collections.abc import Iterator
from copy import deepcopy

from lxml import etree

from twinform.compiler.compare.leaves import CARRIED
from twinform.passes.carriers.carriers import NAMESPACE, SECOND
from twinform.schemas import Fact, XmlElement, table

_CARRIER = {name: f"{{{NAMESPACE}}}{name}" for name in ("sdf", "urdf", "version")}
CARRIER_OF_URDF = _CARRIER["urdf"]
_OF_THE_FILE = frozenset({"pose", "version"})
"""How the other file spelled a value, which is not the value."""


def unpack_sdf(element: XmlElement, fact: Fact) -> None:
    """Put what carriers of SDF hold into their places in the tree, where nothing is written instead, as carried."""
    for carrier in list(element.iter(_CARRIER["sdf"], _CARRIER["version"])):
        parent = carrier.getparent()
        if parent is None or _is_in_carrier(carrier) or carrier.get("instead") or carrier.get("without"):
            continue
        parent.remove(carrier)
        at = carrier.get("at") or ""
        if at.startswith("/"):
            continue
        name, value = carrier.get("attribute"), carrier.get("value")
        if name is not None:
            holder = _holder(parent, at)
            holder.set(name, holder.get(name, value or ""))
        for child in carrier:
            _graft(child, parent, at, fact if parent is element else None)


def _is_in_carrier(carrier: XmlElement) -> bool:
    return any(str(above.tag).startswith(f"{{{NAMESPACE}}}") for above in carrier.iterancestors())


def _is_beside_another(carrier: XmlElement) -> bool:
    return any(carrier.get(name) is not None for name, _ in SECOND)


def _graft(child: XmlElement, parent: XmlElement, at: str, fact: Fact | None) -> None:
    if child.tag in _OF_THE_FILE or not isinstance(child.tag, str):
        return
    repeats = fact is not None and not at and any(row.name == child.tag and row.repeats for row in fact.rows)
    holder = _holder(parent, at)
    written = None if repeats else holder.find(child.tag)
    if written is None:
        made = deepcopy(child)
        made.set(CARRIED, "1")
        holder.append(made)
        return
    for inner in child:
        _graft(inner, written, "", None)


def _holder(element: XmlElement, path: str) -> XmlElement:
    for step in filter(None, path.split("/")):
        found = element.find(step)
        element = found if found is not None else etree.SubElement(element, step)
    return element


def urdf_pieces(element: XmlElement) -> Iterator[tuple[str, XmlElement]]:
    """What the carriers of URDF in an element hold: where in it, and the carrier or an element in it.

    What stood beside another one of its kind, which readers take, is nothing to any of them.
    """
    for carrier in element.iter(_CARRIER["urdf"]):
        if _is_in_carrier(carrier) or _is_beside_another(carrier):
            continue
        at = "/".join(filter(None, (*_steps(element, carrier), carrier.get("at"))))
        if carrier.get("attribute") is not None or carrier.get("text") is not None:
            yield at, carrier
        yield from ((at, child) for child in carrier if isinstance(child.tag, str))


def _steps(element: XmlElement, carrier: XmlElement) -> list[str]:
    """The tags between an element and a carrier in it."""
    above = list(carrier.iterancestors())
    return [str(each.tag) for each in reversed(above[: above.index(element)])]


def definition(name: str) -> Fact:
    """A definition of SDF's table."""
    return table("sdf").definitions[name]
