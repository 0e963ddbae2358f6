"""Hints for unknown words: slips, words of the other format or of other tools, and elements in the wrong place."""

from collections import defaultdict
from collections.abc import Collection, Iterator
from functools import cache

from twinform.diagnostics import did_you_mean
from twinform.schemas.facts import Fact, Table, table

_INSTEAD = {
    ("urdf", "pose"): "URDF writes <origin xyz='x y z' rpy='roll pitch yaw'/>",
    ("urdf", "uri"): "URDF writes the attribute filename='package://...'",
    ("urdf", "ambient"): "URDF writes <color rgba='red green blue alpha'/>",
    ("urdf", "diffuse"): "URDF writes <color rgba='red green blue alpha'/>",
    ("urdf", "plugin"): "write it into <gazebo>",
    ("urdf", "sensor"): "write it into <gazebo reference='the link'>",
    ("urdf", "surface"): "write <mu1>, <mu2>, <kp> or <kd> into <gazebo reference='the link'>",
    ("urdf", "static"): "write <gazebo><static>true</static></gazebo>",
    ("urdf", "include"): "URDF has no includes; xacro has <xacro:include filename='...'/>",
    ("urdf", "frame"): "URDF writes a link without anything in it, on a fixed joint",
    ("urdf", "model"): "URDF has one <robot>, with all links and joints in it",
    ("sdf", "origin"): "SDF writes <pose>x y z roll pitch yaw</pose>",
    ("sdf", "color"): "SDF writes <ambient> and <diffuse>, each with 'red green blue alpha'",
    ("sdf", "texture"): "SDF writes <pbr><metal><albedo_map>",
    ("sdf", "robot"): "SDF writes <model>",
    ("sdf", "gazebo"): "SDF needs no <gazebo>: what is in it stands in the link, joint or model itself",
    ("sdf", "transmission"): "it is an element of URDF; in SDF a plugin drives the joints",
    ("sdf", "safety_controller"): "it is an element of URDF; SDF has <limit> in <axis>",
}
"""What to write instead of an element of the other format."""
_SAME = {
    "altitude": "altimeter",
    "free": "floating",
    "height": "length",
    "hinge": "revolute",
    "laser": "gpu_lidar",
    "rigid": "fixed",
    "rotary": "revolute",
    "rotation": "revolute",
    "rotational": "revolute",
    "slide": "prismatic",
    "slider": "prismatic",
    "spherical": "ball",
    "translational": "prismatic",
    "weld": "fixed",
}
"""Words of other tools, and what they are called here."""
_MOST_PARENTS = 3


def hint_for_word(word: str, known: Collection[str]) -> str | None:
    """For a word that is none of those that a value may be."""
    same = _SAME.get(word.lower())
    return f"did you mean {same!r}?" if same in known else did_you_mean(word, known)


def hint_for_element(format_: str, name: str, known: Collection[str], attributes: Collection[str]) -> str | None:
    """For an element that is not known where it stands; the parent has the `known` ones, and attributes."""
    if name in attributes:
        return f"{format_.upper()} writes it as an attribute: {name}='...'"
    return (
        _INSTEAD.get((format_, name))
        or did_you_mean(name, known)
        or _elsewhere(format_, name)
        or (f"it is an element of {_other(format_).upper()}" if name in _parents(_other(format_)) else None)
    )


def hint_for_attribute(format_: str, name: str, known: Collection[str], children: Collection[str]) -> str | None:
    """For an attribute that its element does not have; it has the `known` ones, and children."""
    if name in children:
        return f"{format_.upper()} writes it as an element: <{name}>...</{name}>"
    return hint_for_word(name, known)


def _other(format_: str) -> str:
    return "sdf" if format_ == "urdf" else "urdf"


def _elsewhere(format_: str, name: str) -> str | None:
    parents = sorted(_parents(format_).get(name, ()))
    if not 0 < len(parents) <= _MOST_PARENTS:  # what may stand in many is told nothing by them
        return None
    return f"it belongs in {' or '.join(f'<{parent}>' for parent in parents)}"


@cache
def _parents(format_: str) -> dict[str, frozenset[str]]:
    """For each element of a format, in which others it may stand."""
    facts = table(format_)
    found: defaultdict[str, set[str]] = defaultdict(set)
    for holder, child in _children(facts):
        found[child].add(holder)
    return {child: frozenset(holders) for child, holders in found.items()}


def _children(facts: Table) -> Iterator[tuple[str, str]]:
    """Every element with one that may stand in it, by their names."""
    todo = [(facts.root, facts.definitions[facts.root])]
    seen: set[tuple[str, str]] = set()
    while todo:
        name, fact = todo.pop()
        for row in (row for row in facts.resolve(fact).children if not row.dialect):
            yield name, row.name
            if not _is_seen(row, seen):
                todo.append((row.name, row))


def _is_seen(row: Fact, seen: set[tuple[str, str]]) -> bool:
    """Whether a definition was looked into already under this name; definitions may hold themselves."""
    if row.reference is None:
        return False
    key = (row.name, row.reference)
    known = key in seen
    seen.add(key)
    return known
