"""The plugin blocks of a file as it is written, and each of them alone in a small robot or world."""

import re
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path

from lxml import etree

from twinform.schemas import XmlElement

_OURS = re.compile(r"lib(gazebo|ignition)")
_LINKS = frozenset({"bodyName", "body_name", "linkName", "link_name", "robotBaseFrame", "robot_base_frame", "link"})
_EXPRESSION = re.compile(r"\$\{[^}]*\}|\$\([^)]*\)")
"""What xacro would replace by a value, which is not there; 1 is a number and a part of a name."""
_JOINT = re.compile(r"(?i)joint(s|name|_name)?$")
_INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'


@dataclass(frozen=True, slots=True)
class Block:
    """One `<plugin>` of Gazebo Classic or Ignition, where it stands in a file."""

    filename: str
    line: int
    alone: bytes
    language: str


def blocks(path: Path) -> list[Block]:
    """Every block with a file `libgazebo*` or `libignition*`, however broken the rest of the file is."""
    parser = etree.XMLParser(
        recover=True, resolve_entities=False, no_network=True, huge_tree=True, remove_comments=True
    )
    root = etree.fromstring(path.read_bytes(), parser)
    if root is None:  # pyright: ignore[reportUnnecessaryComparison] - the parser gives up on some files
        return []
    found = [each for each in root.iter("plugin") if _OURS.match(each.get("filename") or "")]
    return [_block(each) for each in found]


def _block(plugin: XmlElement) -> Block:
    parent = plugin.getparent()
    around = str(parent.tag) if parent is not None else ""
    is_world = around in {"world", "gui"}
    alone = _in_world(plugin, around) if is_world else _in_robot(plugin, parent)
    language = "sdf" if is_world else "urdf"
    return Block(plugin.get("filename") or "", int(plugin.sourceline or 0), alone, language)


def _in_world(plugin: XmlElement, around: str) -> bytes:
    """The plugin in a world of its own."""
    text = _text(plugin)
    inside = f"<gui>{text}</gui>" if around == "gui" else text
    return f'<sdf version="1.11"><world name="alone">{inside}</world></sdf>'.encode()


def _in_robot(plugin: XmlElement, parent: XmlElement | None) -> bytes:
    """The plugin in a robot that has the links and joints which it names, and the sensor that it stood in."""
    links, joints = sorted(set(_named_links(plugin))), sorted(set(_named_joints(plugin)))
    parts = [f'<link name="{each}">{_INERTIAL}</link>' for each in ["alone", *links]]
    parts += [_fixed("to_" + each, each) for each in links]
    for each in joints:
        parts.append(f'<link name="behind_{each}">{_INERTIAL}</link>')
        parts.append(_turning(each))
    text, reference = _text(plugin), ""
    if parent is not None and parent.tag == "sensor":
        name, type_ = _escaped(parent.get("name") or ""), _escaped(parent.get("type") or "")
        text = f'<sensor name="{name}" type="{type_}">{text}</sensor>'
        reference = ' reference="alone"'
    parts.append(f"<gazebo{reference}>{text}</gazebo>")
    return f'<robot name="alone">{"".join(parts)}</robot>'.encode()


def _fixed(name: str, child: str) -> str:
    return f'<joint name="{name}" type="fixed"><parent link="alone"/><child link="{child}"/></joint>'


def _turning(name: str) -> str:
    ends = f'<parent link="alone"/><child link="behind_{name}"/><axis xyz="0 0 1"/>'
    return f'<joint name="{name}" type="continuous">{ends}</joint>'


def _named_links(plugin: XmlElement) -> Iterator[str]:
    for child in plugin.iter():
        text = child.text if child.tag in _LINKS else child.get("link_name")
        if text and text.strip() not in {"", "alone"}:
            yield _escaped(text.strip().rpartition("::")[2])


def _named_joints(plugin: XmlElement) -> Iterator[str]:
    for child in plugin:
        if isinstance(child.tag, str) and _JOINT.search(child.tag) and child.text and child.text.strip():
            yield from (_escaped(name.strip()) for name in child.text.split(","))


def _escaped(text: str) -> str:
    return _EXPRESSION.sub("1", text).replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")


def _text(plugin: XmlElement) -> str:
    alone = deepcopy(plugin)
    alone.tail = None
    return _EXPRESSION.sub("1", etree.tostring(alone, encoding="unicode"))
