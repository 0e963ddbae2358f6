"""The intermediate representation: frozen nodes, one family in each file, and pure functions over them."""

from twinform.ir.census import OPAQUE, PLAIN, PREFIXED, bits_named, bits_of, census_of, holds_opaque, untyped_elements
from twinform.ir.document import Document, Format, World
from twinform.ir.element import Element, Opaque
from twinform.ir.geometry import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    Image,
    Mesh,
    Plane,
    Polyline,
    Shape,
    Sphere,
)
from twinform.ir.joint import Axis, Dynamics, Joint, JointType, Limit, Mimic
from twinform.ir.link import Inertia, Inertial, Link
from twinform.ir.model import GazeboExtension, Include, Model
from twinform.ir.node import Color, Node, Quaternion, Vector3
from twinform.ir.pose import Frame, Pose
from twinform.ir.record import field_values
from twinform.ir.references import IN_MODELS, ReferenceChange, ReferenceKind, map_references
from twinform.ir.rewrite import map_children, replace_fields, replace_node, rewrite
from twinform.ir.sensor import Light, Plugin, Sensor
from twinform.ir.tree_walks import children_of, count_parts, node_fields, node_values, walk
from twinform.ir.visual import Collision, Material, Script, Surface, Visual

__all__ = [
    "IN_MODELS",
    "OPAQUE",
    "PLAIN",
    "PREFIXED",
    "Axis",
    "Box",
    "Capsule",
    "Collision",
    "Color",
    "Cone",
    "Cylinder",
    "Document",
    "Dynamics",
    "Element",
    "Ellipsoid",
    "Empty",
    "Format",
    "Frame",
    "GazeboExtension",
    "Geometry",
    "Heightmap",
    "Image",
    "Include",
    "Inertia",
    "Inertial",
    "Joint",
    "JointType",
    "Light",
    "Limit",
    "Link",
    "Material",
    "Mesh",
    "Mimic",
    "Model",
    "Node",
    "Opaque",
    "Plane",
    "Plugin",
    "Polyline",
    "Pose",
    "Quaternion",
    "ReferenceChange",
    "ReferenceKind",
    "Script",
    "Sensor",
    "Shape",
    "Sphere",
    "Surface",
    "Vector3",
    "Visual",
    "World",
    "bits_named",
    "bits_of",
    "census_of",
    "children_of",
    "count_parts",
    "field_values",
    "holds_opaque",
    "map_children",
    "map_references",
    "node_fields",
    "node_values",
    "replace_fields",
    "replace_node",
    "rewrite",
    "untyped_elements",
    "walk",
]
