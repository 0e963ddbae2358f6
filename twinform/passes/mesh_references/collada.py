"""Images that a COLLADA file names: `<image><init_from>`, and `<ref>` in it since COLLADA 1.5."""

import re
from collections.abc import Iterator, Mapping
from xml.sax.saxutils import escape, unescape

from twinform.passes.mesh_references.spans import NamedSpan, names, replaced

_TOKEN = re.compile(
    rb"(?P<comment><!--)|(?P<after>-->)|(?P<image><(?:\w+:)?image[\s>])|(?P<close></(?:\w+:)?image\s*>)"
    rb"|<(?:\w+:)?(?:init_from|ref)(?:\s[^<>]*)?>(?P<name>[^<]*)"
)
_QUOTES = {"&quot;": '"', "&apos;": "'"}


def references(data: bytes) -> list[str]:
    """The images of a file; `<init_from>` outside of an image names something in the file itself."""
    return names(_spans(data))


def rewritten(data: bytes, images: Mapping[str, str]) -> bytes:
    """The file with other names of images."""
    return replaced(data, [(span, escape(images.get(span.name, span.name)).encode()) for span in _spans(data)])


def _spans(data: bytes) -> Iterator[NamedSpan]:
    in_comment = in_image = False
    for token in _TOKEN.finditer(data):
        if in_comment or token["comment"]:
            in_comment = not token["after"]
        elif token["image"] or token["close"]:
            in_image = bool(token["image"])
        elif in_image and token["name"] is not None and token["name"].strip():
            written = token["name"].strip()
            start = token.start("name") + token["name"].find(written)
            name = unescape(written.decode("utf-8", "replace"), _QUOTES)
            yield NamedSpan(name, start, start + len(written))
