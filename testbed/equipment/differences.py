"""What two robots of libsdformat differ in beside bodies and joints: surfaces, materials, sensors, plugins, flags."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

import numpy as np
from lxml import etree

from twinform.passes.carriers.lumped_names import LUMP
from twinform.schemas import XmlElement
from twinform.testing.oracles.libsdformat import RobotRow, SensorRow, ShapeRow
from twinform.testing.oracles.libsdformat_robot import pose_matrix
from twinform.testing.oracles.robot import WORLD, Matrix

CUT_OFF = 1e-5
"""The tolerance for poses, in m and as entries of a rotation: libsdformat keeps six digits where it lumps links."""
_STEEP = 5e-3
"""The tolerance for entries of rotations of shapes: urdfdom turns what points straight up or down by up to this."""
_FIXED = 3
"""The number that libsdformat has for a fixed joint."""


class Difference(NamedTuple):
    """A value that is not the same: of which parts, from the outside in, where in the last of them, and both texts."""

    kind: str
    parts: tuple[str, ...]
    path: str
    there: str = ""
    here: str = ""

    def __str__(self) -> str:
        return (
            f"{self.kind} {'/'.join(self.parts)}: {self.path}: {self.there or 'nothing'}, not {self.here or 'nothing'}"
        )


class _Placed(NamedTuple):
    """A shape, the link that it is on, and where it is in the world."""

    link: str
    row: ShapeRow
    place: Matrix


def differences(before: RobotRow, after: RobotRow) -> Iterator[Difference]:
    """What only one of the two has, what has other values, and sensors that have moved.

    Shapes are the same where they are of one kind at one place, whatever their names are.
    """
    pairs = list(_pairs(before, after))
    yield from _values("model", (), before["values"], after["values"])
    yield from _of_links(before, after)
    for one, other in pairs:
        yield from _values(one.row["kind"], (one.link, one.row["name"]), one.row["values"], other.row["values"])
    yield from _unpaired(_shapes(before), [one for one, _ in pairs], "there", "missing")
    yield from _unpaired(_shapes(after), [other for _, other in pairs], "missing", "there")
    names = {other.row["name"]: one.row["name"] for one, other in pairs if one.row["kind"] == "collision"}
    yield from _of_sensors(before, after, names)
    yield from _of_plugins(before, after, {_parts(other): _parts(one) for one, other in pairs})


def _values(
    kind: str, parts: tuple[str, ...], before: Mapping[str, str], after: Mapping[str, str]
) -> Iterator[Difference]:
    for path in sorted(before.keys() | after.keys()):
        there, here = _spelt(before.get(path, "")), _spelt(after.get(path, ""))
        if there != here:
            yield Difference(kind, parts, path, there, here)


def _of_links(before: RobotRow, after: RobotRow) -> Iterator[Difference]:
    """Values of links; those of a link that was lumped are the ones of the link that it is part of now."""
    links = {_flat(row["name"]): row for row in after["links"]}
    hosts = _hosts(before, after)
    for row in before["links"]:
        if (host := _flat(hosts[row["name"]])) in links:
            yield from _values("link", (row["name"],), row["values"], links[host]["values"])


def _hosts(before: RobotRow, after: RobotRow) -> dict[str, str]:
    """The link that each one is a part of afterwards."""
    links = {_flat(row["name"]) for row in after["links"]}
    above = {row["child"]: row["parent"] for row in before["joints"] if row["kind"] == _FIXED}
    hosts = dict[str, str]()
    for row in before["links"]:
        host = row["name"]
        while _flat(host) not in links and above.get(host, WORLD) != WORLD:
            host = above[host]
        hosts[row["name"]] = host
    return hosts


def _flat(name: str) -> str:
    """What a part of a nested model is called in URDF."""
    return name.replace("::", "__")


def _unpaired(shapes: Iterable[_Placed], paired: Iterable[_Placed], there: str, here: str) -> Iterator[Difference]:
    known = {id(each.row) for each in paired}
    for one in shapes:
        if id(one.row) not in known:
            yield Difference(one.row["kind"], (one.link, one.row["name"]), "", there, here)


def _pairs(before: RobotRow, after: RobotRow) -> Iterator[tuple[_Placed, _Placed]]:
    """Each shape, and the one that it is afterwards: at one place, with its values, or its name in it, or both."""
    waiting, rest = list(_shapes(before)), list(_shapes(after))
    for is_it in (_is_equal, _has_values_of, _is_named_after, _is_at_place_of):
        for one in list(waiting):
            found = next((other for other in rest if _is_at_place_of(one, other) and is_it(one, other)), None)
            if found is not None:
                yield one, found
                waiting = [each for each in waiting if each is not one]
                rest = [each for each in rest if each is not found]


def _is_equal(one: _Placed, other: _Placed) -> bool:
    return _is_named_after(one, other) and _has_values_of(one, other)


def _is_named_after(one: _Placed, other: _Placed) -> bool:
    return one.row["name"].replace(LUMP, "_") in other.row["name"]


def _has_values_of(one: _Placed, other: _Placed) -> bool:
    return not list(_values("", (), one.row["values"], other.row["values"]))


def _shapes(robot: RobotRow) -> Iterator[_Placed]:
    frame = pose_matrix(robot["pose"])
    for link in robot["links"]:
        for row in link["shapes"]:
            yield _Placed(link["name"], row, frame @ pose_matrix(link["pose"]) @ pose_matrix(row["place"]))


def _is_at_place_of(one: _Placed, other: _Placed) -> bool:
    if one.row["kind"] != other.row["kind"] or one.row["geometry"] != other.row["geometry"]:
        return False
    gap = np.abs(one.place - other.place)
    far = max(1.0, float(np.abs(one.place[:3, 3]).max()))
    return bool(gap[:3, 3].max() <= CUT_OFF * far and gap[:3, :3].max() <= _STEEP)


def _of_sensors(before: RobotRow, after: RobotRow, names: Mapping[str, str]) -> Iterator[Difference]:
    there = [(row, _content(row["text"], names)) for row in after["sensors"]]
    frames = pose_matrix(before["pose"]), pose_matrix(after["pose"])
    hosts = _hosts(before, after)
    for row in before["sensors"]:
        named = [pair for pair in there if (pair[0]["name"], pair[0]["kind"]) == (row["name"], row["kind"])]
        if not named:
            yield Difference("sensor", (row["inside"], row["name"]), "", "there", "missing")
            continue
        content, places = _content(row["text"], {}), {*map(_flat, (row["inside"], hosts.get(row["inside"], "")))}
        found = min(named, key=lambda pair: (_flat(pair[0]["inside"]) not in places, pair[1] != content))
        yield from _of_sensor(row, content, found[1])
        if _flat(found[0]["inside"]) not in places:
            yield Difference("sensor", (row["inside"], row["name"]), "parent", row["inside"], found[0]["inside"])
        poses = [frame @ pose_matrix(each["pose"]) for frame, each in zip(frames, (row, found[0]), strict=True)]
        if (far := float(np.abs(poses[0] - poses[1]).max())) > CUT_OFF:
            yield Difference("sensor", (row["inside"], row["name"]), "pose", "", f"moved by {far:.2g}")
        there = [pair for pair in there if pair is not found]
    yield from (Difference("sensor", (row["inside"], row["name"]), "", "missing", "there") for row, _ in there)


def _of_sensor(row: SensorRow, content: list[str], seen: list[str]) -> Iterator[Difference]:
    parts = row["inside"], row["name"]
    for only, here in ((sorted({*content} - {*seen}), False), (sorted({*seen} - {*content}), True)):
        for path, _, text in (each.partition("=") for each in only):
            yield Difference("sensor", parts, path, "" if here else text, text if here else "")


def _parts(shape: _Placed) -> tuple[str, ...]:
    return shape.link, shape.row["name"]


def _of_plugins(
    before: RobotRow, after: RobotRow, shapes: Mapping[tuple[str, ...], tuple[str, ...]]
) -> Iterator[Difference]:
    there, here = _plugins(before, {}), _plugins(after, shapes)
    for key in sorted(there.keys() | here.keys()):
        path, gone, new = " ".join(key[1:])[:120], there[key] - here[key], here[key] - there[key]
        common = min(gone.total(), new.total())  # in links that have become a part of others
        yield from (Difference("plugin", parts, path, "there", "missing") for parts in [*gone.elements()][common:])
        yield from (Difference("plugin", parts, path, "missing", "there") for parts in [*new.elements()][common:])


def _plugins(
    robot: RobotRow, shapes: Mapping[tuple[str, ...], tuple[str, ...]]
) -> defaultdict[tuple[str, ...], Counter[tuple[str, ...]]]:
    """By what they are in and what is in them, the names around plugins; shapes by the names given for theirs."""
    found = defaultdict[tuple[str, ...], Counter[tuple[str, ...]]](Counter)
    for row in robot["plugins"]:
        parts = tuple(row["parts"])
        found[row["inside"], *_content(row["text"], {})][shapes.get(parts, parts)] += 1
    return found


def _content(text: str, names: Mapping[str, str]) -> list[str]:
    """Every attribute and text of some XML with its path, sorted; collisions by the names given for theirs."""
    # where libsdformat writes a prefix that it does not declare, the parser goes on
    root = etree.fromstring(text.encode(), etree.XMLParser(recover=True, remove_comments=True))
    return sorted(_leaves(root, "", names))


def _leaves(element: XmlElement, around: str, names: Mapping[str, str]) -> Iterator[str]:
    path = f"{around}/{element.tag}"
    text = (element.text or "").strip()
    yield f"{path}={_spelt(names.get(text, text) if path.endswith('/contact/collision') else text)}"
    yield from (f"{path}@{name}={_spelt(str(value))}" for name, value in element.items())
    for child in element:
        if not str(child.tag).startswith("tf:"):  # a carrier, which Gazebo passes over
            yield from _leaves(child, path, names)


def _spelt(text: str) -> str:
    return " ".join(map(_number, text.split()))


def _number(text: str) -> str:
    try:
        return f"{float(text) + 0.0:.6g}"
    except ValueError:
        return text
