"""The generated reader of URDF: a function for each element that makes a node, or fills one.

Written by `python -m twinform.compiler.input.readers.generate` from the facts tables; not to be edited.
"""

from typing import Any

from twinform.compiler.input.readers.reading import Reading
from twinform.compiler.input.readers.values import color4, double, quaternion, vector3
from twinform.diagnostics import Source
from twinform.ir import (
    Axis,
    Box,
    Capsule,
    Collision,
    Cylinder,
    Dynamics,
    GazeboExtension,
    Geometry,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Mimic,
    Model,
    Pose,
    Sphere,
    Visual,
)
from twinform.ir.record import maker
from twinform.schemas import Data, XmlElement, locate

make_axis = maker(Axis)
make_box = maker(Box)
make_capsule = maker(Capsule)
make_collision = maker(Collision)
make_cylinder = maker(Cylinder)
make_dynamics = maker(Dynamics)
make_gazebo_extension = maker(GazeboExtension)
make_geometry = maker(Geometry)
make_inertia = maker(Inertia)
make_inertial = maker(Inertial)
make_joint = maker(Joint)
make_limit = maker(Limit)
make_link = maker(Link)
make_material = maker(Material)
make_mesh = maker(Mesh)
make_mimic = maker(Mimic)
make_model = maker(Model)
make_pose = maker(Pose)
make_sphere = maker(Sphere)
make_visual = maker(Visual)


def read_robot(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Model, from `robot`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        else:
            reading.attribute("robot", element, name, text, node)
    if "name" not in node:
        reading.missing_attributes("robot", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("robot", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "link":
            data = read_link(child, source, "link", child.get("name") or place, reading)
            node.setdefault("links", []).append(make_link(data))
        elif tag == "joint":
            data = read_joint(child, source, "joint", child.get("name") or place, reading)
            node.setdefault("joints", []).append(make_joint(data))
        elif tag == "material":
            data = read_material(child, source, "material", child.get("name") or place, reading)
            node.setdefault("materials", []).append(make_material(data))
        elif tag == "gazebo":
            data = read_gazebo(child, source, "gazebo", place, reading)
            node.setdefault("extensions", []).append(make_gazebo_extension(data))
        else:
            reading.child("robot", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("robot", element, child, node)
    if "link" not in counts:
        reading.missing_children("robot", element, counts)
    if "links" in node:
        node["links"] = tuple(node["links"])
    if "joints" in node:
        node["joints"] = tuple(node["joints"])
    if "materials" in node:
        node["materials"] = tuple(node["materials"])
    if "extensions" in node:
        node["extensions"] = tuple(node["extensions"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    if "name" not in node:
        reading.broken = True
    return node


def read_link(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Link, from `link`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        else:
            reading.attribute("link", element, name, text, node)
    if "name" not in node:
        reading.missing_attributes("link", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("link", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "inertial" and place == 1:
            data = read_link_inertial(child, source, "inertial", None, reading)
            if len(data) > 1:
                node["inertial"] = make_inertial(data)
            else:
                reading.keep(child, node)
        elif tag == "visual":
            data = read_link_visual(child, source, "visual", child.get("name") or place, reading)
            node.setdefault("visuals", []).append(make_visual(data))
        elif tag == "collision":
            data = read_link_collision(child, source, "collision", child.get("name") or place, reading)
            node.setdefault("collisions", []).append(make_collision(data))
        else:
            reading.child("link", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("link", element, child, node)
    if "visuals" in node:
        node["visuals"] = tuple(node["visuals"])
    if "collisions" in node:
        node["collisions"] = tuple(node["collisions"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    if "name" not in node:
        reading.broken = True
    return node


def read_joint(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Joint, from `joint`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        elif name == "type" and text in {"revolute", "continuous", "prismatic", "fixed", "floating", "planar"}:
            node["type"] = text
        else:
            reading.attribute("joint", element, name, text, node)
    if "name" not in node or "type" not in node:
        reading.missing_attributes("joint", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "parent" and place == 1 and child.keys():
            fill_joint_parent(child, node, reading)
        elif tag == "child" and place == 1 and child.keys():
            fill_joint_child(child, node, reading)
        elif tag == "origin" and place == 1:
            data = read_origin(child, source, "origin", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "axis" and place == 1 and child.keys():
            fill_joint_axis(child, node, reading)
        elif tag == "limit" and place == 1:
            data = read_joint_limit(child, source, "limit", None, reading)
            inner = node.setdefault("axis", {"source": data["source"]})
            if len(data) > 1:
                inner["limit"] = make_limit(data)
            else:
                reading.keep(child, node)
        elif tag == "dynamics" and place == 1:
            data = read_joint_dynamics(child, source, "dynamics", None, reading)
            inner = node.setdefault("axis", {"source": data["source"]})
            if len(data) > 1:
                inner["dynamics"] = make_dynamics(data)
            else:
                reading.keep(child, node)
        elif tag == "mimic" and place == 1:
            data = read_joint_mimic(child, source, "mimic", None, reading)
            inner = node.setdefault("axis", {"source": data["source"]})
            if len(data) > 1:
                inner["mimic"] = make_mimic(data)
            else:
                reading.keep(child, node)
        else:
            reading.child("joint", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("joint", element, child, node)
    if "parent" not in counts or "child" not in counts:
        reading.missing_children("joint", element, counts)
    if "axis" in node:
        node["axis"] = make_axis(node["axis"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    if "name" not in node or node.get("type") not in {
        "fixed",
        "revolute",
        "continuous",
        "prismatic",
        "floating",
        "planar",
        "spherical",
        "ball",
        "universal",
        "revolute2",
        "screw",
        "gearbox",
        "piston",
    }:
        reading.broken = True
    return node


def read_material(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Material, from `material`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        else:
            reading.attribute("material", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("material", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "color" and place == 1 and child.keys():
            fill_material_color(child, node, reading)
        elif tag == "texture" and place == 1 and child.keys():
            fill_material_texture(child, node, reading)
        else:
            reading.child("material", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("material", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_gazebo(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a GazeboExtension, from `gazebo`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "reference":
            node["reference"] = text
        else:
            reading.attribute("gazebo", element, name, text, node)
    if (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("gazebo", element, node)
    if len(element):
        node["content"] = tuple([reading.content(child, source) for child in element])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_link_inertial(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Inertial, from `link/inertial`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("link/inertial", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("link/inertial", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "origin" and place == 1:
            data = read_origin(child, source, "origin", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "mass" and place == 1 and child.keys():
            fill_link_inertial_mass(child, node, reading)
        elif tag == "inertia" and place == 1:
            data = read_link_inertial_inertia(child, source, "inertia", None, reading)
            if len(data) > 1:
                node["inertia"] = make_inertia(data)
            else:
                reading.keep(child, node)
        else:
            reading.child("link/inertial", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("link/inertial", element, child, node)
    if "mass" not in counts or "inertia" not in counts:
        reading.missing_children("link/inertial", element, counts)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_link_visual(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Visual, from `link/visual`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        else:
            reading.attribute("link/visual", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("link/visual", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "origin" and place == 1:
            data = read_origin(child, source, "origin", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "geometry" and place == 1:
            data = read_geometry(child, source, "geometry", None, reading)
            if len(data) > 1:
                node["geometry"] = make_geometry(data)
            else:
                reading.keep(child, node)
        elif tag == "material" and place == 1:
            data = read_material(child, source, "material", child.get("name") or None, reading)
            if len(data) > 1:
                node["material"] = make_material(data)
            else:
                reading.keep(child, node)
        else:
            reading.child("link/visual", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("link/visual", element, child, node)
    if "geometry" not in counts:
        reading.missing_children("link/visual", element, counts)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_link_collision(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Collision, from `link/collision`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        else:
            reading.attribute("link/collision", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("link/collision", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "origin" and place == 1:
            data = read_origin(child, source, "origin", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "geometry" and place == 1:
            data = read_geometry(child, source, "geometry", None, reading)
            if len(data) > 1:
                node["geometry"] = make_geometry(data)
            else:
                reading.keep(child, node)
        else:
            reading.child("link/collision", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("link/collision", element, child, node)
    if "geometry" not in counts:
        reading.missing_children("link/collision", element, counts)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def fill_joint_parent(element: XmlElement, node: Data, reading: Reading) -> None:
    """`joint/parent`, which fills the Joint around it."""
    for name, text in element.items():
        if name == "link":
            node["parent"] = text
        else:
            reading.attribute("joint/parent", element, name, text, node, "parent")
    if element.get("link") is None:
        reading.missing_attributes("joint/parent", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/parent", element, node, "parent")
    if len(element):
        reading.children("joint/parent", element, node, "parent")


def fill_joint_child(element: XmlElement, node: Data, reading: Reading) -> None:
    """`joint/child`, which fills the Joint around it."""
    for name, text in element.items():
        if name == "link":
            node["child"] = text
        else:
            reading.attribute("joint/child", element, name, text, node, "child")
    if element.get("link") is None:
        reading.missing_attributes("joint/child", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/child", element, node, "child")
    if len(element):
        reading.children("joint/child", element, node, "child")


def read_origin(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Pose, from `origin`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "xyz" and (value := vector3(text)) is not None:
            node["xyz"] = value
        elif name == "rpy" and (value := vector3(text)) is not None:
            node["rpy"] = value
        elif name == "quat_xyzw" and reading.version >= (1, 1) and (value := quaternion(text)) is not None:
            node["quat_xyzw"] = value
        else:
            reading.attribute("origin", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("origin", element, node)
    if len(element):
        reading.children("origin", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def fill_joint_axis(element: XmlElement, node: Data, reading: Reading) -> None:
    """`joint/axis`, which fills the Joint around it."""
    for name, text in element.items():
        if name == "xyz" and (value := vector3(text)) is not None:
            reading.holder(node, "axis", element)["xyz"] = value
        else:
            reading.attribute("joint/axis", element, name, text, node, "axis")
    if element.get("xyz") is None:
        reading.missing_attributes("joint/axis", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/axis", element, node, "axis")
    if len(element):
        reading.children("joint/axis", element, node, "axis")


def read_joint_limit(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Limit, from `joint/limit`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "lower" and (value := double(text)) is not None:
            node["lower"] = value
        elif name == "upper" and (value := double(text)) is not None:
            node["upper"] = value
        elif name == "effort" and (value := double(text)) is not None and value >= 0.0:
            node["effort"] = value
        elif name == "velocity" and (value := double(text)) is not None and value >= 0.0:
            node["velocity"] = value
        elif (
            name == "acceleration"
            and reading.version >= (1, 2)
            and (value := double(text)) is not None
            and value >= 0.0
        ):
            node["acceleration"] = value
        elif (
            name == "deceleration"
            and reading.version >= (1, 2)
            and (value := double(text)) is not None
            and value >= 0.0
        ):
            node["deceleration"] = value
        elif name == "jerk" and reading.version >= (1, 2) and (value := double(text)) is not None and value >= 0.0:
            node["jerk"] = value
        else:
            reading.attribute("joint/limit", element, name, text, node)
    if "effort" not in node or "velocity" not in node:
        reading.missing_attributes("joint/limit", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/limit", element, node)
    if len(element):
        reading.children("joint/limit", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_joint_dynamics(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Dynamics, from `joint/dynamics`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "damping" and (value := double(text)) is not None:
            node["damping"] = value
        elif name == "friction" and (value := double(text)) is not None:
            node["friction"] = value
        else:
            reading.attribute("joint/dynamics", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/dynamics", element, node)
    if len(element):
        reading.children("joint/dynamics", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_joint_mimic(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Mimic, from `joint/mimic`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "joint":
            node["joint"] = text
        elif name == "multiplier" and (value := double(text)) is not None:
            node["multiplier"] = value
        elif name == "offset" and (value := double(text)) is not None:
            node["offset"] = value
        else:
            reading.attribute("joint/mimic", element, name, text, node)
    if "joint" not in node:
        reading.missing_attributes("joint/mimic", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/mimic", element, node)
    if len(element):
        reading.children("joint/mimic", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def fill_material_color(element: XmlElement, node: Data, reading: Reading) -> None:
    """`material/color`, which fills the Material around it."""
    for name, text in element.items():
        if name == "rgba" and (value := color4(text)) is not None and min(value) >= 0.0 and max(value) <= 1.0:
            node["color"] = value
        else:
            reading.attribute("material/color", element, name, text, node, "color")
    if element.get("rgba") is None:
        reading.missing_attributes("material/color", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("material/color", element, node, "color")
    if len(element):
        reading.children("material/color", element, node, "color")


def fill_material_texture(element: XmlElement, node: Data, reading: Reading) -> None:
    """`material/texture`, which fills the Material around it."""
    for name, text in element.items():
        if name == "filename":
            node["texture"] = text
        else:
            reading.attribute("material/texture", element, name, text, node, "texture")
    if element.get("filename") is None:
        reading.missing_attributes("material/texture", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("material/texture", element, node, "texture")
    if len(element):
        reading.children("material/texture", element, node, "texture")


def fill_link_inertial_mass(element: XmlElement, node: Data, reading: Reading) -> None:
    """`link/inertial/mass`, which fills the Inertial around it."""
    for name, text in element.items():
        if name == "value" and (value := double(text)) is not None and value >= 0.0:
            node["mass"] = value
        else:
            reading.attribute("link/inertial/mass", element, name, text, node, "mass")
    if element.get("value") is None:
        reading.missing_attributes("link/inertial/mass", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("link/inertial/mass", element, node, "mass")
    if len(element):
        reading.children("link/inertial/mass", element, node, "mass")


def read_link_inertial_inertia(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Inertia, from `link/inertial/inertia`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "ixx" and (value := double(text)) is not None:
            node["ixx"] = value
        elif name == "ixy" and (value := double(text)) is not None:
            node["ixy"] = value
        elif name == "ixz" and (value := double(text)) is not None:
            node["ixz"] = value
        elif name == "iyy" and (value := double(text)) is not None:
            node["iyy"] = value
        elif name == "iyz" and (value := double(text)) is not None:
            node["iyz"] = value
        elif name == "izz" and (value := double(text)) is not None:
            node["izz"] = value
        else:
            reading.attribute("link/inertial/inertia", element, name, text, node)
    if (
        "ixx" not in node
        or "ixy" not in node
        or "ixz" not in node
        or "iyy" not in node
        or "iyz" not in node
        or "izz" not in node
    ):
        reading.missing_attributes("link/inertial/inertia", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("link/inertial/inertia", element, node)
    if len(element):
        reading.children("link/inertial/inertia", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_geometry(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Geometry, from `geometry`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("geometry", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("geometry", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "box" and place == 1 and "shape" not in node:
            node["shape"] = make_box(read_geometry_box(child, source, "box", None, reading))
        elif tag == "cylinder" and place == 1 and "shape" not in node:
            node["shape"] = make_cylinder(read_geometry_cylinder(child, source, "cylinder", None, reading))
        elif tag == "sphere" and place == 1 and "shape" not in node:
            node["shape"] = make_sphere(read_geometry_sphere(child, source, "sphere", None, reading))
        elif tag == "capsule" and place == 1 and "shape" not in node:
            if reading.version <= (1, 0):
                reading.other_version("geometry", child)
            node["shape"] = make_capsule(read_geometry_capsule(child, source, "capsule", None, reading))
        elif tag == "mesh" and place == 1 and "shape" not in node:
            node["shape"] = make_mesh(read_geometry_mesh(child, source, "mesh", None, reading))
        else:
            reading.child("geometry", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("geometry", element, child, node)
    if len(counts) > 1:
        reading.missing_children("geometry", element, counts)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_geometry_box(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Box, from `geometry/box`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "box"}
    for name, text in element.items():
        if name == "size" and (value := vector3(text)) is not None and min(value) >= 0.0:
            node["size"] = value
        else:
            reading.attribute("geometry/box", element, name, text, node)
    if "size" not in node:
        reading.missing_attributes("geometry/box", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("geometry/box", element, node)
    if len(element):
        reading.children("geometry/box", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_geometry_cylinder(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Cylinder, from `geometry/cylinder`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "cylinder"}
    for name, text in element.items():
        if name == "radius" and (value := double(text)) is not None and value >= 0.0:
            node["radius"] = value
        elif name == "length" and (value := double(text)) is not None and value >= 0.0:
            node["length"] = value
        else:
            reading.attribute("geometry/cylinder", element, name, text, node)
    if "radius" not in node or "length" not in node:
        reading.missing_attributes("geometry/cylinder", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("geometry/cylinder", element, node)
    if len(element):
        reading.children("geometry/cylinder", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_geometry_sphere(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Sphere, from `geometry/sphere`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "sphere"}
    for name, text in element.items():
        if name == "radius" and (value := double(text)) is not None and value >= 0.0:
            node["radius"] = value
        else:
            reading.attribute("geometry/sphere", element, name, text, node)
    if "radius" not in node:
        reading.missing_attributes("geometry/sphere", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("geometry/sphere", element, node)
    if len(element):
        reading.children("geometry/sphere", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_geometry_capsule(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Capsule, from `geometry/capsule`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "capsule"}
    for name, text in element.items():
        if name == "radius" and (value := double(text)) is not None and value >= 0.0:
            node["radius"] = value
        elif name == "length" and (value := double(text)) is not None and value >= 0.0:
            node["length"] = value
        else:
            reading.attribute("geometry/capsule", element, name, text, node)
    if "radius" not in node or "length" not in node:
        reading.missing_attributes("geometry/capsule", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("geometry/capsule", element, node)
    if len(element):
        reading.children("geometry/capsule", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_geometry_mesh(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Mesh, from `geometry/mesh`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "mesh"}
    for name, text in element.items():
        if name == "filename":
            node["uri"] = text
        elif name == "scale" and (value := vector3(text)) is not None:
            node["scale"] = value
        else:
            reading.attribute("geometry/mesh", element, name, text, node)
    if "uri" not in node:
        reading.missing_attributes("geometry/mesh", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("geometry/mesh", element, node)
    if len(element):
        reading.children("geometry/mesh", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node
