"""File references inside meshes and material scripts: COLLADA images, OBJ and MTL, glTF buffers, OGRE textures.

Where a name can be found in the bytes without parsing the file, its span is replaced and all other bytes stay. Only
glTF is parsed, and written again as JSON.
"""

import json
import os
import re
import struct
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple, cast
from urllib.parse import quote, unquote
from xml.sax.saxutils import escape, unescape

from twinform.lazy import lazy_pattern

Names = Mapping[str, str]
"""From the name of a file as it is written to the one that is to stand there."""


class ReferenceFormat(NamedTuple):
    """How to list the files that a file of one format names, and how to rename them in it.

    `by_name`: programs look for the bare name in folders that they know.
    """

    references: Callable[[bytes], list[str]]
    rewritten: Callable[[bytes, Names], bytes]
    by_name: bool = False


class NamedSpan(NamedTuple):
    """The name of a file, unescaped, and where it is written."""

    name: str
    start: int
    end: int


# Bytes that are not UTF-8 survive the way to a name and back as surrogates, as in file names.
def _format_of_spans(
    find: Callable[[bytes], Iterable[NamedSpan]],
    encode: Callable[[str], bytes] = os.fsencode,
    *,
    by_name: bool = False,
) -> ReferenceFormat:
    """The format whose names a function finds; the spans must be in order and not overlap."""

    def references(data: bytes) -> list[str]:
        return list(dict.fromkeys(span.name for span in find(data)))

    def rewritten(data: bytes, names: Names) -> bytes:
        parts: list[bytes] = []
        end = 0
        for span in find(data):
            parts += (data[end : span.start], encode(names.get(span.name, span.name)))
            end = span.end
        return b"".join((*parts, data[end:]))

    return ReferenceFormat(references, rewritten, by_name)


_COLLADA_TOKEN = lazy_pattern(
    rb"(?P<comment><!--)|(?P<after>-->)|(?P<image><(?:\w+:)?image[\s>])|(?P<close></(?:\w+:)?image\s*>)"
    rb"|<(?:\w+:)?(?:init_from|ref)(?:\s[^<>]*)?>(?P<name>[^<]*)"
)
_XML_QUOTES = {"&quot;": '"', "&apos;": "'"}


def _escape_xml(name: str) -> bytes:
    return escape(name).encode()


def _find_collada_images(data: bytes) -> Iterator[NamedSpan]:
    """Find the images of a COLLADA file: `<image><init_from>`, and `<ref>` inside that since COLLADA 1.5."""
    # <init_from> outside of an image names something in the same file
    in_comment = in_image = False
    for token in _COLLADA_TOKEN.finditer(data):
        if in_comment or token["comment"]:
            in_comment = not token["after"]
        elif token["image"] or token["close"]:
            in_image = bool(token["image"])
        elif in_image and token["name"] is not None and token["name"].strip():
            written = token["name"].strip()
            start = token.start("name") + token["name"].find(written)
            name = unescape(written.decode("utf-8", "replace"), _XML_QUOTES)
            yield NamedSpan(name, start, start + len(written))


_OBJ_LIBRARY = lazy_pattern(rb"^[ \t]*mtllib[ \t]+([^\r\n]*)", re.MULTILINE)
_MTL_TEXTURE = lazy_pattern(
    rb"^[ \t]*(?:map_\w+|bump|disp|decal|refl|norm)[ \t]+([^\r\n]*)", re.MULTILINE | re.IGNORECASE
)
_WORD = lazy_pattern(rb"[^ \t]+")
_NUMBER = lazy_pattern(rb"[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?")
_OPTION_WORDS = {
    b"-blendu": 1, b"-blendv": 1, b"-bm": 1, b"-boost": 1, b"-cc": 1, b"-clamp": 1, b"-imfchan": 1, b"-mm": 2,
    b"-o": 3, b"-s": 3, b"-t": 3, b"-texres": 1, b"-type": 1,
}  # fmt: skip
"""How many words may follow each option of a texture."""
_NUMERIC_OPTIONS = frozenset({b"-o", b"-s", b"-t"})
"""Options that are followed by fewer words where these are not numbers."""


def _find_material_libraries(data: bytes) -> Iterator[NamedSpan]:
    """Find the MTL files of an OBJ file: several in a line, or one whose name has blanks in it, as programs write."""
    for line in _OBJ_LIBRARY.finditer(data):
        words = [word for word in _WORD.finditer(line[1]) if word[0].lower().endswith(b".mtl")]
        several = len(words) > 1 and len(words) == len(_WORD.findall(line[1]))
        if several:
            at = line.start(1)
            yield from (NamedSpan(os.fsdecode(word[0]), at + word.start(), at + word.end()) for word in words)
        else:
            yield from _span_of_rest(line, 0)


def _find_mtl_textures(data: bytes) -> Iterator[NamedSpan]:
    """Find the images of an MTL file."""
    for line in _MTL_TEXTURE.finditer(data):
        yield from _span_of_rest(line, _skip_options(line[1]))


def _skip_options(line: bytes) -> int:
    """Where in a line the name of the file begins, which may have blanks in it."""
    at = 0
    while (word := _WORD.search(line, at)) and word[0].lower() in _OPTION_WORDS:
        option, at = word[0].lower(), word.end()
        for _ in range(_OPTION_WORDS[option]):
            argument = _WORD.search(line, at)
            if argument is None or (option in _NUMERIC_OPTIONS and not _NUMBER.fullmatch(argument[0])):
                break
            at = argument.end()
    return at


def _span_of_rest(line: re.Match[bytes], start: int) -> Iterator[NamedSpan]:
    """The span of all that follows in a line, without blanks around it; none where nothing follows."""
    written = line[1][start:].strip()
    if written:
        at = line.start(1) + line[1].index(written, start)
        yield NamedSpan(os.fsdecode(written), at, at + len(written))


_OGRE_TEXTURE = lazy_pattern(
    rb"^[ \t]*(?:texture|cubic_texture|anim_texture)[ \t]+(\"[^\"\r\n]*\"|[^\s\"{}]+)", re.MULTILINE
)


def _find_ogre_textures(data: bytes) -> Iterator[NamedSpan]:
    """Find the textures of a material script of Gazebo Classic (OGRE)."""
    for line in _OGRE_TEXTURE.finditer(data):
        quoted = line[1].startswith(b'"')
        start, end = line.start(1) + quoted, line.end(1) - quoted
        yield NamedSpan(os.fsdecode(data[start:end]), start, end)


_GLB_HEADER = struct.Struct("<4sII")
_GLB_CHUNK = struct.Struct("<I4s")
_EMBEDDED = "data:"
"""How a URI begins whose data stands in the file itself."""


def _gltf_references(data: bytes) -> list[str]:
    """The files that a glTF file names; ValueError where it is no glTF file."""
    return list(dict.fromkeys(unquote(part["uri"]) for part in _external_entries(_load_gltf(data))))


def _rewritten_gltf(data: bytes, files: Mapping[str, str]) -> bytes:
    """The glTF file with its files renamed."""
    whole = _load_gltf(data)
    for part in _external_entries(whole):
        name = unquote(part["uri"])
        part["uri"] = quote(files.get(name, name))
    return json.dumps(whole, ensure_ascii=False, separators=(",", ":")).encode()


def _glb_references(data: bytes) -> list[str]:
    """The files that a GLB file names, which is none for most; ValueError where it is no GLB file."""
    return _gltf_references(_json_chunk(data)[0])


def _rewritten_glb(data: bytes, files: Mapping[str, str]) -> bytes:
    """The GLB file with its files renamed."""
    content, end = _json_chunk(data)
    new = _rewritten_gltf(content, files)
    new += b" " * (-len(new) % 4)
    chunk = _GLB_CHUNK.pack(len(new), b"JSON") + new
    magic, version, _ = _GLB_HEADER.unpack_from(data)
    return _GLB_HEADER.pack(magic, version, _GLB_HEADER.size + len(chunk) + len(data) - end) + chunk + data[end:]


def _json_chunk(data: bytes) -> tuple[bytes, int]:
    """The JSON of a GLB file, and the offset at which it ends."""
    start = _GLB_HEADER.size + _GLB_CHUNK.size
    if len(data) < start or data[:4] != b"glTF":
        raise ValueError("it does not begin as a GLB file does")
    length, kind = _GLB_CHUNK.unpack_from(data, _GLB_HEADER.size)
    if kind != b"JSON" or start + length > len(data):
        raise ValueError("its first part is no JSON")
    return data[start : start + length], start + length


def _load_gltf(data: bytes) -> dict[str, Any]:
    """Parse the JSON of a glTF file.

    Raises:
        ValueError: it is no glTF file.
    """
    try:
        whole: object = json.loads(data)
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
        raise ValueError(f"it is no glTF file: {error}") from error
    if not isinstance(whole, dict):
        raise ValueError("it is no glTF file: it has no object")  # noqa: TRY004 - the file is wrong, not a type of ours
    return cast("dict[str, Any]", whole)


def _external_entries(whole: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The JSON objects of the buffers and images that are files of their own."""
    for name in ("buffers", "images"):
        found = whole.get(name)
        for part in cast("list[object]", found) if isinstance(found, list) else ():
            if isinstance(part, dict):
                entry = cast("dict[str, Any]", part)
                if isinstance(entry.get("uri"), str) and not entry["uri"].startswith(_EMBEDDED):
                    yield entry


FORMATS: Mapping[str, ReferenceFormat] = {
    "dae": _format_of_spans(_find_collada_images, _escape_xml),
    "obj": _format_of_spans(_find_material_libraries),
    "mtl": _format_of_spans(_find_mtl_textures),
    "gltf": ReferenceFormat(_gltf_references, _rewritten_gltf),
    "glb": ReferenceFormat(_glb_references, _rewritten_glb),
    "material": _format_of_spans(_find_ogre_textures, by_name=True),
}
"""By the suffix of a file; all other formats name no files, or none that is known here."""
