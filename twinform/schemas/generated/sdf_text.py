"""From nodes to the text of SDF: generated from the facts tables by `make generate`, not to be edited."""

from typing import Any

from twinform.schemas.text_output import (
    TextOutput,
    Write,
    bool_attribute,
    bool_text,
    in_attribute,
    in_text,
    pose_numbers,
    vector3,
)
from twinform.schemas.value_types import (
    format_number,
    format_numbers,
    format_value,
)


def write_pose(node: Any, out: TextOutput, indent: str) -> str:
    """`<pose>`."""
    attributes = ""
    if (value := node.relative_to) is not None:
        attributes += f' relative_to="{in_attribute(value)}"'
    if (value := node.rotation_format) is not None:
        attributes += f' rotation_format="{in_attribute(value)}"'
    if (value := node.degrees) is not None:
        attributes += f' degrees="{bool_attribute(node, "degrees")}"'
    body = pose_numbers(node)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "pose", indent, attributes=attributes, body=body)
    if body is None:
        return f"{indent}<pose{attributes}/>" if attributes else ""
    return f"{indent}<pose{attributes}>{body}</pose>"


def write_plugin(node: Any, out: TextOutput, indent: str) -> str:
    """`<plugin>`."""
    attributes = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.filename) is not None:
        attributes += f' filename="{in_attribute(value)}"'
    if node.content or node.opaque or out.parts is not None:
        return out.unusual(node, "plugin", indent, attributes=attributes, content=node.content, keep=True)
    return f"{indent}<plugin{attributes}/>"


def write_include(node: Any, out: TextOutput, indent: str) -> str:
    """`<include>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.merge) is not None:
        attributes += f' merge="{bool_attribute(node, "merge")}"'
    if (value := node.uri) is not None:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if (value := node.name) is not None:
        body += f"{inner}<name>{in_text(value)}</name>"
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if (value := node.static) is not None:
        body += f"{inner}<static>{bool_text(node, 'static')}</static>"
    if (value := node.placement_frame) is not None:
        body += f"{inner}<placement_frame>{in_text(value)}</placement_frame>"
    if node.plugins:
        body += out.children(node, inner, (node.plugins, write_plugin))
    if node.opaque or out.parts is not None:
        return out.unusual(node, "include", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<include{attributes}>{body}{indent}</include>"
    return f"{indent}<include{attributes}/>"


def write_light(node: Any, out: TextOutput, indent: str) -> str:
    """`<light>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.type) is not None:
        attributes += f' type="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if (value := node.cast_shadows) is not None:
        body += f"{inner}<cast_shadows>{bool_text(node, 'cast_shadows')}</cast_shadows>"
    if (value := node.intensity) is not None:
        body += f"{inner}<intensity>{format_number(value)}</intensity>"
    if (value := node.diffuse) is not None:
        body += f"{inner}<diffuse>{format_numbers(value)}</diffuse>"
    if (value := node.specular) is not None:
        body += f"{inner}<specular>{format_numbers(value)}</specular>"
    if (value := node.direction) is not None:
        body += f"{inner}<direction>{vector3(value)}</direction>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "light", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<light{attributes}>{body}{indent}</light>"
    return f"{indent}<light{attributes}/>"


def write_frame(node: Any, out: TextOutput, indent: str) -> str:
    """`<frame>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.attached_to) is not None:
        attributes += f' attached_to="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "frame", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<frame{attributes}>{body}{indent}</frame>"
    return f"{indent}<frame{attributes}/>"


def write_joint_axis_xyz(node: Any, indent: str) -> str:
    """`<xyz>`, of fields of the node around it."""
    attributes = ""
    if (value := node.expressed_in) is not None:
        attributes += f' expressed_in="{in_attribute(value)}"'
    if (value := node.xyz) is None:
        return f"{indent}<xyz{attributes}/>" if attributes else ""
    return f"{indent}<xyz{attributes}>{vector3(value)}</xyz>"


def write_joint_axis_dynamics(node: Any, out: TextOutput, indent: str) -> str:
    """`<dynamics>`."""
    inner = indent + "  "
    body = ""
    if (value := node.damping) is not None:
        body += f"{inner}<damping>{format_number(value)}</damping>"
    if (value := node.friction) is not None:
        body += f"{inner}<friction>{format_number(value)}</friction>"
    if (value := node.spring_reference) is not None:
        body += f"{inner}<spring_reference>{format_number(value)}</spring_reference>"
    if (value := node.spring_stiffness) is not None:
        body += f"{inner}<spring_stiffness>{format_number(value)}</spring_stiffness>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "dynamics", indent, body=body)
    return f"{indent}<dynamics>{body}{indent}</dynamics>" if body else ""


def write_joint_axis_limit(node: Any, out: TextOutput, indent: str) -> str:
    """`<limit>`."""
    inner = indent + "  "
    body = ""
    if (value := node.lower) is not None:
        body += f"{inner}<lower>{format_number(value)}</lower>"
    if (value := node.upper) is not None:
        body += f"{inner}<upper>{format_number(value)}</upper>"
    if (value := node.effort) is not None:
        body += f"{inner}<effort>{format_number(value)}</effort>"
    if (value := node.velocity) is not None:
        body += f"{inner}<velocity>{format_number(value)}</velocity>"
    if (value := node.stiffness) is not None:
        body += f"{inner}<stiffness>{format_number(value)}</stiffness>"
    if (value := node.dissipation) is not None:
        body += f"{inner}<dissipation>{format_number(value)}</dissipation>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "limit", indent, body=body)
    return f"{indent}<limit>{body}{indent}</limit>" if body else ""


def write_mimic(node: Any, out: TextOutput, indent: str) -> str:
    """`<mimic>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.joint) is not None:
        attributes += f' joint="{in_attribute(value)}"'
    if (value := node.axis) is not None:
        attributes += f' axis="{in_attribute(value)}"'
    if (value := node.multiplier) is not None:
        body += f"{inner}<multiplier>{format_number(value)}</multiplier>"
    if (value := node.offset) is not None:
        body += f"{inner}<offset>{format_number(value)}</offset>"
    if (value := node.reference) is not None:
        body += f"{inner}<reference>{format_number(value)}</reference>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "mimic", indent, attributes=attributes, body=body)
    if body:
        return f"{indent}<mimic{attributes}>{body}{indent}</mimic>"
    return f"{indent}<mimic{attributes}/>" if attributes else ""


def write_joint_axis(node: Any, out: TextOutput, indent: str) -> str:
    """`<axis>`."""
    inner = indent + "  "
    body = ""
    body += write_joint_axis_xyz(node, inner)
    if (value := node.dynamics) is not None:
        body += write_joint_axis_dynamics(value, out, inner)
    if (value := node.limit) is not None:
        body += write_joint_axis_limit(value, out, inner)
    if (value := node.mimic) is not None:
        body += write_mimic(value, out, inner)
    if (value := node.use_parent_model_frame) is not None:
        body += f"{inner}<use_parent_model_frame>{bool_text(node, 'use_parent_model_frame')}</use_parent_model_frame>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "axis", indent, body=body)
    return f"{indent}<axis>{body}{indent}</axis>" if body else ""


def write_joint_axis2(node: Any, out: TextOutput, indent: str) -> str:
    """`<axis2>`."""
    inner = indent + "  "
    body = ""
    body += write_joint_axis_xyz(node, inner)
    if (value := node.dynamics) is not None:
        body += write_joint_axis_dynamics(value, out, inner)
    if (value := node.limit) is not None:
        body += write_joint_axis_limit(value, out, inner)
    if (value := node.mimic) is not None:
        body += write_mimic(value, out, inner)
    if (value := node.use_parent_model_frame) is not None:
        body += f"{inner}<use_parent_model_frame>{bool_text(node, 'use_parent_model_frame')}</use_parent_model_frame>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "axis2", indent, body=body)
    return f"{indent}<axis2>{body}{indent}</axis2>" if body else ""


def write_sensor(node: Any, out: TextOutput, indent: str) -> str:
    """`<sensor>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.type) is not None:
        attributes += f' type="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if (value := node.always_on) is not None:
        body += f"{inner}<always_on>{bool_text(node, 'always_on')}</always_on>"
    if (value := node.update_rate) is not None:
        body += f"{inner}<update_rate>{format_number(value)}</update_rate>"
    if (value := node.visualize) is not None:
        body += f"{inner}<visualize>{bool_text(node, 'visualize')}</visualize>"
    if (value := node.topic) is not None:
        body += f"{inner}<topic>{in_text(value)}</topic>"
    if (value := node.enable_metrics) is not None:
        body += f"{inner}<enable_metrics>{bool_text(node, 'enable_metrics')}</enable_metrics>"
    if (value := node.frame_id) is not None:
        body += f"{inner}<frame_id>{in_text(value)}</frame_id>"
    if node.plugins:
        body += out.children(node, inner, (node.plugins, write_plugin))
    if node.opaque or out.parts is not None:
        return out.unusual(node, "sensor", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<sensor{attributes}>{body}{indent}</sensor>"
    return f"{indent}<sensor{attributes}/>"


def write_joint(node: Any, out: TextOutput, indent: str) -> str:
    """`<joint>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.type) is not None:
        attributes += f' type="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if (value := node.parent) is not None:
        body += f"{inner}<parent>{in_text(value)}</parent>"
    if (value := node.child) is not None:
        body += f"{inner}<child>{in_text(value)}</child>"
    if (value := node.gearbox_ratio) is not None:
        body += f"{inner}<gearbox_ratio>{format_number(value)}</gearbox_ratio>"
    if (value := node.gearbox_reference_body) is not None:
        body += f"{inner}<gearbox_reference_body>{in_text(value)}</gearbox_reference_body>"
    if (value := node.thread_pitch) is not None:
        body += f"{inner}<thread_pitch>{format_number(value)}</thread_pitch>"
    if (value := node.screw_thread_pitch) is not None:
        body += f"{inner}<screw_thread_pitch>{format_number(value)}</screw_thread_pitch>"
    if (value := node.axis) is not None:
        body += write_joint_axis(value, out, inner)
    if (value := node.axis2) is not None:
        body += write_joint_axis2(value, out, inner)
    if node.sensors:
        body += out.children(node, inner, (node.sensors, write_sensor))
    if node.opaque or out.parts is not None:
        return out.unusual(node, "joint", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<joint{attributes}>{body}{indent}</joint>"
    return f"{indent}<joint{attributes}/>"


def write_inertial_pose(node: Any, out: TextOutput, indent: str) -> str:
    """`<pose>`."""
    attributes = ""
    if (value := node.rotation_format) is not None:
        attributes += f' rotation_format="{in_attribute(value)}"'
    if (value := node.degrees) is not None:
        attributes += f' degrees="{bool_attribute(node, "degrees")}"'
    body = pose_numbers(node)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "pose", indent, attributes=attributes, body=body)
    if body is None:
        return f"{indent}<pose{attributes}/>" if attributes else ""
    return f"{indent}<pose{attributes}>{body}</pose>"


def write_inertial_inertia(node: Any, out: TextOutput, indent: str) -> str:
    """`<inertia>`."""
    inner = indent + "  "
    body = ""
    if (value := node.ixx) is not None:
        body += f"{inner}<ixx>{format_number(value)}</ixx>"
    if (value := node.ixy) is not None:
        body += f"{inner}<ixy>{format_number(value)}</ixy>"
    if (value := node.ixz) is not None:
        body += f"{inner}<ixz>{format_number(value)}</ixz>"
    if (value := node.iyy) is not None:
        body += f"{inner}<iyy>{format_number(value)}</iyy>"
    if (value := node.iyz) is not None:
        body += f"{inner}<iyz>{format_number(value)}</iyz>"
    if (value := node.izz) is not None:
        body += f"{inner}<izz>{format_number(value)}</izz>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "inertia", indent, body=body)
    return f"{indent}<inertia>{body}{indent}</inertia>" if body else ""


def write_inertial(node: Any, out: TextOutput, indent: str) -> str:
    """`<inertial>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.auto) is not None:
        attributes += f' auto="{bool_attribute(node, "auto")}"'
    if (value := node.pose) is not None:
        body += (write_inertial_pose if out.version >= (1, 8) else write_pose)(value, out, inner)
    if (value := node.mass) is not None:
        body += f"{inner}<mass>{format_number(value)}</mass>"
    if (value := node.inertia) is not None:
        body += write_inertial_inertia(value, out, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "inertial", indent, attributes=attributes, body=body)
    if body:
        return f"{indent}<inertial{attributes}>{body}{indent}</inertial>"
    return f"{indent}<inertial{attributes}/>" if attributes else ""


def write_geometry_empty(node: Any, out: TextOutput, indent: str) -> str:
    """`<empty>`."""
    if node.opaque or out.parts is not None:
        return out.unusual(node, "empty", indent, keep=True)
    return f"{indent}<empty/>"


def write_geometry_box(node: Any, out: TextOutput, indent: str) -> str:
    """`<box>`."""
    inner = indent + "  "
    body = ""
    if (value := node.size) is not None:
        body += f"{inner}<size>{vector3(value)}</size>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "box", indent, body=body, keep=True)
    return f"{indent}<box>{body}{indent}</box>" if body else f"{indent}<box/>"


def write_geometry_capsule(node: Any, out: TextOutput, indent: str) -> str:
    """`<capsule>`."""
    inner = indent + "  "
    body = ""
    if (value := node.radius) is not None:
        body += f"{inner}<radius>{format_number(value)}</radius>"
    if (value := node.length) is not None:
        body += f"{inner}<length>{format_number(value)}</length>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "capsule", indent, body=body, keep=True)
    return f"{indent}<capsule>{body}{indent}</capsule>" if body else f"{indent}<capsule/>"


def write_geometry_cone(node: Any, out: TextOutput, indent: str) -> str:
    """`<cone>`."""
    inner = indent + "  "
    body = ""
    if (value := node.radius) is not None:
        body += f"{inner}<radius>{format_number(value)}</radius>"
    if (value := node.length) is not None:
        body += f"{inner}<length>{format_number(value)}</length>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "cone", indent, body=body, keep=True)
    return f"{indent}<cone>{body}{indent}</cone>" if body else f"{indent}<cone/>"


def write_geometry_cylinder(node: Any, out: TextOutput, indent: str) -> str:
    """`<cylinder>`."""
    inner = indent + "  "
    body = ""
    if (value := node.radius) is not None:
        body += f"{inner}<radius>{format_number(value)}</radius>"
    if (value := node.length) is not None:
        body += f"{inner}<length>{format_number(value)}</length>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "cylinder", indent, body=body, keep=True)
    return f"{indent}<cylinder>{body}{indent}</cylinder>" if body else f"{indent}<cylinder/>"


def write_geometry_ellipsoid(node: Any, out: TextOutput, indent: str) -> str:
    """`<ellipsoid>`."""
    inner = indent + "  "
    body = ""
    if (value := node.radii) is not None:
        body += f"{inner}<radii>{vector3(value)}</radii>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "ellipsoid", indent, body=body, keep=True)
    return f"{indent}<ellipsoid>{body}{indent}</ellipsoid>" if body else f"{indent}<ellipsoid/>"


def write_geometry_heightmap(node: Any, out: TextOutput, indent: str) -> str:
    """`<heightmap>`."""
    inner = indent + "  "
    body = ""
    if (value := node.uri) is not None:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "heightmap", indent, body=body, keep=True)
    return f"{indent}<heightmap>{body}{indent}</heightmap>" if body else f"{indent}<heightmap/>"


def write_geometry_image(node: Any, out: TextOutput, indent: str) -> str:
    """`<image>`."""
    inner = indent + "  "
    body = ""
    if (value := node.uri) is not None:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "image", indent, body=body, keep=True)
    return f"{indent}<image>{body}{indent}</image>" if body else f"{indent}<image/>"


def write_geometry_mesh(node: Any, out: TextOutput, indent: str) -> str:
    """`<mesh>`."""
    inner = indent + "  "
    body = ""
    if (value := node.uri) is not None:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if (value := node.scale) is not None:
        body += f"{inner}<scale>{vector3(value)}</scale>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "mesh", indent, body=body, keep=True)
    return f"{indent}<mesh>{body}{indent}</mesh>" if body else f"{indent}<mesh/>"


def write_geometry_plane(node: Any, out: TextOutput, indent: str) -> str:
    """`<plane>`."""
    inner = indent + "  "
    body = ""
    if (value := node.normal) is not None:
        body += f"{inner}<normal>{vector3(value)}</normal>"
    if (value := node.size) is not None:
        body += f"{inner}<size>{format_numbers(value)}</size>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "plane", indent, body=body, keep=True)
    return f"{indent}<plane>{body}{indent}</plane>" if body else f"{indent}<plane/>"


def write_geometry_polyline(node: Any, out: TextOutput, indent: str) -> str:
    """`<polyline>`."""
    inner = indent + "  "
    body = ""
    if (value := node.height) is not None:
        body += f"{inner}<height>{format_number(value)}</height>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "polyline", indent, body=body, keep=True)
    return f"{indent}<polyline>{body}{indent}</polyline>" if body else f"{indent}<polyline/>"


def write_geometry_sphere(node: Any, out: TextOutput, indent: str) -> str:
    """`<sphere>`."""
    inner = indent + "  "
    body = ""
    if (value := node.radius) is not None:
        body += f"{inner}<radius>{format_number(value)}</radius>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "sphere", indent, body=body, keep=True)
    return f"{indent}<sphere>{body}{indent}</sphere>" if body else f"{indent}<sphere/>"


GEOMETRY_SHAPES: dict[str, Write] = {
    "empty": write_geometry_empty,
    "box": write_geometry_box,
    "capsule": write_geometry_capsule,
    "cone": write_geometry_cone,
    "cylinder": write_geometry_cylinder,
    "ellipsoid": write_geometry_ellipsoid,
    "heightmap": write_geometry_heightmap,
    "image": write_geometry_image,
    "mesh": write_geometry_mesh,
    "plane": write_geometry_plane,
    "polyline": write_geometry_polyline,
    "sphere": write_geometry_sphere,
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


def write_surface_bounce(node: Any, indent: str) -> str:
    """`<bounce>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    if (value := node.restitution_coefficient) is not None:
        body += f"{inner}<restitution_coefficient>{format_number(value)}</restitution_coefficient>"
    if (value := node.threshold) is not None:
        body += f"{inner}<threshold>{format_number(value)}</threshold>"
    return f"{indent}<bounce>{body}{indent}</bounce>" if body else ""


def write_surface_friction_ode(node: Any, indent: str) -> str:
    """`<ode>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    if (value := node.mu) is not None:
        body += f"{inner}<mu>{format_number(value)}</mu>"
    if (value := node.mu2) is not None:
        body += f"{inner}<mu2>{format_number(value)}</mu2>"
    if (value := node.fdir1) is not None:
        body += f"{inner}<fdir1>{vector3(value)}</fdir1>"
    if (value := node.slip1) is not None:
        body += f"{inner}<slip1>{format_number(value)}</slip1>"
    if (value := node.slip2) is not None:
        body += f"{inner}<slip2>{format_number(value)}</slip2>"
    return f"{indent}<ode>{body}{indent}</ode>" if body else ""


def write_surface_friction(node: Any, indent: str) -> str:
    """`<friction>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    body += write_surface_friction_ode(node, inner)
    return f"{indent}<friction>{body}{indent}</friction>" if body else ""


def write_surface_contact_ode(node: Any, indent: str) -> str:
    """`<ode>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    if (value := node.kp) is not None:
        body += f"{inner}<kp>{format_number(value)}</kp>"
    if (value := node.kd) is not None:
        body += f"{inner}<kd>{format_number(value)}</kd>"
    if (value := node.max_vel) is not None:
        body += f"{inner}<max_vel>{format_number(value)}</max_vel>"
    if (value := node.min_depth) is not None:
        body += f"{inner}<min_depth>{format_number(value)}</min_depth>"
    return f"{indent}<ode>{body}{indent}</ode>" if body else ""


def write_surface_contact(node: Any, indent: str) -> str:
    """`<contact>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    body += write_surface_contact_ode(node, inner)
    return f"{indent}<contact>{body}{indent}</contact>" if body else ""


def write_surface(node: Any, out: TextOutput, indent: str) -> str:
    """`<surface>`."""
    inner = indent + "  "
    body = ""
    body += write_surface_bounce(node, inner)
    body += write_surface_friction(node, inner)
    body += write_surface_contact(node, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "surface", indent, body=body)
    return f"{indent}<surface>{body}{indent}</surface>" if body else ""


def write_collision(node: Any, out: TextOutput, indent: str) -> str:
    """`<collision>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if (value := node.laser_retro) is not None:
        body += f"{inner}<laser_retro>{format_number(value)}</laser_retro>"
    if (value := node.max_contacts) is not None:
        body += f"{inner}<max_contacts>{format_value(value)}</max_contacts>"
    if (value := node.geometry) is not None:
        body += write_geometry(value, out, inner)
    if (value := node.surface) is not None:
        body += write_surface(value, out, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "collision", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<collision{attributes}>{body}{indent}</collision>"
    return f"{indent}<collision{attributes}/>"


def write_material_script(node: Any, out: TextOutput, indent: str) -> str:
    """`<script>`."""
    inner = indent + "  "
    body = ""
    for value in node.uris:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if (value := node.name) is not None:
        body += f"{inner}<name>{in_text(value)}</name>"
    if node.opaque or out.parts is not None:
        return out.unusual(node, "script", indent, body=body)
    return f"{indent}<script>{body}{indent}</script>" if body else ""


def write_material_pbr_metal(node: Any, indent: str) -> str:
    """`<metal>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    if (value := node.albedo_map) is not None:
        body += f"{inner}<albedo_map>{in_text(value)}</albedo_map>"
    return f"{indent}<metal>{body}{indent}</metal>" if body else ""


def write_material_pbr(node: Any, indent: str) -> str:
    """`<pbr>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    body += write_material_pbr_metal(node, inner)
    return f"{indent}<pbr>{body}{indent}</pbr>" if body else ""


def write_material(node: Any, out: TextOutput, indent: str) -> str:
    """`<material>`."""
    inner = indent + "  "
    body = ""
    if (value := node.script) is not None:
        body += write_material_script(value, out, inner)
    if (value := node.ambient) is not None:
        body += f"{inner}<ambient>{format_numbers(value)}</ambient>"
    if (value := node.diffuse) is not None:
        body += f"{inner}<diffuse>{format_numbers(value)}</diffuse>"
    if (value := node.specular) is not None:
        body += f"{inner}<specular>{format_numbers(value)}</specular>"
    if (value := node.emissive) is not None:
        body += f"{inner}<emissive>{format_numbers(value)}</emissive>"
    body += write_material_pbr(node, inner)
    if node.opaque or out.parts is not None:
        return out.unusual(node, "material", indent, body=body)
    return f"{indent}<material>{body}{indent}</material>" if body else ""


def write_visual(node: Any, out: TextOutput, indent: str) -> str:
    """`<visual>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if (value := node.geometry) is not None:
        body += write_geometry(value, out, inner)
    if (value := node.material) is not None:
        body += write_material(value, out, inner)
    if node.plugins:
        body += out.children(node, inner, (node.plugins, write_plugin))
    if node.opaque or out.parts is not None:
        return out.unusual(node, "visual", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<visual{attributes}>{body}{indent}</visual>"
    return f"{indent}<visual{attributes}/>"


def write_link(node: Any, out: TextOutput, indent: str) -> str:
    """`<link>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if (value := node.gravity) is not None:
        body += f"{inner}<gravity>{bool_text(node, 'gravity')}</gravity>"
    if (value := node.enable_wind) is not None:
        body += f"{inner}<enable_wind>{bool_text(node, 'enable_wind')}</enable_wind>"
    if (value := node.self_collide) is not None:
        body += f"{inner}<self_collide>{bool_text(node, 'self_collide')}</self_collide>"
    if (value := node.kinematic) is not None:
        body += f"{inner}<kinematic>{bool_text(node, 'kinematic')}</kinematic>"
    if (value := node.inertial) is not None:
        body += write_inertial(value, out, inner)
    body += out.children(
        node,
        inner,
        (node.collisions, write_collision),
        (node.visuals, write_visual),
        (node.sensors, write_sensor),
        (node.lights, write_light),
    )
    if node.opaque or out.parts is not None:
        return out.unusual(node, "link", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<link{attributes}>{body}{indent}</link>"
    return f"{indent}<link{attributes}/>"


def write_model(node: Any, out: TextOutput, indent: str) -> str:
    """`<model>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.canonical_link) is not None:
        attributes += f' canonical_link="{in_attribute(value)}"'
    if (value := node.placement_frame) is not None:
        attributes += f' placement_frame="{in_attribute(value)}"'
    if (value := node.pose) is not None:
        body += write_pose(value, out, inner)
    if (value := node.static) is not None:
        body += f"{inner}<static>{bool_text(node, 'static')}</static>"
    if (value := node.self_collide) is not None:
        body += f"{inner}<self_collide>{bool_text(node, 'self_collide')}</self_collide>"
    if (value := node.allow_auto_disable) is not None:
        body += f"{inner}<allow_auto_disable>{bool_text(node, 'allow_auto_disable')}</allow_auto_disable>"
    if (value := node.enable_wind) is not None:
        body += f"{inner}<enable_wind>{bool_text(node, 'enable_wind')}</enable_wind>"
    body += out.children(
        node,
        inner,
        (node.frames, write_frame),
        (node.links, write_link),
        (node.joints, write_joint),
        (node.plugins, write_plugin),
        (node.includes, write_include),
        (node.models, write_model),
    )
    if node.opaque or out.parts is not None:
        return out.unusual(node, "model", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<model{attributes}>{body}{indent}</model>"
    return f"{indent}<model{attributes}/>"


def write_world(node: Any, out: TextOutput, indent: str) -> str:
    """`<world>`."""
    inner = indent + "  "
    attributes = body = ""
    if (value := node.name) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := node.gravity) is not None:
        body += f"{inner}<gravity>{vector3(value)}</gravity>"
    body += out.children(
        node,
        inner,
        (node.includes, write_include),
        (node.lights, write_light),
        (node.frames, write_frame),
        (node.joints, write_joint),
        (node.models, write_model),
        (node.plugins, write_plugin),
    )
    if node.opaque or out.parts is not None:
        return out.unusual(node, "world", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<world{attributes}>{body}{indent}</world>"
    return f"{indent}<world{attributes}/>"


def write_sdf(node: Any, out: TextOutput, indent: str) -> str:
    """`<sdf>`."""
    inner = indent + "  "
    attributes = body = ""
    attributes += out.declarations
    if (value := node.version) is not None:
        attributes += f' version="{in_attribute(value)}"'
    body += out.children(
        node,
        inner,
        (node.worlds, write_world),
        (node.models, write_model),
        (node.lights, write_light),
        (node.includes, write_include),
    )
    if node.opaque or out.parts is not None:
        return out.unusual(node, "sdf", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<sdf{attributes}>{body}{indent}</sdf>"
    return f"{indent}<sdf{attributes}/>"


write_root: Write = write_sdf

WRITERS: dict[str, Write] = {
    "sdf": write_sdf,
    "world": write_world,
    "include": write_include,
    "pose": write_pose,
    "plugin": write_plugin,
    "light": write_light,
    "frame": write_frame,
    "joint": write_joint,
    "mimic": write_mimic,
    "sensor": write_sensor,
    "model": write_model,
    "link": write_link,
    "inertial": write_inertial,
    "collision": write_collision,
    "geometry": write_geometry,
    "surface": write_surface,
    "visual": write_visual,
    "material": write_material,
}
