"""Rules of portability: what is fine in general, and not for some consumer. Looked for only with `--for`."""

from twinform.diagnostics.rule import Rule, Severity

COLLADA_MESH = Rule(
    name="collada-mesh",
    severity=Severity.INFO,
    finds="A mesh in a COLLADA file (`.dae`).",
    matters="Not every consumer reads COLLADA: PyBullet shows nothing, MuJoCo refuses the model, Drake leaves the "
    "shape out.",
    example="`<mesh filename='package://arm/meshes/base.dae'/>` under `--for mujoco`.",
    better="Convert the file to OBJ, STL or glTF.",
)
