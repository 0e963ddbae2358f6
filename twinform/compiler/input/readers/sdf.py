"""The generated reader of SDF: a function for each element that makes a node, or fills one.

Written by `python -m twinform.compiler.input.readers.generate` from the facts tables; not to be edited.
"""

from typing import Any

from twinform.compiler.input.readers.reading import Reading
from twinform.compiler.input.readers.values import (
    BOOLS,
    color,
    integer,
    loose_double,
    only_text,
    pose,
    stripped,
    vector2d,
    vector3,
)
from twinform.diagnostics import Source
from twinform.ir import (
    Axis,
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Document,
    Dynamics,
    Ellipsoid,
    Empty,
    Format,
    Frame,
    Geometry,
    Heightmap,
    Image,
    Include,
    Inertia,
    Inertial,
    Joint,
    Light,
    Limit,
    Link,
    Material,
    Mesh,
    Mimic,
    Model,
    Plane,
    Plugin,
    Polyline,
    Pose,
    Script,
    Sensor,
    Sphere,
    Surface,
    Visual,
    World,
)
from twinform.ir.record import maker
from twinform.schemas import Data, XmlElement, locate

make_axis = maker(Axis)
make_box = maker(Box)
make_capsule = maker(Capsule)
make_collision = maker(Collision)
make_cone = maker(Cone)
make_cylinder = maker(Cylinder)
make_document = maker(Document)
make_dynamics = maker(Dynamics)
make_ellipsoid = maker(Ellipsoid)
make_empty = maker(Empty)
make_frame = maker(Frame)
make_geometry = maker(Geometry)
make_heightmap = maker(Heightmap)
make_image = maker(Image)
make_include = maker(Include)
make_inertia = maker(Inertia)
make_inertial = maker(Inertial)
make_joint = maker(Joint)
make_light = maker(Light)
make_limit = maker(Limit)
make_link = maker(Link)
make_material = maker(Material)
make_mesh = maker(Mesh)
make_mimic = maker(Mimic)
make_model = maker(Model)
make_plane = maker(Plane)
make_plugin = maker(Plugin)
make_polyline = maker(Polyline)
make_pose = maker(Pose)
make_script = maker(Script)
make_sensor = maker(Sensor)
make_sphere = maker(Sphere)
make_surface = maker(Surface)
make_visual = maker(Visual)
make_world = maker(World)


def read_sdf(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Document, from `sdf`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "format": Format.SDF}
    for name, text in element.items():
        if name == "version":
            node["version"] = text
        else:
            reading.attribute("sdf", element, name, text, node)
    if "version" not in node:
        reading.missing_attributes("sdf", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("sdf", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "world":
            data = read_world(child, source, "world", child.get("name") or place, reading)
            node.setdefault("worlds", []).append(make_world(data))
        elif tag == "model" and reading.version <= (1, 7):
            data = read_model(child, source, "model", child.get("name") or place, reading)
            node.setdefault("models", []).append(make_model(data))
        elif tag == "model" and reading.version >= (1, 8) and place == 1:
            data = read_model(child, source, "model", child.get("name") or None, reading)
            node.setdefault("models", []).append(make_model(data))
        elif tag == "light" and reading.version <= (1, 7):
            data = read_light(child, source, "light", child.get("name") or place, reading)
            node.setdefault("lights", []).append(make_light(data))
        elif tag == "light" and reading.version >= (1, 8) and place == 1:
            data = read_light(child, source, "light", child.get("name") or None, reading)
            node.setdefault("lights", []).append(make_light(data))
        elif tag == "include":
            data = read_include(child, source, "include", place, reading)
            node.setdefault("includes", []).append(make_include(data))
        else:
            reading.child("sdf", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("sdf", element, child, node)
    if "worlds" in node:
        node["worlds"] = tuple(node["worlds"])
    if "models" in node:
        node["models"] = tuple(node["models"])
    if "lights" in node:
        node["lights"] = tuple(node["lights"])
    if "includes" in node:
        node["includes"] = tuple(node["includes"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_world(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a World, from `world`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        else:
            reading.attribute("world", element, name, text, node)
    if "name" not in node:
        reading.missing_attributes("world", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("world", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "include":
            data = read_include(child, source, "include", place, reading)
            node.setdefault("includes", []).append(make_include(data))
        elif (
            tag == "gravity"
            and reading.version >= (1, 6)
            and place == 1
            and (value := vector3(text_of(child))) is not None
        ):
            node["gravity"] = value
        elif tag == "light":
            data = read_light(child, source, "light", child.get("name") or place, reading)
            node.setdefault("lights", []).append(make_light(data))
        elif tag == "frame":
            if reading.version <= (1, 6):
                reading.other_version("world", child)
            data = read_frame(child, source, "frame", child.get("name") or place, reading)
            node.setdefault("frames", []).append(make_frame(data))
        elif tag == "joint":
            if (1, 7) <= reading.version <= (1, 9):
                reading.other_version("world", child)
            data = read_joint(child, source, "joint", child.get("name") or place, reading)
            node.setdefault("joints", []).append(make_joint(data))
        elif tag == "model":
            data = read_model(child, source, "model", child.get("name") or place, reading)
            node.setdefault("models", []).append(make_model(data))
        elif tag == "plugin":
            data = read_plugin(child, source, "plugin", child.get("name") or place, reading)
            node.setdefault("plugins", []).append(make_plugin(data))
        else:
            reading.child("world", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("world", element, child, node)
    if "includes" in node:
        node["includes"] = tuple(node["includes"])
    if "lights" in node:
        node["lights"] = tuple(node["lights"])
    if "frames" in node:
        node["frames"] = tuple(node["frames"])
    if "joints" in node:
        node["joints"] = tuple(node["joints"])
    if "models" in node:
        node["models"] = tuple(node["models"])
    if "plugins" in node:
        node["plugins"] = tuple(node["plugins"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    if "name" not in node:
        reading.broken = True
    return node


def read_model(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Model, from `model`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        elif name == "canonical_link" and reading.version >= (1, 7):
            node["canonical_link"] = text
        elif name == "placement_frame" and reading.version >= (1, 8):
            node["placement_frame"] = text
        else:
            reading.attribute("model", element, name, text, node)
    if "name" not in node:
        reading.missing_attributes("model", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("model", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "static" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["static"] = value
        elif (
            tag == "self_collide"
            and reading.version >= (1, 5)
            and place == 1
            and (value := BOOLS.get(text_of(child))) is not None
        ):
            node["self_collide"] = value
        elif tag == "allow_auto_disable" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["allow_auto_disable"] = value
        elif tag == "frame":
            if reading.version <= (1, 4):
                reading.other_version("model", child)
            data = read_frame(child, source, "frame", child.get("name") or place, reading)
            node.setdefault("frames", []).append(make_frame(data))
        elif tag == "link":
            data = read_link(child, source, "link", child.get("name") or place, reading)
            node.setdefault("links", []).append(make_link(data))
        elif tag == "joint":
            data = read_joint(child, source, "joint", child.get("name") or place, reading)
            node.setdefault("joints", []).append(make_joint(data))
        elif tag == "plugin":
            data = read_plugin(child, source, "plugin", child.get("name") or place, reading)
            node.setdefault("plugins", []).append(make_plugin(data))
        elif tag == "include":
            data = read_include(child, source, "include", place, reading)
            node.setdefault("includes", []).append(make_include(data))
        elif tag == "model":
            if reading.version <= (1, 4):
                reading.other_version("model", child)
            data = read_model(child, source, "model", child.get("name") or place, reading)
            node.setdefault("models", []).append(make_model(data))
        elif (
            tag == "enable_wind"
            and reading.version >= (1, 6)
            and place == 1
            and (value := BOOLS.get(text_of(child))) is not None
        ):
            node["enable_wind"] = value
        else:
            reading.child("model", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("model", element, child, node)
    if "link" not in counts:
        reading.missing_children("model", element, counts)
    if "frames" in node:
        node["frames"] = tuple(node["frames"])
    if "links" in node:
        node["links"] = tuple(node["links"])
    if "joints" in node:
        node["joints"] = tuple(node["joints"])
    if "plugins" in node:
        node["plugins"] = tuple(node["plugins"])
    if "includes" in node:
        node["includes"] = tuple(node["includes"])
    if "models" in node:
        node["models"] = tuple(node["models"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    if "name" not in node:
        reading.broken = True
    return node


def read_light(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Light, from `light`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        elif name == "type" and text in {"point", "directional", "spot"}:
            node["type"] = text
        else:
            reading.attribute("light", element, name, text, node)
    if "name" not in node or "type" not in node:
        reading.missing_attributes("light", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("light", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "cast_shadows" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["cast_shadows"] = value
        elif (
            tag == "intensity"
            and reading.version >= (1, 8)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["intensity"] = value
        elif (
            tag == "diffuse"
            and place == 1
            and (value := color(text_of(child))) is not None
            and min(value) >= 0.0
            and max(value) <= 1.0
        ):
            node["diffuse"] = value
        elif (
            tag == "specular"
            and place == 1
            and (value := color(text_of(child))) is not None
            and min(value) >= 0.0
            and max(value) <= 1.0
        ):
            node["specular"] = value
        elif tag == "direction" and place == 1 and (value := vector3(text_of(child))) is not None:
            node["direction"] = value
        else:
            reading.child("light", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("light", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_include(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Include, from `include`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "merge" and reading.version >= (1, 9) and (value := BOOLS.get(text)) is not None:
            node["merge"] = value
        else:
            reading.attribute("include", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("include", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "uri" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["uri"] = value
        elif tag == "name" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["name"] = value
        elif tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "plugin":
            data = read_plugin(child, source, "plugin", child.get("name") or place, reading)
            node.setdefault("plugins", []).append(make_plugin(data))
        elif tag == "static" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["static"] = value
        elif (
            tag == "placement_frame"
            and reading.version >= (1, 8)
            and place == 1
            and (value := stripped(text_of(child))) is not None
        ):
            node["placement_frame"] = value
        else:
            reading.child("include", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("include", element, child, node)
    if "uri" not in counts:
        reading.missing_children("include", element, counts)
    if "plugins" in node:
        node["plugins"] = tuple(node["plugins"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_frame(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Frame, from `frame`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        elif name == "attached_to" and reading.version >= (1, 7):
            node["attached_to"] = text
        else:
            reading.attribute("frame", element, name, text, node)
    if "name" not in node:
        reading.missing_attributes("frame", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("frame", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        else:
            reading.child("frame", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("frame", element, child, node)
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
        elif (
            name == "type"
            and reading.version <= (1, 3)
            and text in {"ball", "piston", "prismatic", "revolute", "revolute2", "universal"}
        ):
            node["type"] = text
        elif (
            name == "type"
            and (1, 4) <= reading.version <= (1, 4)
            and text in {"ball", "gearbox", "piston", "prismatic", "revolute", "revolute2", "universal"}
        ):
            node["type"] = text
        elif (
            name == "type"
            and (1, 5) <= reading.version <= (1, 5)
            and text in {"ball", "fixed", "gearbox", "prismatic", "revolute", "revolute2", "screw", "universal"}
        ):
            node["type"] = text
        elif (
            name == "type"
            and reading.version >= (1, 6)
            and text
            in {"ball", "continuous", "fixed", "gearbox", "prismatic", "revolute", "revolute2", "screw", "universal"}
        ):
            node["type"] = text
        else:
            reading.attribute("joint", element, name, text, node)
    if "name" not in node or "type" not in node:
        reading.missing_attributes("joint", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "parent" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["parent"] = value
        elif tag == "child" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["child"] = value
        elif (
            tag == "gearbox_ratio"
            and reading.version >= (1, 4)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["gearbox_ratio"] = value
        elif (
            tag == "gearbox_reference_body"
            and reading.version >= (1, 4)
            and place == 1
            and (value := stripped(text_of(child))) is not None
        ):
            node["gearbox_reference_body"] = value
        elif (
            tag == "thread_pitch"
            and reading.version <= (1, 9)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["thread_pitch"] = value
        elif (
            tag == "screw_thread_pitch"
            and reading.version >= (1, 10)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["screw_thread_pitch"] = value
        elif tag == "axis" and place == 1:
            data = read_joint_axis(child, source, "axis", None, reading)
            if len(data) > 1:
                node["axis"] = make_axis(data)
            else:
                reading.keep(child, node)
        elif tag == "axis2" and place == 1:
            data = read_joint_axis(child, source, "axis2", None, reading)
            if len(data) > 1:
                node["axis2"] = make_axis(data)
            else:
                reading.keep(child, node)
        elif tag == "sensor":
            if reading.version <= (1, 3):
                reading.other_version("joint", child)
            data = read_sensor(child, source, "sensor", child.get("name") or place, reading)
            node.setdefault("sensors", []).append(make_sensor(data))
        else:
            reading.child("joint", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("joint", element, child, node)
    if "parent" not in counts or "child" not in counts:
        reading.missing_children("joint", element, counts)
    if "sensors" in node:
        node["sensors"] = tuple(node["sensors"])
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


def read_plugin(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Plugin, from `plugin`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        elif name == "filename":
            node["filename"] = text
        else:
            reading.attribute("plugin", element, name, text, node)
    if "name" not in node or "filename" not in node:
        reading.missing_attributes("plugin", element)
    if (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("plugin", element, node)
    if len(element):
        node["content"] = tuple([reading.content(child, source) for child in element])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_pose(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Pose, from `pose`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "relative_to" and reading.version >= (1, 7):
            node["relative_to"] = text
        elif name == "rotation_format" and reading.version >= (1, 9) and text in {"euler_rpy", "quat_xyzw"}:
            node["rotation_format"] = text
        elif name == "degrees" and reading.version >= (1, 9) and (value := BOOLS.get(text)) is not None:
            node["degrees"] = value
        else:
            reading.attribute("pose", element, name, text, node)
    if (value := pose(element.text)) is not None and node.get("rotation_format") != "quat_xyzw":
        node["xyz"], node["rpy"] = value
    else:
        reading.text("pose", element, node)
    if len(element):
        reading.children("pose", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
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
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "gravity" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["gravity"] = value
        elif (
            tag == "enable_wind"
            and reading.version >= (1, 6)
            and place == 1
            and (value := BOOLS.get(text_of(child))) is not None
        ):
            node["enable_wind"] = value
        elif tag == "self_collide" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["self_collide"] = value
        elif tag == "kinematic" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["kinematic"] = value
        elif tag == "inertial" and place == 1:
            data = read_inertial(child, source, "inertial", None, reading)
            if len(data) > 1:
                node["inertial"] = make_inertial(data)
            else:
                reading.keep(child, node)
        elif tag == "collision":
            data = read_collision(child, source, "collision", child.get("name") or place, reading)
            node.setdefault("collisions", []).append(make_collision(data))
        elif tag == "visual":
            data = read_visual(child, source, "visual", child.get("name") or place, reading)
            node.setdefault("visuals", []).append(make_visual(data))
        elif tag == "sensor":
            data = read_sensor(child, source, "sensor", child.get("name") or place, reading)
            node.setdefault("sensors", []).append(make_sensor(data))
        elif tag == "light":
            if reading.version <= (1, 5):
                reading.other_version("link", child)
            data = read_light(child, source, "light", child.get("name") or place, reading)
            node.setdefault("lights", []).append(make_light(data))
        else:
            reading.child("link", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("link", element, child, node)
    if "collisions" in node:
        node["collisions"] = tuple(node["collisions"])
    if "visuals" in node:
        node["visuals"] = tuple(node["visuals"])
    if "sensors" in node:
        node["sensors"] = tuple(node["sensors"])
    if "lights" in node:
        node["lights"] = tuple(node["lights"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    if "name" not in node:
        reading.broken = True
    return node


def read_joint_axis(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Axis, from `joint/axis`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("joint/axis", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/axis", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "xyz" and place == 1 and (value := vector3(only_text(child))) is not None:
            node["xyz"] = value
        elif tag == "dynamics" and place == 1:
            data = read_joint_axis_dynamics(child, source, "dynamics", None, reading)
            if len(data) > 1:
                node["dynamics"] = make_dynamics(data)
            else:
                reading.keep(child, node)
        elif tag == "limit" and place == 1:
            data = read_joint_axis_limit(child, source, "limit", None, reading)
            if len(data) > 1:
                node["limit"] = make_limit(data)
            else:
                reading.keep(child, node)
        elif tag == "mimic" and place == 1:
            if reading.version <= (1, 10):
                reading.other_version("joint/axis", child)
            data = read_mimic(child, source, "mimic", None, reading)
            if len(data) > 1:
                node["mimic"] = make_mimic(data)
            else:
                reading.keep(child, node)
        elif (
            tag == "use_parent_model_frame"
            and (1, 5) <= reading.version <= (1, 6)
            and place == 1
            and (value := BOOLS.get(text_of(child))) is not None
        ):
            node["use_parent_model_frame"] = value
        else:
            reading.child("joint/axis", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("joint/axis", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_sensor(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Sensor, from `sensor`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        elif name == "type" and text in {
            "air_pressure",
            "air_speed",
            "altimeter",
            "boundingbox",
            "boundingbox_camera",
            "camera",
            "contact",
            "custom",
            "depth",
            "depth_camera",
            "force_torque",
            "gps",
            "gpu_lidar",
            "gpu_ray",
            "imu",
            "ir",
            "lidar",
            "logical_camera",
            "magnetometer",
            "multicamera",
            "navsat",
            "ray",
            "rfid",
            "rfidtag",
            "rgbd",
            "rgbd_camera",
            "segmentation",
            "segmentation_camera",
            "sonar",
            "stereocamera",
            "thermal",
            "thermal_camera",
            "wide_angle_camera",
            "wideanglecamera",
            "wireless_receiver",
            "wireless_transmitter",
        }:
            node["type"] = text
        else:
            reading.attribute("sensor", element, name, text, node)
    if "name" not in node or "type" not in node:
        reading.missing_attributes("sensor", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("sensor", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "always_on" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["always_on"] = value
        elif tag == "update_rate" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["update_rate"] = value
        elif tag == "visualize" and place == 1 and (value := BOOLS.get(text_of(child))) is not None:
            node["visualize"] = value
        elif tag == "topic" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["topic"] = value
        elif (
            tag == "enable_metrics"
            and reading.version >= (1, 7)
            and place == 1
            and (value := BOOLS.get(text_of(child))) is not None
        ):
            node["enable_metrics"] = value
        elif (
            tag == "frame_id"
            and reading.version >= (1, 12)
            and place == 1
            and (value := stripped(text_of(child))) is not None
        ):
            node["frame_id"] = value
        elif tag == "plugin":
            data = read_plugin(child, source, "plugin", child.get("name") or place, reading)
            node.setdefault("plugins", []).append(make_plugin(data))
        else:
            reading.child("sensor", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("sensor", element, child, node)
    if "plugins" in node:
        node["plugins"] = tuple(node["plugins"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_inertial(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Inertial, from `inertial`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "auto" and reading.version >= (1, 11) and (value := BOOLS.get(text)) is not None:
            node["auto"] = value
        else:
            reading.attribute("inertial", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("inertial", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and reading.version <= (1, 7) and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "pose" and reading.version >= (1, 8) and place == 1:
            data = read_inertial_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "mass" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["mass"] = value
        elif tag == "inertia" and place == 1:
            data = read_inertial_inertia(child, source, "inertia", None, reading)
            if len(data) > 1:
                node["inertia"] = make_inertia(data)
            else:
                reading.keep(child, node)
        else:
            reading.child("inertial", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("inertial", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_collision(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Collision, from `collision`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        else:
            reading.attribute("collision", element, name, text, node)
    if "name" not in node:
        reading.missing_attributes("collision", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("collision", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
            if len(data) > 1:
                node["pose"] = make_pose(data)
            else:
                reading.keep(child, node)
        elif tag == "laser_retro" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["laser_retro"] = value
        elif tag == "max_contacts" and place == 1 and (value := integer(text_of(child))) is not None:
            node["max_contacts"] = value
        elif tag == "geometry" and place == 1:
            data = read_geometry(child, source, "geometry", None, reading)
            if len(data) > 1:
                node["geometry"] = make_geometry(data)
            else:
                reading.keep(child, node)
        elif tag == "surface" and place == 1:
            data = read_surface(child, source, "surface", None, reading)
            if len(data) > 1:
                node["surface"] = make_surface(data)
            else:
                reading.keep(child, node)
        else:
            reading.child("collision", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("collision", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_visual(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Visual, from `visual`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "name":
            node["name"] = text
        else:
            reading.attribute("visual", element, name, text, node)
    if "name" not in node:
        reading.missing_attributes("visual", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("visual", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "pose" and place == 1:
            data = read_pose(child, source, "pose", None, reading)
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
            data = read_material(child, source, "material", None, reading)
            if len(data) > 1:
                node["material"] = make_material(data)
            else:
                reading.keep(child, node)
        elif tag == "plugin":
            if reading.version <= (1, 2):
                reading.other_version("visual", child)
            data = read_plugin(child, source, "plugin", child.get("name") or place, reading)
            node.setdefault("plugins", []).append(make_plugin(data))
        else:
            reading.child("visual", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("visual", element, child, node)
    if "plugins" in node:
        node["plugins"] = tuple(node["plugins"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_joint_axis_dynamics(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Dynamics, from `joint/axis/dynamics`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("joint/axis/dynamics", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/axis/dynamics", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "damping" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["damping"] = value
        elif tag == "friction" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["friction"] = value
        elif (
            tag == "spring_reference"
            and reading.version >= (1, 5)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["spring_reference"] = value
        elif (
            tag == "spring_stiffness"
            and reading.version >= (1, 5)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["spring_stiffness"] = value
        else:
            reading.child("joint/axis/dynamics", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("joint/axis/dynamics", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_joint_axis_limit(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Limit, from `joint/axis/limit`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("joint/axis/limit", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("joint/axis/limit", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "lower" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["lower"] = value
        elif tag == "upper" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["upper"] = value
        elif tag == "effort" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["effort"] = value
        elif tag == "velocity" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["velocity"] = value
        elif (
            tag == "stiffness"
            and reading.version >= (1, 4)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["stiffness"] = value
        elif (
            tag == "dissipation"
            and reading.version >= (1, 4)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["dissipation"] = value
        else:
            reading.child("joint/axis/limit", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("joint/axis/limit", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_mimic(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Mimic, from `mimic`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "joint":
            node["joint"] = text
        elif name == "axis" and text in {"axis", "axis2"}:
            node["axis"] = text
        else:
            reading.attribute("mimic", element, name, text, node)
    if "joint" not in node:
        reading.missing_attributes("mimic", element)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("mimic", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "multiplier" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["multiplier"] = value
        elif tag == "offset" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["offset"] = value
        elif tag == "reference" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["reference"] = value
        else:
            reading.child("mimic", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("mimic", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_inertial_pose(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Pose, from `inertial_pose`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        if name == "rotation_format" and reading.version >= (1, 9) and text in {"euler_rpy", "quat_xyzw"}:
            node["rotation_format"] = text
        elif name == "degrees" and reading.version >= (1, 9) and (value := BOOLS.get(text)) is not None:
            node["degrees"] = value
        else:
            reading.attribute("inertial_pose", element, name, text, node)
    if (value := pose(element.text)) is not None and node.get("rotation_format") != "quat_xyzw":
        node["xyz"], node["rpy"] = value
    else:
        reading.text("inertial_pose", element, node)
    if len(element):
        reading.children("inertial_pose", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_inertial_inertia(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Inertia, from `inertial/inertia`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("inertial/inertia", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("inertial/inertia", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "ixx" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["ixx"] = value
        elif tag == "ixy" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["ixy"] = value
        elif tag == "ixz" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["ixz"] = value
        elif tag == "iyy" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["iyy"] = value
        elif tag == "iyz" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["iyz"] = value
        elif tag == "izz" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["izz"] = value
        else:
            reading.child("inertial/inertia", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("inertial/inertia", element, child, node)
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
        if tag == "empty" and place == 1 and "shape" not in node:
            if reading.version <= (1, 2):
                reading.other_version("geometry", child)
            node["shape"] = make_empty(read_geometry_empty(child, source, "empty", None, reading))
        elif tag == "box" and place == 1 and "shape" not in node:
            node["shape"] = make_box(read_box_shape(child, source, "box", None, reading))
        elif tag == "capsule" and place == 1 and "shape" not in node:
            if reading.version <= (1, 7):
                reading.other_version("geometry", child)
            node["shape"] = make_capsule(read_capsule_shape(child, source, "capsule", None, reading))
        elif tag == "cone" and place == 1 and "shape" not in node:
            if reading.version <= (1, 10):
                reading.other_version("geometry", child)
            node["shape"] = make_cone(read_cone_shape(child, source, "cone", None, reading))
        elif tag == "cylinder" and place == 1 and "shape" not in node:
            node["shape"] = make_cylinder(read_cylinder_shape(child, source, "cylinder", None, reading))
        elif tag == "ellipsoid" and place == 1 and "shape" not in node:
            if reading.version <= (1, 7):
                reading.other_version("geometry", child)
            node["shape"] = make_ellipsoid(read_ellipsoid_shape(child, source, "ellipsoid", None, reading))
        elif tag == "heightmap" and place == 1 and "shape" not in node:
            node["shape"] = make_heightmap(read_heightmap_shape(child, source, "heightmap", None, reading))
        elif tag == "image" and place == 1 and "shape" not in node:
            node["shape"] = make_image(read_image_shape(child, source, "image", None, reading))
        elif tag == "mesh" and place == 1 and "shape" not in node:
            node["shape"] = make_mesh(read_mesh_shape(child, source, "mesh", None, reading))
        elif tag == "plane" and place == 1 and "shape" not in node:
            node["shape"] = make_plane(read_plane_shape(child, source, "plane", None, reading))
        elif tag == "polyline" and "shape" not in node:
            if reading.version <= (1, 4):
                reading.other_version("geometry", child)
            node["shape"] = make_polyline(read_polyline_shape(child, source, "polyline", place, reading))
        elif tag == "sphere" and place == 1 and "shape" not in node:
            node["shape"] = make_sphere(read_sphere_shape(child, source, "sphere", None, reading))
        else:
            reading.child("geometry", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("geometry", element, child, node)
    if len(counts) > 1:
        reading.missing_children("geometry", element, counts)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_surface(element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading) -> Data:
    """The values of a Surface, from `surface`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("surface", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("surface", element, node)
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "bounce" and place == 1 and len(child):
            fill_surface_bounce(child, node, reading)
        elif tag == "friction" and place == 1 and len(child):
            fill_surface_friction(child, node, reading)
        elif tag == "contact" and place == 1 and len(child):
            fill_surface_contact(child, node, reading)
        else:
            reading.child("surface", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("surface", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_material(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Material, from `material`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("material", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("material", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "script" and place == 1:
            data = read_material_script(child, source, "script", None, reading)
            if len(data) > 1:
                node["script"] = make_script(data)
            else:
                reading.keep(child, node)
        elif (
            tag == "ambient"
            and place == 1
            and (value := color(text_of(child))) is not None
            and min(value) >= 0.0
            and max(value) <= 1.0
        ):
            node["ambient"] = value
        elif (
            tag == "diffuse"
            and place == 1
            and (value := color(text_of(child))) is not None
            and min(value) >= 0.0
            and max(value) <= 1.0
        ):
            node["diffuse"] = value
        elif (
            tag == "specular"
            and place == 1
            and (value := color(text_of(child))) is not None
            and min(value) >= 0.0
            and max(value) <= 1.0
        ):
            node["specular"] = value
        elif (
            tag == "emissive"
            and place == 1
            and (value := color(text_of(child))) is not None
            and min(value) >= 0.0
            and max(value) <= 1.0
        ):
            node["emissive"] = value
        elif tag == "pbr" and place == 1 and len(child):
            if reading.version <= (1, 5):
                reading.other_version("material", child)
            fill_material_pbr(child, node, reading)
        else:
            reading.child("material", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("material", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_geometry_empty(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Empty, from `geometry/empty`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "empty"}
    for name, text in element.items():
        reading.attribute("geometry/empty", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("geometry/empty", element, node)
    if len(element):
        reading.children("geometry/empty", element, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_box_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Box, from `box_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "box"}
    for name, text in element.items():
        reading.attribute("box_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("box_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "size" and place == 1 and (value := vector3(text_of(child))) is not None and min(value) >= 0.0:
            node["size"] = value
        else:
            reading.child("box_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("box_shape", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_capsule_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Capsule, from `capsule_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "capsule"}
    for name, text in element.items():
        reading.attribute("capsule_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("capsule_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "radius" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["radius"] = value
        elif tag == "length" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["length"] = value
        else:
            reading.child("capsule_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("capsule_shape", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_cone_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Cone, from `cone_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "cone"}
    for name, text in element.items():
        reading.attribute("cone_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("cone_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "radius" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["radius"] = value
        elif tag == "length" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["length"] = value
        else:
            reading.child("cone_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("cone_shape", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_cylinder_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Cylinder, from `cylinder_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "cylinder"}
    for name, text in element.items():
        reading.attribute("cylinder_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("cylinder_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "radius" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["radius"] = value
        elif tag == "length" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["length"] = value
        else:
            reading.child("cylinder_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("cylinder_shape", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_ellipsoid_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Ellipsoid, from `ellipsoid_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "ellipsoid"}
    for name, text in element.items():
        reading.attribute("ellipsoid_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("ellipsoid_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "radii" and place == 1 and (value := vector3(text_of(child))) is not None and min(value) >= 0.0:
            node["radii"] = value
        else:
            reading.child("ellipsoid_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("ellipsoid_shape", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_heightmap_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Heightmap, from `heightmap_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "heightmap"}
    for name, text in element.items():
        reading.attribute("heightmap_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("heightmap_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "uri" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["uri"] = value
        else:
            reading.child("heightmap_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("heightmap_shape", element, child, node)
    if "uri" not in counts:
        reading.missing_children("heightmap_shape", element, counts)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_image_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Image, from `image_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "image"}
    for name, text in element.items():
        reading.attribute("image_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("image_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "uri" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["uri"] = value
        else:
            reading.child("image_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("image_shape", element, child, node)
    if "uri" not in counts:
        reading.missing_children("image_shape", element, counts)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_mesh_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Mesh, from `mesh_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "mesh"}
    for name, text in element.items():
        reading.attribute("mesh_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("mesh_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "uri" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["uri"] = value
        elif tag == "scale" and place == 1 and (value := vector3(text_of(child))) is not None:
            node["scale"] = value
        else:
            reading.child("mesh_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("mesh_shape", element, child, node)
    if "uri" not in counts:
        reading.missing_children("mesh_shape", element, counts)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_plane_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Plane, from `plane_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "plane"}
    for name, text in element.items():
        reading.attribute("plane_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("plane_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "normal" and place == 1 and (value := vector3(text_of(child))) is not None:
            node["normal"] = value
        elif tag == "size" and place == 1 and (value := vector2d(text_of(child))) is not None and min(value) >= 0.0:
            node["size"] = value
        else:
            reading.child("plane_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("plane_shape", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_polyline_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Polyline, from `polyline_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "polyline"}
    for name, text in element.items():
        reading.attribute("polyline_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("polyline_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "height" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["height"] = value
        else:
            reading.child("polyline_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("polyline_shape", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def read_sphere_shape(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Sphere, from `sphere_shape`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source, "kind": "sphere"}
    for name, text in element.items():
        reading.attribute("sphere_shape", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("sphere_shape", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "radius" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["radius"] = value
        else:
            reading.child("sphere_shape", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("sphere_shape", element, child, node)
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def fill_surface_bounce(element: XmlElement, node: Data, reading: Reading) -> None:
    """`surface/bounce`, which fills the Surface around it."""
    for name, text in element.items():
        reading.attribute("surface/bounce", element, name, text, node, "bounce")
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("surface/bounce", element, node, "bounce")
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if (
            tag == "restitution_coefficient"
            and place == 1
            and (value := loose_double(text_of(child))) is not None
            and value >= 0.0
            and value <= 1.0
        ):
            node["restitution_coefficient"] = value
        elif tag == "threshold" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["threshold"] = value
        else:
            reading.child("surface/bounce", child, node, place, "bounce")
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("surface/bounce", element, child, node, "bounce")


def fill_surface_friction(element: XmlElement, node: Data, reading: Reading) -> None:
    """`surface/friction`, which fills the Surface around it."""
    for name, text in element.items():
        reading.attribute("surface/friction", element, name, text, node, "friction")
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("surface/friction", element, node, "friction")
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "ode" and place == 1 and len(child):
            fill_surface_friction_ode(child, node, reading)
        else:
            reading.child("surface/friction", child, node, place, "friction")
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("surface/friction", element, child, node, "friction")


def fill_surface_contact(element: XmlElement, node: Data, reading: Reading) -> None:
    """`surface/contact`, which fills the Surface around it."""
    for name, text in element.items():
        reading.attribute("surface/contact", element, name, text, node, "contact")
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("surface/contact", element, node, "contact")
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "ode" and place == 1 and len(child):
            fill_surface_contact_ode(child, node, reading)
        else:
            reading.child("surface/contact", child, node, place, "contact")
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("surface/contact", element, child, node, "contact")


def read_material_script(
    element: XmlElement, above: Source | None, step: str, key: str | int | None, reading: Reading
) -> Data:
    """The values of a Script, from `material/script`."""
    source = locate(Source, (reading.file, element.sourceline or 0, above, step, key))
    node: Data = {"source": source}
    for name, text in element.items():
        reading.attribute("material/script", element, name, text, node)
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("material/script", element, node)
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if (
            tag == "uri"
            and reading.version <= (1, 2)
            and place == 1
            and (value := stripped(text_of(child))) is not None
        ):
            node.setdefault("uris", []).append(value)
        elif tag == "uri" and reading.version >= (1, 3) and (value := stripped(text_of(child))) is not None:
            node.setdefault("uris", []).append(value)
        elif tag == "name" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["name"] = value
        else:
            reading.child("material/script", child, node, place)
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("material/script", element, child, node)
    if "uri" not in counts or "name" not in counts:
        reading.missing_children("material/script", element, counts)
    if "uris" in node:
        node["uris"] = tuple(node["uris"])
    if "opaque" in node:
        node["opaque"] = tuple(node["opaque"])
    return node


def fill_material_pbr(element: XmlElement, node: Data, reading: Reading) -> None:
    """`material/pbr`, which fills the Material around it."""
    for name, text in element.items():
        reading.attribute("material/pbr", element, name, text, node, "pbr")
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("material/pbr", element, node, "pbr")
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "metal" and place == 1 and len(child):
            fill_material_pbr_metal(child, node, reading)
        else:
            reading.child("material/pbr", child, node, place, "pbr")
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("material/pbr", element, child, node, "pbr")


def fill_surface_friction_ode(element: XmlElement, node: Data, reading: Reading) -> None:
    """`surface/friction/ode`, which fills the Surface around it."""
    for name, text in element.items():
        reading.attribute("surface/friction/ode", element, name, text, node, "friction/ode")
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("surface/friction/ode", element, node, "friction/ode")
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "mu" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["mu"] = value
        elif tag == "mu2" and place == 1 and (value := loose_double(text_of(child))) is not None and value >= 0.0:
            node["mu2"] = value
        elif tag == "fdir1" and place == 1 and (value := vector3(text_of(child))) is not None:
            node["fdir1"] = value
        elif (
            tag == "slip1"
            and reading.version <= (1, 3)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
            and value >= 0.0
            and value <= 1.0
        ):
            node["slip1"] = value
        elif (
            tag == "slip1"
            and reading.version >= (1, 4)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["slip1"] = value
        elif (
            tag == "slip2"
            and reading.version <= (1, 3)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
            and value >= 0.0
            and value <= 1.0
        ):
            node["slip2"] = value
        elif (
            tag == "slip2"
            and reading.version >= (1, 4)
            and place == 1
            and (value := loose_double(text_of(child))) is not None
        ):
            node["slip2"] = value
        else:
            reading.child("surface/friction/ode", child, node, place, "friction/ode")
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("surface/friction/ode", element, child, node, "friction/ode")


def fill_surface_contact_ode(element: XmlElement, node: Data, reading: Reading) -> None:
    """`surface/contact/ode`, which fills the Surface around it."""
    for name, text in element.items():
        reading.attribute("surface/contact/ode", element, name, text, node, "contact/ode")
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("surface/contact/ode", element, node, "contact/ode")
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "kp" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["kp"] = value
        elif tag == "kd" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["kd"] = value
        elif tag == "max_vel" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["max_vel"] = value
        elif tag == "min_depth" and place == 1 and (value := loose_double(text_of(child))) is not None:
            node["min_depth"] = value
        else:
            reading.child("surface/contact/ode", child, node, place, "contact/ode")
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("surface/contact/ode", element, child, node, "contact/ode")


def fill_material_pbr_metal(element: XmlElement, node: Data, reading: Reading) -> None:
    """`material/pbr/metal`, which fills the Material around it."""
    for name, text in element.items():
        reading.attribute("material/pbr/metal", element, name, text, node, "pbr/metal")
    if reading.is_unsure and (text := element.text) and not (text.isspace() and text.isascii()):
        reading.text("material/pbr/metal", element, node, "pbr/metal")
    text_of = reading.text_of
    counts: dict[Any, int] = {}
    for child in element:
        tag = child.tag
        place = counts[tag] = counts.get(tag, 0) + 1
        if tag == "albedo_map" and place == 1 and (value := stripped(text_of(child))) is not None:
            node["albedo_map"] = value
        else:
            reading.child("material/pbr/metal", child, node, place, "pbr/metal")
        if reading.is_unsure and (text := child.tail) and not (text.isspace() and text.isascii()):
            reading.tail("material/pbr/metal", element, child, node, "pbr/metal")
