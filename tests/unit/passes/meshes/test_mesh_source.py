"""What a mesh names beside itself, also behind options of textures."""

from pathlib import Path

import pytest

from twinform.passes.meshes.mesh_source import companions_of


@pytest.mark.parametrize(
    "line",
    [
        "map_Kd wood.png",
        "map_Kd   wood.png  ",
        "\tmap_Kd -s 1 1 1 wood.png\r",
        "map_Bump -bm 0.5 wood.png",
        "bump -o -1 -2 -3 -mm 0 1 wood.png",
    ],
)
def test_the_texture_of_a_material_is_found_behind_its_options(line: str, tmp_path: Path) -> None:
    (tmp_path / "box.mtl").write_text(f"newmtl a\n{line}\n")
    (tmp_path / "wood.png").write_bytes(b"png")
    found = companions_of(tmp_path / "box.obj", "obj", b"  mtllib box.mtl \r\nv 0 0 0\n")
    assert (sorted(found.files), found.missing) == (["box.mtl", "wood.png"], ())
