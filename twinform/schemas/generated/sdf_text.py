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
from twinform.schemas.values import (
    format_number,
    format_numbers,
    format_value,
)


def write_pose(node: Any, out: TextOutput, indent: str) -> str:
    """`<pose>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["relative_to"]) is not None:
        attributes += f' relative_to="{in_attribute(value)}"'
    if (value := values["rotation_format"]) is not None:
        attributes += f' rotation_format="{in_attribute(value)}"'
    if (value := values["degrees"]) is not None:
        attributes += f' degrees="{bool_attribute(values, "degrees")}"'
    text = pose_numbers(values)
    if values["opaque"]:
        return out.with_untyped(node, "pose", indent, attributes=attributes, text=text)
    if text is None:
        return f"{indent}<pose{attributes}/>" if attributes else ""
    return f"{indent}<pose{attributes}>{text}</pose>"


def write_plugin(node: Any, out: TextOutput, indent: str) -> str:
    """`<plugin>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["filename"]) is not None:
        attributes += f' filename="{in_attribute(value)}"'
    if values["content"] or values["opaque"]:
        return out.with_untyped(node, "plugin", indent, attributes=attributes, content=values["content"], keep=True)
    return f"{indent}<plugin{attributes}/>"


def write_include(node: Any, out: TextOutput, indent: str) -> str:
    """`<include>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["merge"]) is not None:
        attributes += f' merge="{bool_attribute(values, "merge")}"'
    if (value := values["uri"]) is not None:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if (value := values["name"]) is not None:
        body += f"{inner}<name>{in_text(value)}</name>"
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if (value := values["static"]) is not None:
        body += f"{inner}<static>{bool_text(values, 'static')}</static>"
    if (value := values["placement_frame"]) is not None:
        body += f"{inner}<placement_frame>{in_text(value)}</placement_frame>"
    if values["plugins"]:
        body += out.parts(node, inner, (values["plugins"], write_plugin))
    if values["opaque"]:
        return out.with_untyped(node, "include", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<include{attributes}>{body}{indent}</include>"
    return f"{indent}<include{attributes}/>"


def write_light(node: Any, out: TextOutput, indent: str) -> str:
    """`<light>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["type"]) is not None:
        attributes += f' type="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if (value := values["cast_shadows"]) is not None:
        body += f"{inner}<cast_shadows>{bool_text(values, 'cast_shadows')}</cast_shadows>"
    if (value := values["intensity"]) is not None:
        body += f"{inner}<intensity>{format_number(value)}</intensity>"
    if (value := values["diffuse"]) is not None:
        body += f"{inner}<diffuse>{format_numbers(value)}</diffuse>"
    if (value := values["specular"]) is not None:
        body += f"{inner}<specular>{format_numbers(value)}</specular>"
    if (value := values["direction"]) is not None:
        body += f"{inner}<direction>{vector3(value)}</direction>"
    if values["opaque"]:
        return out.with_untyped(node, "light", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<light{attributes}>{body}{indent}</light>"
    return f"{indent}<light{attributes}/>"


def write_frame(node: Any, out: TextOutput, indent: str) -> str:
    """`<frame>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["attached_to"]) is not None:
        attributes += f' attached_to="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "frame", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<frame{attributes}>{body}{indent}</frame>"
    return f"{indent}<frame{attributes}/>"


def write_joint_axis_xyz(values: dict[str, Any], indent: str) -> str:
    """`<xyz>`, of fields of the node around it."""
    attributes = ""
    if (value := values["expressed_in"]) is not None:
        attributes += f' expressed_in="{in_attribute(value)}"'
    if (value := values["xyz"]) is None:
        return f"{indent}<xyz{attributes}/>" if attributes else ""
    return f"{indent}<xyz{attributes}>{vector3(value)}</xyz>"


def write_joint_axis_dynamics(node: Any, out: TextOutput, indent: str) -> str:
    """`<dynamics>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["damping"]) is not None:
        body += f"{inner}<damping>{format_number(value)}</damping>"
    if (value := values["friction"]) is not None:
        body += f"{inner}<friction>{format_number(value)}</friction>"
    if (value := values["spring_reference"]) is not None:
        body += f"{inner}<spring_reference>{format_number(value)}</spring_reference>"
    if (value := values["spring_stiffness"]) is not None:
        body += f"{inner}<spring_stiffness>{format_number(value)}</spring_stiffness>"
    if values["opaque"]:
        return out.with_untyped(node, "joint/axis/dynamics", indent, body=body)
    return f"{indent}<dynamics>{body}{indent}</dynamics>" if body else ""


def write_joint_axis_limit(node: Any, out: TextOutput, indent: str) -> str:
    """`<limit>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["lower"]) is not None:
        body += f"{inner}<lower>{format_number(value)}</lower>"
    if (value := values["upper"]) is not None:
        body += f"{inner}<upper>{format_number(value)}</upper>"
    if (value := values["effort"]) is not None:
        body += f"{inner}<effort>{format_number(value)}</effort>"
    if (value := values["velocity"]) is not None:
        body += f"{inner}<velocity>{format_number(value)}</velocity>"
    if (value := values["stiffness"]) is not None:
        body += f"{inner}<stiffness>{format_number(value)}</stiffness>"
    if (value := values["dissipation"]) is not None:
        body += f"{inner}<dissipation>{format_number(value)}</dissipation>"
    if values["opaque"]:
        return out.with_untyped(node, "joint/axis/limit", indent, body=body)
    return f"{indent}<limit>{body}{indent}</limit>" if body else ""


def write_mimic(node: Any, out: TextOutput, indent: str) -> str:
    """`<mimic>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["joint"]) is not None:
        attributes += f' joint="{in_attribute(value)}"'
    if (value := values["axis"]) is not None:
        attributes += f' axis="{in_attribute(value)}"'
    if (value := values["multiplier"]) is not None:
        body += f"{inner}<multiplier>{format_number(value)}</multiplier>"
    if (value := values["offset"]) is not None:
        body += f"{inner}<offset>{format_number(value)}</offset>"
    if (value := values["reference"]) is not None:
        body += f"{inner}<reference>{format_number(value)}</reference>"
    if values["opaque"]:
        return out.with_untyped(node, "mimic", indent, attributes=attributes, body=body)
    if body:
        return f"{indent}<mimic{attributes}>{body}{indent}</mimic>"
    return f"{indent}<mimic{attributes}/>" if attributes else ""


def write_joint_axis(node: Any, out: TextOutput, indent: str) -> str:
    """`<axis>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    body += write_joint_axis_xyz(values, inner)
    if (value := values["dynamics"]) is not None:
        body += write_joint_axis_dynamics(value, out, inner)
    if (value := values["limit"]) is not None:
        body += write_joint_axis_limit(value, out, inner)
    if (value := values["mimic"]) is not None:
        body += write_mimic(value, out, inner)
    if (value := values["use_parent_model_frame"]) is not None:
        body += f"{inner}<use_parent_model_frame>{bool_text(values, 'use_parent_model_frame')}</use_parent_model_frame>"
    if values["opaque"]:
        return out.with_untyped(node, "joint/axis", indent, body=body)
    return f"{indent}<axis>{body}{indent}</axis>" if body else ""


def write_joint_axis2(node: Any, out: TextOutput, indent: str) -> str:
    """`<axis2>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    body += write_joint_axis_xyz(values, inner)
    if (value := values["dynamics"]) is not None:
        body += write_joint_axis_dynamics(value, out, inner)
    if (value := values["limit"]) is not None:
        body += write_joint_axis_limit(value, out, inner)
    if (value := values["mimic"]) is not None:
        body += write_mimic(value, out, inner)
    if (value := values["use_parent_model_frame"]) is not None:
        body += f"{inner}<use_parent_model_frame>{bool_text(values, 'use_parent_model_frame')}</use_parent_model_frame>"
    if values["opaque"]:
        return out.with_untyped(node, "joint/axis2", indent, body=body)
    return f"{indent}<axis2>{body}{indent}</axis2>" if body else ""


def write_sensor(node: Any, out: TextOutput, indent: str) -> str:
    """`<sensor>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["type"]) is not None:
        attributes += f' type="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if (value := values["always_on"]) is not None:
        body += f"{inner}<always_on>{bool_text(values, 'always_on')}</always_on>"
    if (value := values["update_rate"]) is not None:
        body += f"{inner}<update_rate>{format_number(value)}</update_rate>"
    if (value := values["visualize"]) is not None:
        body += f"{inner}<visualize>{bool_text(values, 'visualize')}</visualize>"
    if (value := values["topic"]) is not None:
        body += f"{inner}<topic>{in_text(value)}</topic>"
    if (value := values["enable_metrics"]) is not None:
        body += f"{inner}<enable_metrics>{bool_text(values, 'enable_metrics')}</enable_metrics>"
    if (value := values["frame_id"]) is not None:
        body += f"{inner}<frame_id>{in_text(value)}</frame_id>"
    if values["plugins"]:
        body += out.parts(node, inner, (values["plugins"], write_plugin))
    if values["opaque"]:
        return out.with_untyped(node, "sensor", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<sensor{attributes}>{body}{indent}</sensor>"
    return f"{indent}<sensor{attributes}/>"


def write_joint(node: Any, out: TextOutput, indent: str) -> str:
    """`<joint>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["type"]) is not None:
        attributes += f' type="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if (value := values["parent"]) is not None:
        body += f"{inner}<parent>{in_text(value)}</parent>"
    if (value := values["child"]) is not None:
        body += f"{inner}<child>{in_text(value)}</child>"
    if (value := values["gearbox_ratio"]) is not None:
        body += f"{inner}<gearbox_ratio>{format_number(value)}</gearbox_ratio>"
    if (value := values["gearbox_reference_body"]) is not None:
        body += f"{inner}<gearbox_reference_body>{in_text(value)}</gearbox_reference_body>"
    if (value := values["thread_pitch"]) is not None:
        body += f"{inner}<thread_pitch>{format_number(value)}</thread_pitch>"
    if (value := values["screw_thread_pitch"]) is not None:
        body += f"{inner}<screw_thread_pitch>{format_number(value)}</screw_thread_pitch>"
    if (value := values["axis"]) is not None:
        body += write_joint_axis(value, out, inner)
    if (value := values["axis2"]) is not None:
        body += write_joint_axis2(value, out, inner)
    if values["sensors"]:
        body += out.parts(node, inner, (values["sensors"], write_sensor))
    if values["opaque"]:
        return out.with_untyped(node, "joint", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<joint{attributes}>{body}{indent}</joint>"
    return f"{indent}<joint{attributes}/>"


def write_inertial_pose(node: Any, out: TextOutput, indent: str) -> str:
    """`<pose>`."""
    values = node.__dict__
    attributes = ""
    if (value := values["rotation_format"]) is not None:
        attributes += f' rotation_format="{in_attribute(value)}"'
    if (value := values["degrees"]) is not None:
        attributes += f' degrees="{bool_attribute(values, "degrees")}"'
    text = pose_numbers(values)
    if values["opaque"]:
        return out.with_untyped(node, "inertial/pose", indent, attributes=attributes, text=text)
    if text is None:
        return f"{indent}<pose{attributes}/>" if attributes else ""
    return f"{indent}<pose{attributes}>{text}</pose>"


def write_inertial_inertia(node: Any, out: TextOutput, indent: str) -> str:
    """`<inertia>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["ixx"]) is not None:
        body += f"{inner}<ixx>{format_number(value)}</ixx>"
    if (value := values["ixy"]) is not None:
        body += f"{inner}<ixy>{format_number(value)}</ixy>"
    if (value := values["ixz"]) is not None:
        body += f"{inner}<ixz>{format_number(value)}</ixz>"
    if (value := values["iyy"]) is not None:
        body += f"{inner}<iyy>{format_number(value)}</iyy>"
    if (value := values["iyz"]) is not None:
        body += f"{inner}<iyz>{format_number(value)}</iyz>"
    if (value := values["izz"]) is not None:
        body += f"{inner}<izz>{format_number(value)}</izz>"
    if values["opaque"]:
        return out.with_untyped(node, "inertial/inertia", indent, body=body)
    return f"{indent}<inertia>{body}{indent}</inertia>" if body else ""


def write_inertial(node: Any, out: TextOutput, indent: str) -> str:
    """`<inertial>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["auto"]) is not None:
        attributes += f' auto="{bool_attribute(values, "auto")}"'
    if (value := values["pose"]) is not None:
        body += (write_inertial_pose if out.version >= (1, 8) else write_pose)(value, out, inner)
    if (value := values["mass"]) is not None:
        body += f"{inner}<mass>{format_number(value)}</mass>"
    if (value := values["inertia"]) is not None:
        body += write_inertial_inertia(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "inertial", indent, attributes=attributes, body=body)
    if body:
        return f"{indent}<inertial{attributes}>{body}{indent}</inertial>"
    return f"{indent}<inertial{attributes}/>" if attributes else ""


def write_geometry_empty(node: Any, out: TextOutput, indent: str) -> str:
    """`<empty>`."""
    values = node.__dict__
    if values["opaque"]:
        return out.with_untyped(node, "geometry/empty", indent, keep=True)
    return f"{indent}<empty/>"


def write_geometry_box(node: Any, out: TextOutput, indent: str) -> str:
    """`<box>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["size"]) is not None:
        body += f"{inner}<size>{vector3(value)}</size>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/box", indent, body=body, keep=True)
    return f"{indent}<box>{body}{indent}</box>" if body else f"{indent}<box/>"


def write_geometry_capsule(node: Any, out: TextOutput, indent: str) -> str:
    """`<capsule>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["radius"]) is not None:
        body += f"{inner}<radius>{format_number(value)}</radius>"
    if (value := values["length"]) is not None:
        body += f"{inner}<length>{format_number(value)}</length>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/capsule", indent, body=body, keep=True)
    return f"{indent}<capsule>{body}{indent}</capsule>" if body else f"{indent}<capsule/>"


def write_geometry_cone(node: Any, out: TextOutput, indent: str) -> str:
    """`<cone>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["radius"]) is not None:
        body += f"{inner}<radius>{format_number(value)}</radius>"
    if (value := values["length"]) is not None:
        body += f"{inner}<length>{format_number(value)}</length>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/cone", indent, body=body, keep=True)
    return f"{indent}<cone>{body}{indent}</cone>" if body else f"{indent}<cone/>"


def write_geometry_cylinder(node: Any, out: TextOutput, indent: str) -> str:
    """`<cylinder>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["radius"]) is not None:
        body += f"{inner}<radius>{format_number(value)}</radius>"
    if (value := values["length"]) is not None:
        body += f"{inner}<length>{format_number(value)}</length>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/cylinder", indent, body=body, keep=True)
    return f"{indent}<cylinder>{body}{indent}</cylinder>" if body else f"{indent}<cylinder/>"


def write_geometry_ellipsoid(node: Any, out: TextOutput, indent: str) -> str:
    """`<ellipsoid>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["radii"]) is not None:
        body += f"{inner}<radii>{vector3(value)}</radii>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/ellipsoid", indent, body=body, keep=True)
    return f"{indent}<ellipsoid>{body}{indent}</ellipsoid>" if body else f"{indent}<ellipsoid/>"


def write_geometry_heightmap(node: Any, out: TextOutput, indent: str) -> str:
    """`<heightmap>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["uri"]) is not None:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/heightmap", indent, body=body, keep=True)
    return f"{indent}<heightmap>{body}{indent}</heightmap>" if body else f"{indent}<heightmap/>"


def write_geometry_image(node: Any, out: TextOutput, indent: str) -> str:
    """`<image>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["uri"]) is not None:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/image", indent, body=body, keep=True)
    return f"{indent}<image>{body}{indent}</image>" if body else f"{indent}<image/>"


def write_geometry_mesh(node: Any, out: TextOutput, indent: str) -> str:
    """`<mesh>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["uri"]) is not None:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if (value := values["scale"]) is not None:
        body += f"{inner}<scale>{vector3(value)}</scale>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/mesh", indent, body=body, keep=True)
    return f"{indent}<mesh>{body}{indent}</mesh>" if body else f"{indent}<mesh/>"


def write_geometry_plane(node: Any, out: TextOutput, indent: str) -> str:
    """`<plane>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["normal"]) is not None:
        body += f"{inner}<normal>{vector3(value)}</normal>"
    if (value := values["size"]) is not None:
        body += f"{inner}<size>{format_numbers(value)}</size>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/plane", indent, body=body, keep=True)
    return f"{indent}<plane>{body}{indent}</plane>" if body else f"{indent}<plane/>"


def write_geometry_polyline(node: Any, out: TextOutput, indent: str) -> str:
    """`<polyline>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["height"]) is not None:
        body += f"{inner}<height>{format_number(value)}</height>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/polyline", indent, body=body, keep=True)
    return f"{indent}<polyline>{body}{indent}</polyline>" if body else f"{indent}<polyline/>"


def write_geometry_sphere(node: Any, out: TextOutput, indent: str) -> str:
    """`<sphere>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["radius"]) is not None:
        body += f"{inner}<radius>{format_number(value)}</radius>"
    if values["opaque"]:
        return out.with_untyped(node, "geometry/sphere", indent, body=body, keep=True)
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
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["shape"]) is not None and (write := GEOMETRY_SHAPES.get(value.kind)) is not None:
        body += write(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "geometry", indent, body=body)
    return f"{indent}<geometry>{body}{indent}</geometry>" if body else ""


def write_surface_bounce(values: dict[str, Any], indent: str) -> str:
    """`<bounce>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    if (value := values["restitution_coefficient"]) is not None:
        body += f"{inner}<restitution_coefficient>{format_number(value)}</restitution_coefficient>"
    if (value := values["threshold"]) is not None:
        body += f"{inner}<threshold>{format_number(value)}</threshold>"
    return f"{indent}<bounce>{body}{indent}</bounce>" if body else ""


def write_surface_friction_ode(values: dict[str, Any], indent: str) -> str:
    """`<ode>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    if (value := values["mu"]) is not None:
        body += f"{inner}<mu>{format_number(value)}</mu>"
    if (value := values["mu2"]) is not None:
        body += f"{inner}<mu2>{format_number(value)}</mu2>"
    if (value := values["fdir1"]) is not None:
        body += f"{inner}<fdir1>{vector3(value)}</fdir1>"
    if (value := values["slip1"]) is not None:
        body += f"{inner}<slip1>{format_number(value)}</slip1>"
    if (value := values["slip2"]) is not None:
        body += f"{inner}<slip2>{format_number(value)}</slip2>"
    return f"{indent}<ode>{body}{indent}</ode>" if body else ""


def write_surface_friction(values: dict[str, Any], indent: str) -> str:
    """`<friction>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    body += write_surface_friction_ode(values, inner)
    return f"{indent}<friction>{body}{indent}</friction>" if body else ""


def write_surface_contact_ode(values: dict[str, Any], indent: str) -> str:
    """`<ode>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    if (value := values["kp"]) is not None:
        body += f"{inner}<kp>{format_number(value)}</kp>"
    if (value := values["kd"]) is not None:
        body += f"{inner}<kd>{format_number(value)}</kd>"
    if (value := values["max_vel"]) is not None:
        body += f"{inner}<max_vel>{format_number(value)}</max_vel>"
    if (value := values["min_depth"]) is not None:
        body += f"{inner}<min_depth>{format_number(value)}</min_depth>"
    return f"{indent}<ode>{body}{indent}</ode>" if body else ""


def write_surface_contact(values: dict[str, Any], indent: str) -> str:
    """`<contact>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    body += write_surface_contact_ode(values, inner)
    return f"{indent}<contact>{body}{indent}</contact>" if body else ""


def write_surface(node: Any, out: TextOutput, indent: str) -> str:
    """`<surface>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    body += write_surface_bounce(values, inner)
    body += write_surface_friction(values, inner)
    body += write_surface_contact(values, inner)
    if values["opaque"]:
        return out.with_untyped(node, "surface", indent, body=body)
    return f"{indent}<surface>{body}{indent}</surface>" if body else ""


def write_collision(node: Any, out: TextOutput, indent: str) -> str:
    """`<collision>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if (value := values["laser_retro"]) is not None:
        body += f"{inner}<laser_retro>{format_number(value)}</laser_retro>"
    if (value := values["max_contacts"]) is not None:
        body += f"{inner}<max_contacts>{format_value(value)}</max_contacts>"
    if (value := values["geometry"]) is not None:
        body += write_geometry(value, out, inner)
    if (value := values["surface"]) is not None:
        body += write_surface(value, out, inner)
    if values["opaque"]:
        return out.with_untyped(node, "collision", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<collision{attributes}>{body}{indent}</collision>"
    return f"{indent}<collision{attributes}/>"


def write_material_script(node: Any, out: TextOutput, indent: str) -> str:
    """`<script>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    for value in values["uris"]:
        body += f"{inner}<uri>{in_text(value)}</uri>"
    if (value := values["name"]) is not None:
        body += f"{inner}<name>{in_text(value)}</name>"
    if values["opaque"]:
        return out.with_untyped(node, "material/script", indent, body=body)
    return f"{indent}<script>{body}{indent}</script>" if body else ""


def write_material_pbr_metal(values: dict[str, Any], indent: str) -> str:
    """`<metal>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    if (value := values["albedo_map"]) is not None:
        body += f"{inner}<albedo_map>{in_text(value)}</albedo_map>"
    return f"{indent}<metal>{body}{indent}</metal>" if body else ""


def write_material_pbr(values: dict[str, Any], indent: str) -> str:
    """`<pbr>`, of fields of the node around it."""
    inner = indent + "  "
    body = ""
    body += write_material_pbr_metal(values, inner)
    return f"{indent}<pbr>{body}{indent}</pbr>" if body else ""


def write_material(node: Any, out: TextOutput, indent: str) -> str:
    """`<material>`."""
    values = node.__dict__
    inner = indent + "  "
    body = ""
    if (value := values["script"]) is not None:
        body += write_material_script(value, out, inner)
    if (value := values["ambient"]) is not None:
        body += f"{inner}<ambient>{format_numbers(value)}</ambient>"
    if (value := values["diffuse"]) is not None:
        body += f"{inner}<diffuse>{format_numbers(value)}</diffuse>"
    if (value := values["specular"]) is not None:
        body += f"{inner}<specular>{format_numbers(value)}</specular>"
    if (value := values["emissive"]) is not None:
        body += f"{inner}<emissive>{format_numbers(value)}</emissive>"
    body += write_material_pbr(values, inner)
    if values["opaque"]:
        return out.with_untyped(node, "material", indent, body=body)
    return f"{indent}<material>{body}{indent}</material>" if body else ""


def write_visual(node: Any, out: TextOutput, indent: str) -> str:
    """`<visual>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if (value := values["geometry"]) is not None:
        body += write_geometry(value, out, inner)
    if (value := values["material"]) is not None:
        body += write_material(value, out, inner)
    if values["plugins"]:
        body += out.parts(node, inner, (values["plugins"], write_plugin))
    if values["opaque"]:
        return out.with_untyped(node, "visual", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<visual{attributes}>{body}{indent}</visual>"
    return f"{indent}<visual{attributes}/>"


def write_link(node: Any, out: TextOutput, indent: str) -> str:
    """`<link>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if (value := values["gravity"]) is not None:
        body += f"{inner}<gravity>{bool_text(values, 'gravity')}</gravity>"
    if (value := values["enable_wind"]) is not None:
        body += f"{inner}<enable_wind>{bool_text(values, 'enable_wind')}</enable_wind>"
    if (value := values["self_collide"]) is not None:
        body += f"{inner}<self_collide>{bool_text(values, 'self_collide')}</self_collide>"
    if (value := values["kinematic"]) is not None:
        body += f"{inner}<kinematic>{bool_text(values, 'kinematic')}</kinematic>"
    if (value := values["inertial"]) is not None:
        body += write_inertial(value, out, inner)
    body += out.parts(
        node,
        inner,
        (values["collisions"], write_collision),
        (values["visuals"], write_visual),
        (values["sensors"], write_sensor),
        (values["lights"], write_light),
    )
    if values["opaque"]:
        return out.with_untyped(node, "link", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<link{attributes}>{body}{indent}</link>"
    return f"{indent}<link{attributes}/>"


def write_model(node: Any, out: TextOutput, indent: str) -> str:
    """`<model>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["canonical_link"]) is not None:
        attributes += f' canonical_link="{in_attribute(value)}"'
    if (value := values["placement_frame"]) is not None:
        attributes += f' placement_frame="{in_attribute(value)}"'
    if (value := values["pose"]) is not None:
        body += write_pose(value, out, inner)
    if (value := values["static"]) is not None:
        body += f"{inner}<static>{bool_text(values, 'static')}</static>"
    if (value := values["self_collide"]) is not None:
        body += f"{inner}<self_collide>{bool_text(values, 'self_collide')}</self_collide>"
    if (value := values["allow_auto_disable"]) is not None:
        body += f"{inner}<allow_auto_disable>{bool_text(values, 'allow_auto_disable')}</allow_auto_disable>"
    if (value := values["enable_wind"]) is not None:
        body += f"{inner}<enable_wind>{bool_text(values, 'enable_wind')}</enable_wind>"
    body += out.parts(
        node,
        inner,
        (values["frames"], write_frame),
        (values["links"], write_link),
        (values["joints"], write_joint),
        (values["plugins"], write_plugin),
        (values["includes"], write_include),
        (values["models"], write_model),
    )
    if values["opaque"]:
        return out.with_untyped(node, "model", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<model{attributes}>{body}{indent}</model>"
    return f"{indent}<model{attributes}/>"


def write_world(node: Any, out: TextOutput, indent: str) -> str:
    """`<world>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    if (value := values["name"]) is not None:
        attributes += f' name="{in_attribute(value)}"'
    if (value := values["gravity"]) is not None:
        body += f"{inner}<gravity>{vector3(value)}</gravity>"
    body += out.parts(
        node,
        inner,
        (values["includes"], write_include),
        (values["lights"], write_light),
        (values["frames"], write_frame),
        (values["joints"], write_joint),
        (values["models"], write_model),
        (values["plugins"], write_plugin),
    )
    if values["opaque"]:
        return out.with_untyped(node, "world", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<world{attributes}>{body}{indent}</world>"
    return f"{indent}<world{attributes}/>"


def write_sdf(node: Any, out: TextOutput, indent: str) -> str:
    """`<sdf>`."""
    values = node.__dict__
    inner = indent + "  "
    attributes = body = ""
    attributes += out.declarations
    if (value := values["version"]) is not None:
        attributes += f' version="{in_attribute(value)}"'
    body += out.parts(
        node,
        inner,
        (values["worlds"], write_world),
        (values["models"], write_model),
        (values["lights"], write_light),
        (values["includes"], write_include),
    )
    attributes += out.root_attributes
    if values["opaque"]:
        return out.with_untyped(node, "sdf", indent, attributes=attributes, body=body, keep=True)
    if body:
        return f"{indent}<sdf{attributes}>{body}{indent}</sdf>"
    return f"{indent}<sdf{attributes}/>"


write_root: Write = write_sdf
