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
CHANGED_MESH = Rule(
    name="changed-mesh",
    severity=Severity.INFO,
    finds="A shape whose mesh a pass has replaced: a collision by a simpler shape or convex parts, a visual by one of "
    "fewer triangles, or a file by one of another format.",
    matters="It says how many triangles there were and are, and how far the new surface is from the old one at most.",
    example="`simplify-collisions` on an arm whose collisions are the meshes of its visuals.",
    better="Nothing has to be done. Look at the result where the distance matters, or ask for a smaller one.",
)
KEPT_MESH = Rule(
    name="kept-mesh",
    severity=Severity.WARNING,
    finds="A shape whose mesh a pass was asked to replace, and leaves as it is: nothing cheaper is within the distance "
    "that was asked for, something of it would be lost, or a mass would change with it.",
    matters="It costs what it cost before.",
    example="`simplify-collisions{how=hull max-relative-error=0.01}` on a ring.",
    better="Allow a larger distance (`max-error`, `max-relative-error`) or more ways (`how`), or make a mesh by hand.",
)
