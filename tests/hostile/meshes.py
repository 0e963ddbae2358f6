"""Mesh files that lie, name other files, or cost far more than their size: made anew each time."""

import json
import struct
import zlib
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

_XML = '<?xml version="1.0"?>'
_ROOT = '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="1"/></asset>'
_TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
Json = Mapping[str, object]


def _utf8(text: str) -> bytes:
    return text.encode()


def _collada(
    nodes: str, *, scene: str = '<instance_node url="#n"/>', points: str = "0 0 0 1 0 0 0 1 0", count: int = 9,
    indices: str = "0 1 2", triangles: int = 1, start: str = _XML, more: str = "",
) -> bytes:  # fmt: skip
    return (
        f'{start}{_ROOT}{more}<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" '
        f'count="{count}">{points}</float_array><technique_common><accessor source="#pa" count="{count // 3}" '
        'stride="3">'
        '<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>'
        '</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
        f'<triangles count="{triangles}"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles>'
        f"</mesh></geometry></library_geometries><library_nodes>{nodes}</library_nodes><library_visual_scenes>"
        f'<visual_scene id="s"><node id="r">{scene}</node></visual_scene></library_visual_scenes>'
        '<scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    ).encode()


_ONE_NODE = '<node id="n"><instance_geometry url="#g"/></node>'


def _doubling(depth: int, times: int = 2) -> str:
    """Nodes that each stand for the next one several times; the first is `n`."""
    names = ["n", *(f"n{number}" for number in range(depth))]
    nodes = [
        f'<node id="{name}">{f"""<instance_node url="#{inner}"/>""" * times}</node>' for name, inner in pairwise(names)
    ]
    return f'<node id="{names[-1]}"><instance_geometry url="#g"/></node>' + "".join(reversed(nodes))


def _nested(depth: int) -> str:
    return f'<node id="n">{"<node>" * depth}<instance_geometry url="#g"/>{"</node>" * depth}</node>'


def _long(depth: int) -> str:
    """A chain of nodes, each of which stands for the one before it."""
    chain = (f'<node id="c{number}"><instance_node url="#c{number - 1}"/></node>' for number in range(1, depth))
    first = '<node id="c0"><instance_geometry url="#g"/></node>'
    return f'{first}{"".join(chain)}<node id="n"><instance_node url="#c{depth - 1}"/></node>'


def _gltf(binary: bytes = b"", **parts: object) -> dict[str, object]:
    made: dict[str, object] = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": max(36, len(binary))}],
    }  # fmt: skip
    return {**made, **parts}


_POINTS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def _glb(binary: bytes = _POINTS, **parts: object) -> bytes:
    text = json.dumps(_gltf(binary, **parts)).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _accessor(count: float | str, **parts: object) -> Json:
    return {"componentType": 5126, "count": count, "type": "VEC3", **parts}


def _textured(image: bytes) -> bytes:
    """A GLB file with a texture on its triangle."""
    start = len(_POINTS) + 24
    return _glb(
        _POINTS + struct.pack("<6f", 0, 0, 1, 0, 0, 1) + image,
        accessors=[
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
        ],
        bufferViews=[
            {"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
            {"buffer": 0, "byteOffset": start, "byteLength": len(image)},
        ],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        textures=[{"source": 0}], images=[{"bufferView": 2, "mimeType": "image/png"}],
    )  # fmt: skip


def png(width: int, height: int) -> bytes:
    """A picture of one color and any size, of which only the first rows are there."""
    rows = zlib.compress(bytes(min((width + 1) * height, 2**22)), 9)
    chunks: Sequence[tuple[bytes, bytes]] = (
        (b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)), (b"IDAT", rows), (b"IEND", b""),
    )  # fmt: skip
    parts = [struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d)) for k, d in chunks]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def _ply(header: str, content: bytes = b"", form: str = "ascii") -> bytes:
    return f"ply\nformat {form} 1.0\n{header}end_header\n".encode() + content


_PLY_POINTS = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
_PLY_FACES = "element face 1\nproperty list uint int vertex_indices\n"
_STL_FACET = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet "
_ENTITIES = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 10))

MESHES: Mapping[str, tuple[str, Callable[[], bytes]]] = {
    "nodes that double 17 times": ("dae", lambda: _collada(_doubling(17))),
    "nodes that double 60 times": ("dae", lambda: _collada(_doubling(60))),
    "nodes a hundred times in each other": ("dae", lambda: _collada(_doubling(8, 100))),
    "a node of itself": ("dae", lambda: _collada('<node id="n"><instance_node url="#n"/></node>')),
    "two nodes of each other": (
        "dae",
        lambda: _collada('<node id="n"><instance_node url="#m"/></node><node id="m"><instance_node url="#n"/></node>'),
    ),
    "a chain of 20,000 nodes": ("dae", lambda: _collada(_long(20_000))),
    "100 nodes in each other": ("dae", lambda: _collada(_nested(100))),
    "5,000 nodes in each other": ("dae", lambda: _collada(_nested(5_000))),
    "20,000 nodes beside each other": (
        "dae", lambda: _collada(_ONE_NODE, scene='<node><instance_geometry url="#g"/></node>' * 20_000)
    ),
    "a large part 2,000 times": (
        "dae",
        lambda: _collada(
            _ONE_NODE, scene='<instance_node url="#n"/>' * 2_000, indices="0 1 2 " * 20_000, triangles=20_000
        ),
    ),
    "entities of entities": (
        "dae", lambda: _collada(_ONE_NODE, start=f'{_XML}<!DOCTYPE a [<!ENTITY e0 "0 ">{_ENTITIES}]>', points="&e9;")
    ),
    "an entity of a file": (
        "dae", lambda: _collada(_ONE_NODE, start='<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]>', points="&x;")
    ),
    "a document type in UTF-16": (
        "dae",
        lambda: _collada(_ONE_NODE, start='<!DOCTYPE a SYSTEM "file:///etc/passwd">').decode().encode("utf-16"),
    ),
    "counts that lie": ("dae", lambda: _collada(_ONE_NODE, count=2**31 - 1, triangles=2**31 - 1)),
    "points that are not there": ("dae", lambda: _collada(_ONE_NODE, indices="0 1 99999999")),
    "a number of a million digits": ("dae", lambda: _collada(_ONE_NODE, points="9" * 1_000_000 + " 0" * 8)),
    "10,000 materials": (
        "dae",
        lambda: _collada(
            _ONE_NODE,
            more="<library_effects>"
            + "".join(
                f'<effect id="e{n}"><profile_COMMON><technique sid="t"><phong><diffuse><color>1 0 0 1</color></diffuse>'
                f"</phong></technique></profile_COMMON></effect>"
                for n in range(10_000)
            )
            + "</library_effects><library_materials>"
            + "".join(f'<material id="m{n}"><instance_effect url="#e{n}"/></material>' for n in range(10_000))
            + "</library_materials>",
        ),
    ),
    "a face of 1.5 million corners": ("obj", lambda: _utf8(f"{_TRIANGLE}f{' 1 2 3' * 500_000}\n")),
    "a face of 1.5 million corners in many lines": (
        "obj", lambda: _utf8(_TRIANGLE + "f" + " 1 2 3 \\\n" * 500_000 + "\n")
    ),
    "500 faces of 900 corners": ("obj", lambda: _utf8(_TRIANGLE + f"f{' 1 2 3' * 300}\n" * 500)),
    "faces of many counts of corners": (
        "obj", lambda: _TRIANGLE.encode() + b"".join(b"f" + b" 1" * count + b"\n" for count in range(3, 999))
    ),
    "points before the first": ("obj", lambda: _utf8(f"{_TRIANGLE}f -1 -2 -99999999999999999999\n")),
    "a point of the number 2**62": ("obj", lambda: _utf8(f"{_TRIANGLE}f 1 2 {2**62}\n")),
    "points at infinity": ("obj", lambda: b"v inf 0 0\nv 1e999 0 0\nv nan 1 0\nf 1 2 3\n"),
    "100,000 groups": ("obj", lambda: _utf8(_TRIANGLE + "".join(f"o o{n}\nf 1 2 3\n" for n in range(100_000)))),
    "50,000 materials": (
        "obj", lambda: _utf8(_TRIANGLE + "".join(f"usemtl m{n}\nf 1 2 3\n" for n in range(50_000)))
    ),
    "a library that is a device": ("obj", lambda: _utf8(f"mtllib /dev/zero\nmtllib /dev/stdin\n{_TRIANGLE}f 1 2 3\n")),
    "100,000 libraries": (
        "obj", lambda: _utf8("".join(f"mtllib {n}.mtl\n" for n in range(100_000)) + f"{_TRIANGLE}f 1 2 3\n")
    ),
    "a line of 3 MB": ("obj", lambda: _utf8(f"{_TRIANGLE}# {'x' * 3_000_000}\nf 1 2 3\n")),
    "slashes": ("obj", lambda: _utf8(f"{_TRIANGLE}f {'/' * 1_000_000}\n")),
    "a count of 4 thousand million": ("stl", lambda: bytes(80) + b"\xff\xff\xff\xff" + bytes(50)),
    "text on one line": ("stl", lambda: _utf8(f"solid a {_STL_FACET * 20_000}endsolid a")),
    "text of facets without corners": ("stl", lambda: b"solid a\n" + b"facet normal 0 0 1\n" * 100_000),
    "text of vertices without facets": ("stl", lambda: b"solid a\n" + b"vertex 0 0 0\n" * 100_001),
    "words for numbers": ("stl", lambda: b"solid a\n" + _STL_FACET.replace("0", "x").encode() * 1000),
    "20,000 solids": ("stl", lambda: _utf8(f"solid a\n{_STL_FACET}\nendsolid a\n" * 20_000)),
    "not one finite number": ("stl", lambda: bytes(80) + b"\x01\0\0\0" + b"\xff" * 48 + bytes(2)),
    "numbers as large as they get": (
        "stl", lambda: bytes(80) + b"\x01\0\0\0" + struct.pack("<12f", *[3e38, -3e38, 3e38] * 4) + bytes(2)
    ),
    "a list of 4 thousand million": (
        "ply", lambda: _ply(_PLY_POINTS + _PLY_FACES, _POINTS + b"\xff" * 4 + bytes(12), "binary_little_endian")
    ),
    "10**18 points": ("ply", lambda: _ply(_PLY_POINTS.replace("3", f"{10**18}", 1) + _PLY_FACES, b"0 0 0\n")),
    "a number of points of 5,000 digits": ("ply", lambda: _ply(_PLY_POINTS.replace("3", "9" * 5000, 1) + _PLY_FACES)),
    "100,000 properties": (
        "ply", lambda: _ply("element vertex 1\n" + "".join(f"property float p{n}\n" for n in range(100_000)))
    ),
    "100,000 elements": ("ply", lambda: _ply("element vertex 1\nproperty float x\n" * 100_000)),
    "lists in text that lie": ("ply", lambda: _ply(_PLY_POINTS + _PLY_FACES, b"0 0 0\n1 0 0\n0 1 0\n4294967295 0 1\n")),
    "a face of a million corners in PLY": (
        "ply", lambda: _ply(_PLY_POINTS + _PLY_FACES, b"0 0 0\n1 0 0\n0 1 0\n1000000" + b" 0" * 1_000_000)
    ),
    "a texture of PLY elsewhere": ("ply", lambda: _ply("comment TextureFile /dev/zero\n" + _PLY_POINTS + _PLY_FACES)),
    "10**15 points in OFF": ("off", lambda: _utf8(f"OFF\n{10**15} {10**15} 0\n0 0 0\n")),
    "a face of a million corners in OFF": (
        "off", lambda: _utf8(f"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000{' 0 1 2' * 333_333}\n")
    ),
    "no counts in OFF": ("off", lambda: b"OFF\n" + b"#\n" * 300_000),
    "4 thousand million points in GLB": ("glb", lambda: _glb(accessors=[_accessor(2**32)])),
    "20 million points from nothing": ("glb", lambda: _glb(accessors=[_accessor(20_000_001)])),
    "5,000 times the same points": (
        "glb", lambda: _glb(bytes(2**20), bufferViews=[{"buffer": 0, "byteLength": 2**20}],
            accessors=[_accessor(2**20 // 12, bufferView=0)] * 5_000),
    ),
    "points that overlap": (
        "glb", lambda: _glb(bytes(2**20), bufferViews=[{"buffer": 0, "byteLength": 2**20, "byteStride": 1}],
            accessors=[_accessor(2**20 - 99, bufferView=0, type="MAT4")] * 20),
    ),
    "a stride of zero": ("glb", lambda: _glb(bufferViews=[{"buffer": 0, "byteLength": 36, "byteStride": 0}])),
    "a negative count": ("glb", lambda: _glb(accessors=[_accessor(-1, bufferView=0)])),
    "a count that is a text": ("glb", lambda: _glb(accessors=[_accessor("3", bufferView=0)])),
    "sparse points": (
        "glb", lambda: _glb(accessors=[_accessor(10_000_000, sparse={"count": 2**40, "indices": {}, "values": {}})])
    ),
    "compressed by Draco": (
        "glb", lambda: _glb(meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "extensions": {
            "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
            extensionsRequired=["KHR_draco_mesh_compression"]),
    ),
    "a node of itself in GLB": ("glb", lambda: _glb(nodes=[{"mesh": 0, "children": [0]}])),
    "nodes that double in GLB": (
        "glb", lambda: _glb(nodes=[*({"children": [n + 1, n + 1]} for n in range(40)), {"mesh": 0}])
    ),
    "100,000 nodes in GLB": (
        "glb", lambda: _glb(scenes=[{"nodes": list(range(100_000))}], nodes=[{"mesh": 0}] * 100_000)
    ),
    "300 nodes for 100,000 triangles in GLB": (
        "glb", lambda: _glb(bytes(3_600_000), bufferViews=[{"buffer": 0, "byteLength": 3_600_000}],
            accessors=[_accessor(300_000, bufferView=0)], scenes=[{"nodes": list(range(300))}],
            nodes=[{"mesh": 0}] * 300),
    ),
    "a picture of 10,000 million points": ("glb", lambda: _textured(png(100_000, 100_000))),
    "a picture of 150 million points": ("glb", lambda: _textured(png(12_247, 12_247))),
    "a buffer of 2**62 bytes": ("glb", lambda: _glb(buffers=[{"byteLength": 2**62}])),
    "lists in lists of GLB": (
        "glb", lambda: struct.pack("<4sIII4s", b"glTF", 2, 200_020, 200_000, b"JSON") + b"[" * 200_000
    ),
    "a chunk that lies": ("glb", lambda: struct.pack("<4sIII4s", b"glTF", 2, 2**31, 2**31, b"JSON") + b"{}"),
    "buffers elsewhere": (
        "gltf", lambda: _utf8(json.dumps(_gltf(buffers=[{"uri": "/dev/zero", "byteLength": 36}])))
    ),
    "buffers in the network": (
        "gltf", lambda: _utf8(json.dumps(_gltf(buffers=[{"uri": "http://localhost:1/a.bin", "byteLength": 36}])))
    ),
    "a million buffers": (
        "gltf", lambda: _utf8(json.dumps(_gltf(buffers=[{"uri": "a.bin"}] * 200_000)))
    ),
    "lists in lists of glTF": ("gltf", lambda: b'{"asset": ' + b"[" * 200_000),
    "a number of 5,000 digits in glTF": ("gltf", lambda: b'{"asset": ' + b"9" * 5000 + b"}"),
    "a data address of 8 MB": (
        "gltf",
        lambda: json.dumps(
            _gltf(buffers=[{"uri": "data:application/octet-stream;base64," + "A" * 2**23, "byteLength": 36}])
        ).encode(),
    ),
}  # fmt: skip
"""By what is wrong: the format, and what makes the bytes of the file."""
