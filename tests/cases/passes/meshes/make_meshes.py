"""Makes the meshes of these cases: `python tests/cases/passes/meshes/make_meshes.py`."""

import importlib
from pathlib import Path
from typing import Any

trimesh: Any = importlib.import_module("trimesh")
FOLDER = Path(__file__).parent / "meshes"


def main() -> None:
    """Write them all."""
    FOLDER.mkdir(exist_ok=True)
    ring = trimesh.creation.annulus(0.05, 0.1, 0.04, sections=12)
    ring.export(FOLDER / "ring.stl")
    drum = trimesh.creation.cylinder(0.1, 0.3, sections=24)
    drum.apply_translation((0, 0, 0.15))
    drum.export(FOLDER / "drum.obj", header=None, include_normals=False, digits=6)
    cone = trimesh.creation.cone(0.1, 0.2, sections=12)
    cone.export(FOLDER / "cone.stl")
    trimesh.creation.uv_sphere(0.1, count=[12, 12]).export(FOLDER / "ball.ply")
    box = trimesh.creation.box((0.1, 0.2, 0.3))
    box.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.SimpleMaterial(diffuse=(255, 0, 0, 255))
    )
    text = box.export(file_type="dae").decode().replace("<up_axis>", '<unit name="inch" meter="0.0254"/><up_axis>')
    (FOLDER / "inches.dae").write_text(text)
    painted = trimesh.creation.box((0.1, 0.1, 0.1))
    painted.visual.face_colors = (0, 200, 0, 255)
    painted.export(FOLDER / "painted.ply")
    flat = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    flat.export(FOLDER / "flat.stl")
    (FOLDER / "broken.stl").write_bytes(b"\0" * 80 + (2**32 - 1).to_bytes(4, "little") + b"\0" * 50)
    (FOLDER / "not_finite.obj").write_text("v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n")
    (FOLDER / "secret.obj").write_text("mtllib ../../../../../../etc/passwd.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")


if __name__ == "__main__":
    main()
