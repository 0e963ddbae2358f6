import json
import struct

import pytest

from twinform.passes.mesh_references import FORMATS

_DAE = b"""<?xml version="1.0"?>
<COLLADA><library_images>
  <!-- <image><init_from>not/this.png</init_from></image> -->
  <image id="a" name="b"><init_from> ../textures/a&amp;b%20c.png </init_from></image>
  <image id="c"><init_from><ref>c.png</ref></init_from></image>
</library_images><library_effects><surface><init_from>a</init_from></surface></library_effects></COLLADA>"""
_OBJ = b"# made by hand\r\nmtllib one.mtl two.mtl\r\nmtllib with blank.mtl\nv 0 0 0\n"
_MTL = b"""newmtl skin
Kd 1 1 1
map_Kd -s 1 1 1 -o 0.5 -clamp on textures/my skin.png
\tmap_Bump -bm 0.2 bump.png
norm normal.png
map_Ka
"""
_SCRIPT = b"""material Arm { technique { pass { texture_unit {
        texture arm.png
        texture_alias other
        texture "blank name.png" 2d
} } } }"""
_IMAGES = [{"uri": "a%20b.png"}, {"bufferView": 1}, {"uri": "data:image/png;base64,AA=="}]
_GLTF = json.dumps({"images": _IMAGES, "buffers": [{"uri": "b.bin"}]}).encode()


def _glb(description: bytes, rest: bytes = b"") -> bytes:
    description += b" " * (-len(description) % 4)
    chunk = struct.pack("<I4s", len(description), b"JSON") + description
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunk) + len(rest)) + chunk + rest


_BINARY = struct.pack("<I4s", 4, b"BIN\0") + b"abcd"
FILES = {
    "dae": (_DAE, ["../textures/a&b%20c.png", "c.png"]),
    "obj": (_OBJ, ["one.mtl", "two.mtl", "with blank.mtl"]),
    "mtl": (_MTL, ["textures/my skin.png", "bump.png", "normal.png"]),
    "material": (_SCRIPT, ["arm.png", "blank name.png"]),
    "gltf": (_GLTF, ["b.bin", "a b.png"]),
    "glb": (_glb(_GLTF, _BINARY), ["b.bin", "a b.png"]),
}


@pytest.mark.parametrize("suffix", FORMATS)
def test_all_references_are_found(suffix: str) -> None:
    data, names = FILES[suffix]
    assert FORMATS[suffix].references(data) == names


@pytest.mark.parametrize("suffix", FORMATS)
def test_references_are_rewritten_and_found_again(suffix: str) -> None:
    data, names = FILES[suffix]
    ending = {"dae": "<&>.png", "obj": ".mtl"}.get(suffix, ".png")
    new = {name: f"x/{number}{ending}" for number, name in enumerate(names)}
    assert FORMATS[suffix].references(FORMATS[suffix].rewritten(data, new)) == list(new.values())


@pytest.mark.parametrize("suffix", ["dae", "obj", "mtl", "material"])
def test_all_around_a_reference_stays(suffix: str) -> None:
    data, names = FILES[suffix]
    same = {name: name for name in names}
    if suffix != "dae":  # whose entities may be written in several ways
        assert FORMATS[suffix].rewritten(data, same) == data
    marked = FORMATS[suffix].rewritten(data, dict.fromkeys(names, "@"))
    assert len(marked) == len(data) - sum(len(name) - 1 for name in names) - (4 if suffix == "dae" else 0)


def test_the_rest_of_a_binary_stays() -> None:
    new = FORMATS["glb"].rewritten(_glb(_GLTF, _BINARY), {"a b.png": "a much longer name.png"})
    assert new.endswith(_BINARY)
    assert struct.unpack_from("<I", new, 8) == (len(new),)
    assert len(new) % 4 == 0


_TOO_LONG = struct.pack("<4sIII4s", b"glTF", 2, 20, 2**31, b"JSON")
_NO_GLTF = (b"", b"{", b"[]", b"glTF", _glb(b"{}")[:14], _TOO_LONG, b"[" * 10**5)


@pytest.mark.parametrize("suffix", ["gltf", "glb"])
@pytest.mark.parametrize("data", _NO_GLTF)
def test_what_is_no_gltf_is_refused(suffix: str, data: bytes) -> None:
    with pytest.raises(ValueError, match=r"^its? "):
        FORMATS[suffix].references(data)


@pytest.mark.parametrize("whole", [{"images": 3}, {"images": [3, {"uri": 4}]}, {"buffers": {"uri": "x"}}, {}])
def test_parts_of_another_shape_name_no_files(whole: object) -> None:
    assert FORMATS["gltf"].references(json.dumps(whole).encode()) == []


_OTHERS = (b"", b"<image><init_from>", b"mtllib ", b"map_Kd -s", b"texture \xff\xfe", b"<!--" * 10**5)


@pytest.mark.parametrize("suffix", ["dae", "obj", "mtl", "material"])
@pytest.mark.parametrize("data", _OTHERS)
def test_other_bytes_do_no_harm(suffix: str, data: bytes) -> None:
    names = FORMATS[suffix].references(data)
    assert FORMATS[suffix].rewritten(data, {name: name for name in names}) == data
