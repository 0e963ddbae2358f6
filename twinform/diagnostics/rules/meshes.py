"""Rules about the mesh files of a model, for passes that look into them."""

from twinform.diagnostics.rule import Rule, Severity

OPEN_MESH = Rule(
    name="open-mesh",
    severity=Severity.WARNING,
    finds="A mesh without an inside, of which a pass needs the volume: its surface has holes, its faces do not agree "
    "which side is outside, or it is flat.",
    matters="What its triangles enclose is not a volume, so a mass and an inertia computed from them would be wrong.",
    example="`fill-inertia` on a link whose collision is the scan of a housing, open at the bottom.",
    better="Close the mesh in a modeling program, use its convex hull (`fill-inertia{open-meshes=hull}`), or use "
    "simple shapes for the collision.",
)
UNREADABLE_MESH = Rule(
    name="unreadable-mesh",
    severity=Severity.WARNING,
    finds="A mesh file that a pass has to look into and cannot read: a format that is not known, broken contents, no "
    "triangles, or no submesh of the name.",
    matters="Nothing can be computed from it; simulators that cannot read it either leave the shape out.",
    example="`<mesh filename='package://arm/meshes/base.step'/>`",
    better="Export it as STL, OBJ, COLLADA, PLY or glTF binary.",
)
MESH_READER_MISSING = Rule(
    name="mesh-reader-missing",
    severity=Severity.WARNING,
    finds="A mesh file that a pass has to look into, where the library that reads meshes is not installed.",
    matters="Nothing can be computed from it.",
    example="`fill-inertia` on a robot with meshes, after `pip install twinform`.",
    better="`pip install 'twinform[meshes]'`",
)
