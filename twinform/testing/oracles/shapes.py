"""URDF without its shapes.

An engine that simulates wants to load every mesh, and a model from elsewhere rarely comes with them. Kinematics and
inertia do not depend on shapes, so engines are given the file without `<visual>` and `<collision>`.
"""

from pathlib import Path

from lxml import etree


def without_shapes(path: Path) -> bytes:
    """The text of a URDF file without visuals and collisions; nothing else is taken out.

    Raises:
        lxml.etree.XMLSyntaxError: the file is not XML.
    """
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True)
    robot = etree.parse(str(path), parser).getroot()
    for shape in [*robot.iterfind("link/visual"), *robot.iterfind("link/collision")]:
        parent = shape.getparent()
        assert parent is not None
        parent.remove(shape)
    return etree.tostring(robot, encoding="utf-8")


def root_link(text: bytes) -> str:
    """The first link of a URDF file that no joint moves."""
    robot = etree.fromstring(text)
    children = {child.get("link") for child in robot.iterfind("joint/child")}
    names = (link.get("name", "") for link in robot.iterfind("link"))
    return next((name for name in names if name not in children), "")
