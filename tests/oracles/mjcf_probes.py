"""What MuJoCo says of MJCF: the elements and attributes that it prints, and its verdict on a value of an attribute."""

import importlib
import re
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from typing import Any, NamedTuple

from lxml import etree

from twinform.schemas.facts import Fact, table

Steps = tuple[str, ...]
"""The names of elements from the root on; `worldbody` and the bodies in it are `body`."""

FACTS = table("mjcf")
NEWEST = FACTS.newest
BEYOND = frozenset({"frame", "replicate", "include"})
"""Elements that MuJoCo reads and does not print."""
_PRINTED = re.compile(r"(?P<indent> *)(?P<name>\S+) \((?P<count>.)\)(?P<attributes>.*)")
_TYPE_COMPLAINTS = (
    "invalid keyword", "bad format", "too much data", "enough data", "unrecognized", "problem reading",
    "is expected in attribute", "number is too", "must have exactly", "must have 1 or 3", "unknown object type",
    "unknown layer role", "is specified but",
)  # fmt: skip
"""What MuJoCo says of a word or a value that it does not know, whatever else is wrong."""
_RELATIVE = {"reftype": "body", "refname": "c"}
_FRAME_SENSORS = ("framepos", "framequat", "framexaxis", "frameyaxis", "framezaxis", "framelinvel", "frameangvel")
_WITH: dict[Steps, dict[str, str]] = {
    ("body",): {"name": "b"},
    ("body", "flexcomp"): {"count": "3 3 1", "spacing": ".1 .1 .1"},
    ("body", "attach"): {"body": "c"},
    ("actuator", "dcmotor"): {"motorconst": "1", "resistance": "1"},
    ("default", "dcmotor"): {"motorconst": "1", "resistance": "1"},
    ("equality", "connect"): {"body1": "b", "anchor": "0 0 0"},
    ("equality", "weld"): {"body1": "b"},
    ("asset", "mesh", "@params"): {"builtin": "sphere"},
    ("asset", "hfield"): {"nrow": "1", "ncol": "3"},
    **{("sensor", name): _RELATIVE for name in _FRAME_SENSORS},
    ("sensor", "plugin"): {"objtype": "body", "objname": "b", **_RELATIVE},
    ("sensor", "user"): {"objtype": "body", "objname": "b"},
    ("sensor", "rangefinder"): {"site": "s"},
    ("sensor", "distance"): {"geom1": "g", "geom2": "h"},
    ("sensor", "normal"): {"geom1": "g", "geom2": "h"},
    ("sensor", "fromto"): {"geom1": "g", "geom2": "h"},
    ("extension", "plugin"): {"plugin": "mujoco.sdf.bolt"},
    ("deformable", "flex"): {"body": "b c d", "element": "0 1 2"},
    ("custom", "numeric"): {"data": "1"},
}
"""What an element or one of its attributes needs beside the attributes that are required."""
_NEEDED = {"string": "x", "words": "x", "int": "1", "double": "1", "ints": "0", "doubles": "1"}


class Attribute(NamedTuple):
    """An attribute of an element at some steps."""

    steps: Steps
    fact: Fact

    def __str__(self) -> str:
        return f"{'/'.join(self.steps)}/{self.fact.name}"


@cache
def printed() -> dict[Steps, tuple[str, frozenset[str]]]:
    """The count and the attributes of every element that MuJoCo prints."""
    text: str = _mujoco().mj_printSchema(False, False)
    found: dict[Steps, tuple[str, frozenset[str]]] = {}
    steps: list[str] = []
    for line in text.splitlines():
        if match := _PRINTED.match(line):
            steps[len(match["indent"]) // 3 :] = [match["name"].replace("(world)body", "body")]
            count = match["count"].replace("R", "*").replace("!", "1")
            found[tuple(steps[1:])] = count, frozenset(match["attributes"].split())
        elif line.strip():
            count, names = found[tuple(steps[1:])]
            found[tuple(steps[1:])] = count, names | frozenset(line.split())
    return found


@cache
def written() -> dict[Steps, tuple[str, tuple[Fact, ...]]]:
    """The count and the attributes of every element of the facts, in the terms of what MuJoCo prints."""
    root = FACTS.definitions[FACTS.root]
    found: dict[Steps, tuple[str, tuple[Fact, ...]]] = {(): ("1", tuple(root.attributes))}
    found |= _below(root, ())
    return found


def _below(fact: Fact, around: Steps) -> dict[Steps, tuple[str, tuple[Fact, ...]]]:
    found: dict[Steps, tuple[str, tuple[Fact, ...]]] = {}
    for row in fact.children:
        inside = FACTS.resolve(row)
        if row.name in BEYOND or not row.exists_in(NEWEST) or row.name in around[-1:]:
            continue
        if row.name == "worldbody":  # printed as a body, whose content it has
            found |= _below(replace(inside, rows=[each for each in inside.rows if each.name == "body"]), around)
            continue
        steps = (*around, row.name)
        found[steps] = row.count, tuple(each for each in inside.attributes if each.exists_in(NEWEST))
        found |= _below(inside, steps)
    return found


def complaint(attribute: Attribute, value: str) -> str:
    """What MuJoCo says of the type of a value; empty if it takes it, or minds something else."""
    return next((said for said in [_said(attribute, value)] if any(each in said for each in _TYPE_COMPLAINTS)), "")


def _said(attribute: Attribute, value: str) -> str:
    document = _document(attribute, value)
    try:
        _mujoco().MjSpec.from_string(document)
    except (ValueError, RuntimeError) as error:  # the second where a file is not there
        return str(error)
    return ""


def saved(attribute: Attribute, value: str | None) -> str | None:
    """What MuJoCo saves of a model with a value, or without the attribute; None if it is no model yet."""
    with warnings.catch_warnings(action="ignore"):  # of what is missing for a model that moves as it should
        try:
            spec = _mujoco().MjSpec.from_string(_document(attribute, value))
            spec.compile()
            return spec.to_xml()
        except (ValueError, RuntimeError):
            return None


def _document(attribute: Attribute, value: str | None) -> str:
    root = here = etree.Element("mujoco")
    for depth, name in enumerate(attribute.steps, 1):
        here = etree.SubElement(here if name != "body" else etree.SubElement(here, "worldbody"), name)
        for key, needed in _needed(attribute.steps[:depth]).items():
            here.set(key, needed)
    name = attribute.fact.name[1:]
    for key, needed in _WITH.get((*attribute.steps, attribute.fact.name), {}).items():
        here.set(key, needed)
    here.attrib.pop(name, None)
    if value is not None:
        here.set(name, value)
    return etree.tostring(root, encoding="unicode")


@cache
def _needed(steps: Steps) -> dict[str, str]:
    """The attributes that an element cannot do without, with some values."""
    rows = (row for row in written()[steps][1] if row.required)
    needed = {row.name[1:]: row.enum[0] if row.enum else _some_value(row) for row in rows}
    return needed | _WITH.get(steps, {})


def _some_value(row: Fact) -> str:
    kind = row.type or "string"
    return _NEEDED.get(kind) or " ".join(["1"] * min(lengths(row)))


def lengths(row: Fact) -> range:
    """How many numbers a value of a row may have."""
    named = {"vector3": 3, "quaternion": 4, "color4": 4, "int": 1, "double": 1}
    kind = row.type or ""
    if kind in named:
        return range(named[kind], named[kind] + 1)
    least, _, most = kind.partition(".")[2].partition("-")
    return range(int(least), int(most or least) + 1)


def attributes(names: Iterable[str] = ()) -> Iterator[Attribute]:
    """All attributes of the elements, or of those in some sections."""
    for steps, (_, rows) in written().items():
        if not names or steps[:1] == () or steps[0] in names:
            yield from (Attribute(steps, row) for row in rows)


@cache
def _mujoco() -> Any:
    return importlib.import_module("mujoco")
