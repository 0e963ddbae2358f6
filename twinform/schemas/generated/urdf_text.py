"""From nodes to the text of URDF: generated from the facts tables by `make generate`, not to be edited."""

from typing import Any

from twinform.schemas.text_output import (
    TextOutput,
    Write,
    in_attribute,
    vector3,
)
from twinform.schemas.value_types import (
    format_number,
    format_numbers,
)


def write_origin(node: Any, out: TextOutput, indent: str) -> str:
    """`<origin>`."""
    attributes = ""
    if (value := node.xyz) is not None:
        attributes += f' xyz="{vector3(value)}"'
    if (value := node.rpy) is not None:
        attributes += f' rpy="{vector3(value)}"'
    if (value := node.quat_xyzw) is not None:
        attributes += f' quat_xyzw="{format_numbers(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "origin", indent, attributes=attributes)
    return f"{indent}<origin{attributes}/>" if attributes else ""


def write_link_inertial_inertia(node: Any, out: TextOutput, indent: str) -> str:
    """`<inertia>`."""
    attributes = ""
    if (value := node.ixx) is not None:
        attributes += f' ixx="{format_number(value)}"'
    if (value := node.ixy) is not None:
        attributes += f' ixy="{format_number(value)}"'
    if (value := node.ixz) is not None:
        attributes += f' ixz="{format_number(value)}"'
    if (value := node.iyy) is not None:
        attributes += f' iyy="{format_number(value)}"'
    if (value := node.iyz) is not None:
        attributes += f' iyz="{format_number(value)}"'
    if (value := node.izz) is not None:
        attributes += f' izz="{format_number(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "inertia", indent, attributes=attributes)
    return f"{indent}<inertia{attributes}/>" if attributes else ""


def write_link_inertial(node: Any, out: TextOutput, indent: str) -> str:
    """`<inertial>`."""
    inner = indent + "  "
    body = ""
    if (value := node.pose) is not None:
        body += write_origin(value, out, inner)
    if (value := node.mass) is not None:
        body += f'{inner}<mass value="{format_number(value)}"/>'
    if (value := node.inertia) is not None:
        body += write_link_inertial_inertia(value, out, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "inertial", indent, body=body)
    return f"{indent}<inertial>{body}{indent}</inertial>" if body else ""


def write_geometry_box(node: Any, out: TextOutput, indent: str) -> str:
    """`<box>`."""
    attributes = ""
    if (value := node.size) is not None:
        attributes += f' size="{vector3(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "box", indent, attributes=attributes, keep=True)
    return f"{indent}<box{attributes}/>"


def write_geometry_cylinder(node: Any, out: TextOutput, indent: str) -> str:
    """`<cylinder>`."""
    attributes = ""
    if (value := node.radius) is not None:
        attributes += f' radius="{format_number(value)}"'
    if (value := node.length) is not None:
        attributes += f' length="{format_number(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "cylinder", indent, attributes=attributes, keep=True)
    return f"{indent}<cylinder{attributes}/>"


def write_geometry_sphere(node: Any, out: TextOutput, indent: str) -> str:
    """`<sphere>`."""
    attributes = ""
    if (value := node.radius) is not None:
        attributes += f' radius="{format_number(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "sphere", indent, attributes=attributes, keep=True)
    return f"{indent}<sphere{attributes}/>"


def write_geometry_capsule(node: Any, out: TextOutput, indent: str) -> str:
    """`<capsule>`."""
    attributes = ""
    if (value := node.radius) is not None:
        attributes += f' radius="{format_number(value)}"'
    if (value := node.length) is not None:
        attributes += f' length="{format_number(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "capsule", indent, attributes=attributes, keep=True)
    return f"{indent}<capsule{attributes}/>"


def write_geometry_mesh(node: Any, out: TextOutput, indent: str) -> str:
    """`<mesh>`."""
    attributes = ""
    if (value := node.uri) is not None:
        attributes += f' filename="{in_attribute(value)}"'
    if (value := node.scale) is not None:
        attributes += f' scale="{vector3(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "mesh", indent, attributes=attributes, keep=True)
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
    inner = indent + "  "
    body = ""
    if (value := node.shape) is not None and (write := GEOMETRY_SHAPES.get(value.kind)) is not None:
        body += write(value, out, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "geometry", indent, body=body)
    return f"{indent}<geometry>{body}{indent}</geometry>" if body else ""


def write_material(node: Any, out: TextOutput, indent: str) -> str:
    """`<material>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.color) is not None:
        body += f'{inner}<color rgba="{format_numbers(value)}"/>'
    if (value := node.texture) is not None:
        body += f'{inner}<texture filename="{in_attribute(value)}"/>'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "material", indent, attributes=attributes, body=body)
    if body:
        return f"{indent}<material{attributes}>{body}{indent}</material>"
    return f"{indent}<material{attributes}/>" if attributes else ""


def write_link_visual(node: Any, out: TextOutput, indent: str) -> str:
    """`<visual>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_origin(value, out, inner)
    if (value := node.geometry) is not None:
        body += write_geometry(value, out, inner)
    if (value := node.material) is not None:
        body += write_material(value, out, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "visual", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<visual{attributes}>{body}{indent}</visual>"
    return f"{indent}<visual{attributes}/>"


def write_link_collision(node: Any, out: TextOutput, indent: str) -> str:
    """`<collision>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_origin(value, out, inner)
    if (value := node.geometry) is not None:
        body += write_geometry(value, out, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "collision", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<collision{attributes}>{body}{indent}</collision>"
    return f"{indent}<collision{attributes}/>"


def write_link(node: Any, out: TextOutput, indent: str) -> str:
    """`<link>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.inertial) is not None:
        body += write_link_inertial(value, out, inner)
    body += out.children(
        node,
        inner,
        (node.visuals, write_link_visual),
        (node.collisions, write_link_collision),
    )
    if node.opaque or out.parts is not None:
        return out.unusual(node, "link", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<link{attributes}>{body}{indent}</link>"
    return f"{indent}<link{attributes}/>"


def write_joint_limit(node: Any, out: TextOutput, indent: str) -> str:
    """`<limit>`."""
    attributes = ""
    if (value := node.lower) is not None:
        attributes += f' lower="{format_number(value)}"'
    if (value := node.upper) is not None:
        attributes += f' upper="{format_number(value)}"'
    if (value := node.effort) is not None:
        attributes += f' effort="{format_number(value)}"'
    if (value := node.velocity) is not None:
        attributes += f' velocity="{format_number(value)}"'
    if (value := node.acceleration) is not None:
        attributes += f' acceleration="{format_number(value)}"'
    if (value := node.deceleration) is not None:
        attributes += f' deceleration="{format_number(value)}"'
    if (value := node.jerk) is not None:
        attributes += f' jerk="{format_number(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "limit", indent, attributes=attributes)
    return f"{indent}<limit{attributes}/>" if attributes else ""


def write_joint_dynamics(node: Any, out: TextOutput, indent: str) -> str:
    """`<dynamics>`."""
    attributes = ""
    if (value := node.damping) is not None:
        attributes += f' damping="{format_number(value)}"'
    if (value := node.friction) is not None:
        attributes += f' friction="{format_number(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "dynamics", indent, attributes=attributes)
    return f"{indent}<dynamics{attributes}/>" if attributes else ""


def write_joint_mimic(node: Any, out: TextOutput, indent: str) -> str:
    """`<mimic>`."""
    attributes = ""
    if (value := node.joint) is not None:
        attributes += f' joint="{in_attribute(value)}"'
    if (value := node.multiplier) is not None:
        attributes += f' multiplier="{format_number(value)}"'
    if (value := node.offset) is not None:
        attributes += f' offset="{format_number(value)}"'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "mimic", indent, attributes=attributes)
    return f"{indent}<mimic{attributes}/>" if attributes else ""


def write_joint(node: Any, out: TextOutput, indent: str) -> str:
    """`<joint>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.type) is not None:
        attributes += f' type="{in_attribute(value)}"'
    if (value := node.parent) is not None:
        body += f'{inner}<parent link="{in_attribute(value)}"/>'
    if (value := node.child) is not None:
        body += f'{inner}<child link="{in_attribute(value)}"/>'
    if (value := node.pose) is not None:
        body += write_origin(value, out, inner)
    if (holder := node.axis) is not None and (value := holder.xyz) is not None:
        body += f'{inner}<axis xyz="{vector3(value)}"/>'
    if (holder := node.axis) is not None and (value := holder.limit) is not None:
        body += write_joint_limit(value, out, inner)
    if (holder := node.axis) is not None and (value := holder.dynamics) is not None:
        body += write_joint_dynamics(value, out, inner)
    if (holder := node.axis) is not None and (value := holder.mimic) is not None:
        body += write_joint_mimic(value, out, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "joint", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<joint{attributes}>{body}{indent}</joint>"
    return f"{indent}<joint{attributes}/>"


def write_robot_material(node: Any, out: TextOutput, indent: str) -> str:
    """`<material>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.color) is not None:
        body += f'{inner}<color rgba="{format_numbers(value)}"/>'
    if (value := node.texture) is not None:
        body += f'{inner}<texture filename="{in_attribute(value)}"/>'
    if node.opaque or out.parts is not None:
        return out.unusual(node, "material", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<material{attributes}>{body}{indent}</material>"
    return f"{indent}<material{attributes}/>"


def write_gazebo(node: Any, out: TextOutput, indent: str) -> str:
    """`<gazebo>`."""
    attributes = ""
    if (value := node.reference) is not None:
        attributes += f' reference="{in_attribute(value)}"'
    if node.content or node.opaque or out.parts is not None:
        return out.unusual(node, "gazebo", indent, attributes=attributes, content=node.content, keep=True)
    return f"{indent}<gazebo{attributes}/>"


def write_robot(node: Any, out: TextOutput, indent: str) -> str:
    """`<robot>`."""
    inner = indent + "  "
    attributes = body = ""
    attributes += out.declarations
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    body += out.children(
        node,
        inner,
        (node.links, write_link),
        (node.joints, write_joint),
        (node.materials, write_robot_material),
        (node.extensions, write_gazebo),
    )
    if node.opaque or out.parts is not None:
        return out.unusual(node, "robot", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<robot{attributes}>{body}{indent}</robot>"
    return f"{indent}<robot{attributes}/>"


write_root: Write = write_robot

WRITERS: dict[str, Write] = {
    "robot": write_robot,
    "link": write_link,
    "origin": write_origin,
    "geometry": write_geometry,
    "material": write_robot_material,
    "joint": write_joint,
    "gazebo": write_gazebo,
}
