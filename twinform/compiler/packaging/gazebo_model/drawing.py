"""Draws colored triangles without perspective: samples of each go into a depth buffer, and Pillow makes the PNG."""

import importlib
import io
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

_SIZE = 512
"""Pixels along each side of the picture."""
_FINER = 2
"""So many samples are drawn along each side of a pixel, and averaged."""
_MARGIN = 0.06
_BEHIND = (245, 246, 248)
_AMBIENT, _LIGHT = 0.45, 0.55
_FORWARD, _UP = (-0.75, 0.5, -0.43), (0.0, 0.0, 1.0)
"""Where the camera looks, x of the model being its front."""
_TO_LAMP = (0.6, -0.35, 0.72)
_MOST_SAMPLES = 2**20
"""So many points are worked on at once, which bounds the memory."""
_MOST_DRAWN = 2**24
"""Points of a picture, sixteen for each that is seen: triangles that all cover it would take for ever."""
_LEVELS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048)
"""How many steps a triangle is sampled in, along it and across."""

_Array = Any
"""A `numpy.ndarray`."""


class UndrawableError(ValueError):
    """Why there is no picture of some triangles."""


class Faces(NamedTuple):
    """Triangles of one color: an array of n by 3 corners by 3 coordinates."""

    points: _Array
    color: tuple[float, float, float]


def picture(faces: Sequence[Faces]) -> bytes:
    """The triangles as a PNG that shows all of them.

    Raises:
        ImportError: the extra is not installed.
        UndrawableError: the triangles hide each other many times.
    """
    # Gazebo's own thumbnails need Gazebo and a GPU, and light rendering libraries need OpenGL. A
    # picture of 512 pixels needs a depth buffer: triangles are sampled as finely as the pixels, and
    # numpy sorts the samples. The same model gives the same bytes.
    numpy: Any = importlib.import_module("numpy")
    image: Any = importlib.import_module("PIL.Image")
    side = _SIZE * _FINER
    corners = _on_screen(numpy, numpy.concatenate([each.points for each in faces]), side)
    colors = numpy.concatenate([_shaded(numpy, each) for each in faces])
    depth = numpy.full(side * side, -numpy.inf)
    canvas = numpy.tile(numpy.array(_BEHIND, dtype=numpy.uint8), (side * side, 1))
    for points, which in _samples(numpy, corners):
        column, row = (numpy.clip(points[:, axis].astype(int), 0, side - 1) for axis in (0, 1))
        place = row * side + column
        nearest = numpy.lexsort((points[:, 2], place))
        last = numpy.append(place[nearest][1:] != place[nearest][:-1], True)
        front = nearest[last]
        front = front[points[front, 2] > depth[place[front]]]
        depth[place[front]] = points[front, 2]
        canvas[place[front]] = colors[which[front]]
    shown = image.fromarray(canvas.reshape(side, side, 3)).resize((_SIZE, _SIZE), image.Resampling.BOX)
    out = io.BytesIO()
    shown.save(out, "PNG", optimize=True)
    return out.getvalue()


def _on_screen(numpy: Any, points: _Array, side: int) -> _Array:
    """The corners as columns, rows and nearness, so that all are in the picture."""
    forward = numpy.array(_FORWARD) / numpy.linalg.norm(_FORWARD)
    right = numpy.cross(forward, _UP)
    right = right / numpy.linalg.norm(right)
    axes = numpy.stack([right, -numpy.cross(right, forward), -forward])
    seen = points @ axes.T
    least, most = seen.min(axis=(0, 1)), seen.max(axis=(0, 1))
    extent = max(float((most - least)[:2].max()), 1e-12)
    return (seen - (least + most) / 2) * (side * (1 - 2 * _MARGIN) / extent) + (side / 2, side / 2, 0)


def _shaded(numpy: Any, faces: Faces) -> _Array:
    """The color of each triangle in the light, as bytes; both of its sides are lit alike."""
    normals = numpy.cross(faces.points[:, 1] - faces.points[:, 0], faces.points[:, 2] - faces.points[:, 0])
    lengths = numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)
    lamp = numpy.array(_TO_LAMP) / numpy.linalg.norm(_TO_LAMP)
    lit = _AMBIENT + _LIGHT * numpy.abs(normals @ lamp) / lengths
    return numpy.clip(255 * lit[:, None] * numpy.clip(faces.color, 0, 1), 0, 255).astype(numpy.uint8)


def _samples(numpy: Any, corners: _Array) -> Iterator[tuple[_Array, _Array]]:
    """Points of the triangles, at least one for each pixel that these cover, and the triangle that each is of.

    They lie in rows along the longest side, as many as the triangle is high, so that one that is long and thin, as
    many are, has few. Triangles with about as many go together.
    """
    sides = numpy.linalg.norm((numpy.roll(corners, -1, axis=1) - corners)[:, :, :2], axis=2)
    first = sides.argmax(axis=1)
    each = numpy.arange(len(corners))
    a, b, c = (corners[each, (first + step) % 3] for step in range(3))
    length = sides[each, first]
    doubled = numpy.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    height = doubled / numpy.maximum(length, 1e-12)
    levels = numpy.array(_LEVELS)
    along, across = (numpy.searchsorted(levels, 1.25 * extent) for extent in (length, height))
    if int(((levels[along] + 1) * (levels[across] + 1)).sum()) > _MOST_DRAWN:
        raise UndrawableError("too many triangles lie behind each other")
    for group in numpy.unique(along * len(_LEVELS) + across):
        which = numpy.flatnonzero(along * len(_LEVELS) + across == group)
        columns, rows = levels[group // len(_LEVELS)], levels[group % len(_LEVELS)]
        grid = numpy.meshgrid(numpy.linspace(0, 1, columns + 1), numpy.linspace(0, 1, rows + 1))
        s, t = (values.ravel() for values in grid)
        weights = numpy.stack([(1 - t) * (1 - s), (1 - t) * s, t], axis=1)
        at_once = max(1, _MOST_SAMPLES // len(weights))
        for start in range(0, len(which), at_once):
            some = which[start : start + at_once]
            points = numpy.einsum("sc,ctx->tsx", weights, numpy.stack([a[some], b[some], c[some]])).reshape(-1, 3)
            yield points, numpy.repeat(some, len(weights))
