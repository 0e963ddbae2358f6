"""Material libraries that an OBJ file names, and textures that such a library (MTL) names."""

import re
from collections.abc import Iterator, Mapping

from twinform.passes.mesh_references.spans import NamedSpan, encoded, names, replaced, text

_LIBRARY = re.compile(rb"^[ \t]*mtllib[ \t]+([^\r\n]*)", re.MULTILINE)
_TEXTURE = re.compile(rb"^[ \t]*(?:map_\w+|bump|disp|decal|refl|norm)[ \t]+([^\r\n]*)", re.MULTILINE | re.IGNORECASE)
_WORD = re.compile(rb"[^ \t]+")
_NUMBER = re.compile(rb"[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?")
_ARGUMENTS = {
    b"-blendu": 1, b"-blendv": 1, b"-bm": 1, b"-boost": 1, b"-cc": 1, b"-clamp": 1, b"-imfchan": 1, b"-mm": 2,
    b"-o": 3, b"-s": 3, b"-t": 3, b"-texres": 1, b"-type": 1,
}  # fmt: skip
"""Options of a texture, and how many words follow each at most."""
_UP_TO = frozenset({b"-o", b"-s", b"-t"})
"""Options that may have fewer: as many as there are numbers."""


def libraries(data: bytes) -> list[str]:
    """The MTL files of an OBJ file."""
    return names(_libraries(data))


def with_libraries(data: bytes, libraries: Mapping[str, str]) -> bytes:
    """An OBJ file with other names of MTL files."""
    return replaced(data, [(span, encoded(libraries.get(span.name, span.name))) for span in _libraries(data)])


def textures(data: bytes) -> list[str]:
    """The images of an MTL file."""
    return names(_textures(data))


def with_textures(data: bytes, textures: Mapping[str, str]) -> bytes:
    """An MTL file with other names of images."""
    return replaced(data, [(span, encoded(textures.get(span.name, span.name))) for span in _textures(data)])


def _libraries(data: bytes) -> Iterator[NamedSpan]:
    """A line may name several files, or one whose name has blanks in it, which is what programs write."""
    for line in _LIBRARY.finditer(data):
        words = [word for word in _WORD.finditer(line[1]) if word[0].lower().endswith(b".mtl")]
        several = len(words) > 1 and len(words) == len(_WORD.findall(line[1]))
        if several:
            at = line.start(1)
            yield from (NamedSpan(text(word[0]), at + word.start(), at + word.end()) for word in words)
        else:
            yield from _rest_of_line(line, 0)


def _textures(data: bytes) -> Iterator[NamedSpan]:
    for line in _TEXTURE.finditer(data):
        yield from _rest_of_line(line, _after_options(line[1]))


def _after_options(line: bytes) -> int:
    """Where the name of the file begins, which may have blanks in it."""
    at = 0
    while (word := _WORD.search(line, at)) and word[0].lower() in _ARGUMENTS:
        option, at = word[0].lower(), word.end()
        for _ in range(_ARGUMENTS[option]):
            argument = _WORD.search(line, at)
            if argument is None or (option in _UP_TO and not _NUMBER.fullmatch(argument[0])):
                break
            at = argument.end()
    return at


def _rest_of_line(line: re.Match[bytes], start: int) -> Iterator[NamedSpan]:
    written = line[1][start:].strip()
    if written:
        at = line.start(1) + line[1].index(written, start)
        yield NamedSpan(text(written), at, at + len(written))
