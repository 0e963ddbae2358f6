"""From nodes to the text of URDF: generated from the facts tables by `make generate`, not to be edited."""

from typing import Any

from twinform.schemas.text_output import (
    TextOutput,
    Write,
    in_attribute,
    vector3,
)
from twinform.schemas.values import (
    format_number,
    format_numbers,
)


def write_origin(node: Any, out: TextOutput, indent: str) -> str:
    """`<origin>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["xyz"]) is not None:
        attributes += f' xyz="{vector3(value)}"'
    if (value := values["rpy"]) is not None:
        attributes += f' rpy="{vector3(value)}"'
    if (value := values["quat_xyzw"]) is not None:
        attributes += f' quat_xyzw="{format_numbers(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "origin", indent, attributes=attributes)
    return f"{indent}<origin{attributes}/>" if attributes else ""


def write_link_inertial_inertia(node: Any, out: TextOutput, indent: str) -> str:
    """`<inertia>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["ixx"]) is not None:
        attributes += f' ixx="{format_number(value)}"'
    if (value := values["ixy"]) is not None:
        attributes += f' ixy="{format_number(value)}"'
    if (value := values["ixz"]) is not None:
        attributes += f' ixz="{format_number(value)}"'
    if (value := values["iyy"]) is not None:
        attributes += f' iyy="{format_number(value)}"'
    if (value := values["iyz"]) is not None:
        attributes += f' iyz="{format_number(value)}"'
    if (value := values["izz"]) is not None:
        attributes += f' izz="{format_number(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "link/inertial/inertia", indent, attributes=attributes)
    return f"{indent}<inertia{attributes}/>" if attributes else ""


def write_link_inertial(node: Any, out: TextOutput, indent: str) -> str:
    """`<inertial>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["pose"]) is not None:
        body += write_origin(value, out, inner)
    if (value := values["mass"]) is not None:
        body += f'{inner}<mass value="{format_number(value)}"/>'
    if (value := values["inertia"]) is not None:
        body += write_link_inertial_inertia(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "link/inertial", indent, body=body)
    return f"{indent}<inertial>{body}{indent}</inertial>" if body else ""


def write_geometry_box(node: Any, out: TextOutput, indent: str) -> str:
    """`<box>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["size"]) is not None:
        attributes += f' size="{vector3(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "geometry/box", indent, attributes=attributes, keep=True)
    return f"{indent}<box{attributes}/>"


def write_geometry_cylinder(node: Any, out: TextOutput, indent: str) -> str:
    """`<cylinder>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["radius"]) is not None:
        attributes += f' radius="{format_number(value)}"'
    if (value := values["length"]) is not None:
        attributes += f' length="{format_number(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "geometry/cylinder", indent, attributes=attributes, keep=True)
    return f"{indent}<cylinder{attributes}/>"


def write_geometry_sphere(node: Any, out: TextOutput, indent: str) -> str:
    """`<sphere>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["radius"]) is not None:
        attributes += f' radius="{format_number(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "geometry/sphere", indent, attributes=attributes, keep=True)
    return f"{indent}<sphere{attributes}/>"


def write_geometry_capsule(node: Any, out: TextOutput, indent: str) -> str:
    """`<capsule>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["radius"]) is not None:
        attributes += f' radius="{format_number(value)}"'
    if (value := values["length"]) is not None:
        attributes += f' length="{format_number(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "geometry/capsule", indent, attributes=attributes, keep=True)
    return f"{indent}<capsule{attributes}/>"


def write_geometry_mesh(node: Any, out: TextOutput, indent: str) -> str:
    """`<mesh>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["uri"]) is not None:
        attributes += f' filename="{in_attribute(value)}"'
    if (value := values["scale"]) is not None:
        attributes += f' scale="{vector3(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "geometry/mesh", indent, attributes=attributes, keep=True)
    return f"{indent}<mesh{attributes}/>"


GEOMETRY_SHAPES: dict[str, Write] = {
    "box": write_geometry_box,
    "cylinder": write_geometry_cylinder,
    "sphere": write_geometry_sphere,
    "capsule": write_geometry_capsule,
    "mesh": write_geometry_mesh,
}


def write_geometry(node: Any, out: TextOutput, indent: str) -> str:
    """`<geometry>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["shape"]) is not None and (write := GEOMETRY_SHAPES.get(value.kind)) is not None:
        body += write(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "geometry", indent, body=body)
    return f"{indent}<geometry>{body}{indent}</geometry>" if body else ""


def write_material(node: Any, out: TextOutput, indent: str) -> str:
    """`<material>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["color"]) is not None:
        body += f'{inner}<color rgba="{format_numbers(value)}"/>'
    if (value := values["texture"]) is not None:
        body += f'{inner}<texture filename="{in_attribute(value)}"/>'
    if values["opaque"]:
        return out.with_untyped(node, "material", indent, attributes=attributes, body=body)
    if body:
        return f"{indent}<material{attributes}>{body}{indent}</material>"
    return f"{indent}<material{attributes}/>" if attributes else ""


def write_link_visual(node: Any, out: TextOutput, indent: str) -> str:
    """`<visual>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_origin(value, out, inner)
    if (value := values["geometry"]) is not None:
        body += write_geometry(value, out, inner)
    if (value := values["material"]) is not None:
        body += write_material(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "link/visual", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<visual{attributes}>{body}{indent}</visual>"
    return f"{indent}<visual{attributes}/>"


def write_link_collision(node: Any, out: TextOutput, indent: str) -> str:
    """`<collision>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_origin(value, out, inner)
    if (value := values["geometry"]) is not None:
        body += write_geometry(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "link/collision", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<collision{attributes}>{body}{indent}</collision>"
    return f"{indent}<collision{attributes}/>"


def write_link(node: Any, out: TextOutput, indent: str) -> str:
    """`<link>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["inertial"]) is not None:
        body += write_link_inertial(value, out, inner)
    body += out.parts(
        node,
        inner,
        (values["visuals"], write_link_visual),
        (values["collisions"], write_link_collision),
    )
    if values["opaque"]:
        return out.with_untyped(node, "link", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<link{attributes}>{body}{indent}</link>"
    return f"{indent}<link{attributes}/>"


def write_joint_limit(node: Any, out: TextOutput, indent: str) -> str:
    """`<limit>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["lower"]) is not None:
        attributes += f' lower="{format_number(value)}"'
    if (value := values["upper"]) is not None:
        attributes += f' upper="{format_number(value)}"'
    if (value := values["effort"]) is not None:
        attributes += f' effort="{format_number(value)}"'
    if (value := values["velocity"]) is not None:
        attributes += f' velocity="{format_number(value)}"'
    if (value := values["acceleration"]) is not None:
        attributes += f' acceleration="{format_number(value)}"'
    if (value := values["deceleration"]) is not None:
        attributes += f' deceleration="{format_number(value)}"'
    if (value := values["jerk"]) is not None:
        attributes += f' jerk="{format_number(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "joint/limit", indent, attributes=attributes)
    return f"{indent}<limit{attributes}/>" if attributes else ""


def write_joint_dynamics(node: Any, out: TextOutput, indent: str) -> str:
    """`<dynamics>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["damping"]) is not None:
        attributes += f' damping="{format_number(value)}"'
    if (value := values["friction"]) is not None:
        attributes += f' friction="{format_number(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "joint/dynamics", indent, attributes=attributes)
    return f"{indent}<dynamics{attributes}/>" if attributes else ""


def write_joint_mimic(node: Any, out: TextOutput, indent: str) -> str:
    """`<mimic>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["joint"]) is not None:
        attributes += f' joint="{in_attribute(value)}"'
    if (value := values["multiplier"]) is not None:
        attributes += f' multiplier="{format_number(value)}"'
    if (value := values["offset"]) is not None:
        attributes += f' offset="{format_number(value)}"'
    if values["opaque"]:
        return out.with_untyped(node, "joint/mimic", indent, attributes=attributes)
    return f"{indent}<mimic{attributes}/>" if attributes else ""


def write_joint(node: Any, out: TextOutput, indent: str) -> str:
    """`<joint>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["type"]) is not None:
        attributes += f' type="{in_attribute(value)}"'
    if (value := values["parent"]) is not None:
        body += f'{inner}<parent link="{in_attribute(value)}"/>'
    if (value := values["child"]) is not None:
        body += f'{inner}<child link="{in_attribute(value)}"/>'
    if (value := values["pose"]) is not None:
        body += write_origin(value, out, inner)
    if (holder := values["axis"]) is not None and (value := holder.__dict__["xyz"]) is not None:
        body += f'{inner}<axis xyz="{vector3(value)}"/>'
    if (holder := values["axis"]) is not None and (value := holder.__dict__["limit"]) is not None:
        body += write_joint_limit(value, out, inner)
    if (holder := values["axis"]) is not None and (value := holder.__dict__["dynamics"]) is not None:
        body += write_joint_dynamics(value, out, inner)
    if (holder := values["axis"]) is not None and (value := holder.__dict__["mimic"]) is not None:
        body += write_joint_mimic(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "joint", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<joint{attributes}>{body}{indent}</joint>"
    return f"{indent}<joint{attributes}/>"


def write_robot_material(node: Any, out: TextOutput, indent: str) -> str:
    """`<material>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["color"]) is not None:
        body += f'{inner}<color rgba="{format_numbers(value)}"/>'
    if (value := values["texture"]) is not None:
        body += f'{inner}<texture filename="{in_attribute(value)}"/>'
    if values["opaque"]:
        return out.with_untyped(node, "material", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<material{attributes}>{body}{indent}</material>"
    return f"{indent}<material{attributes}/>"


def write_gazebo(node: Any, out: TextOutput, indent: str) -> str:
    """`<gazebo>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["reference"]) is not None:
        attributes += f' reference="{in_attribute(value)}"'
    if values["content"] or values["opaque"]:
        return out.with_untyped(node, "gazebo", indent, attributes=attributes, content=values["content"], keep=True)
    return f"{indent}<gazebo{attributes}/>"


def write_robot(node: Any, out: TextOutput, indent: str) -> str:
    """`<robot>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    attributes += out.declarations
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    body += out.parts(
        node,
        inner,
        (values["links"], write_link),
        (values["joints"], write_joint),
        (values["materials"], write_robot_material),
        (values["extensions"], write_gazebo),
    )
    attributes += out.root_attributes
    if values["opaque"]:
        return out.with_untyped(node, "robot", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<robot{attributes}>{body}{indent}</robot>"
    return f"{indent}<robot{attributes}/>"


write_root: Write = write_robot
