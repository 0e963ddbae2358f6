"""Textures that a material script of Gazebo Classic (OGRE) names, by their bare names."""

import re
from collections.abc import Iterator, Mapping

from twinform.passes.mesh_references.spans import NamedSpan, encoded, names, replaced, text

_TEXTURE = re.compile(rb"^[ \t]*(?:texture|cubic_texture|anim_texture)[ \t]+(\"[^\"\r\n]*\"|[^\s\"{}]+)", re.MULTILINE)


def references(data: bytes) -> list[str]:
    """The images of a script."""
    return names(_spans(data))


def rewritten(data: bytes, images: Mapping[str, str]) -> bytes:
    """A script with other names of images."""
    return replaced(data, [(span, encoded(images.get(span.name, span.name))) for span in _spans(data)])


def _spans(data: bytes) -> Iterator[NamedSpan]:
    for line in _TEXTURE.finditer(data):
        quoted = line[1].startswith(b'"')
        start, end = line.start(1) + quoted, line.end(1) - quoted
        yield NamedSpan(text(data[start:end]), start, end)
