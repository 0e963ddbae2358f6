"""Polygons of OBJ become the triangles that MuJoCo makes of them, and all other lines stay as they are."""

import math
import random

import pytest

from twinform.passes.mesh_jobs.obj_polygons import split_polygons

_LONG = b"v 0 0 0\nv 3 0 0\nv 4 1 0\nv 0 1 0\n"
_ARROW = b"v 2 1 0\nv 6 3 0\nv 2 5 0\nv 3 3 0\nv 2.5 2 0\n"


def _faces(text: bytes) -> list[str]:
    return [line[2:].decode() for line in text.splitlines() if line.startswith(b"f ")]


def _ring(corners: int) -> bytes:
    turns = [2 * math.pi * index / corners for index in range(corners)]
    points = "".join(f"v {math.cos(turn)} {math.sin(turn)} 0\n" for turn in turns)
    return f"{points}f {' '.join(str(index + 1) for index in range(corners))}\n".encode()


@pytest.mark.parametrize(
    ("text", "faces"),
    [
        (_LONG + b"f 1 2 3\n", ["1 2 3"]),
        (_LONG + b"f 1 2 3 4\n", ["1 2 4", "2 3 4"]),  # the shorter diagonal
        (_LONG + b"f 2 3 4 1\n", ["2 3 4", "2 4 1"]),
        (_LONG + b"f 1/1/1 2/2/1 3/3/1 4/4/1\n", ["1/1/1 2/2/1 4/4/1", "2/2/1 3/3/1 4/4/1"]),
        (_LONG + b"f -4 -3 -2 -1\nv 9 9 9\n", ["-4 -3 -1", "-3 -2 -1"]),
        (_ARROW + b"f 1 2 3 4 5\n", ["1 2 5", "2 3 4", "2 4 5"]),
    ],
)
def test_faces(text: bytes, faces: list[str]) -> None:
    assert sorted(_faces(split_polygons(text))) == sorted(faces)


@pytest.mark.parametrize(("corners", "triangles"), [(5, 3), (20, 18), (100, 98), (101, 0)])
def test_a_polygon_with_too_many_corners_is_missing(corners: int, triangles: int) -> None:
    assert len(_faces(split_polygons(_ring(corners)))) == triangles


@pytest.mark.parametrize(
    "line", [b"f 1 2 3 9", b"f 1 2 3 0", b"f 1 2 3 0x", b"f 1 2 3 \\", b"v 1 2 x\nf 1 2 3 5", b"", b"o f 1 2 3 4"]
)
def test_what_cannot_be_read_stays(line: bytes) -> None:
    assert split_polygons(_LONG + line + b"\n") == _LONG + line + b"\n"


def test_random_polygons_end() -> None:
    """Those that cross themselves have no ear at some time."""
    draw = random.Random(1)
    for corners in range(5, 60):
        points = "".join(f"v {draw.random()} {draw.random()} {draw.random()}\n" for _ in range(corners))
        text = f"{points}f {' '.join(str(index + 1) for index in range(corners))}\n".encode()
        assert len(_faces(split_polygons(text))) <= corners - 2
