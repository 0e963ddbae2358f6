"""The text of a model with a small box in place of each mesh, for readers that have no meshes beside it.

The text is changed and not the tree, so that what is broken stays broken.
"""

import re

_ATTRIBUTES = rb"""(?:[^<>"']|"[^"<]*"|'[^'<]*')*?"""
_REST = rb"(?:/>|>(?P<inside>(?:(?!<mesh[\s/>]).)*?)</mesh\s*>)"
_MESH = re.compile(rb"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<mesh(?=[\s/>])" + _ATTRIBUTES + _REST, re.DOTALL)
_DEEPEST = 4
"""Meshes in meshes, which are there in broken files."""
_URDF = b'<box size="0.1 0.1 0.1"/>'
_SDF = b"<box><size>0.1 0.1 0.1</size></box>"


def without_meshes(text: bytes) -> bytes:
    """The text with boxes of 0.1 m for meshes; what is in comments stays."""
    for _ in range(_DEEPEST):
        changed = _MESH.sub(_boxed, text)
        if changed == text:
            break
        text = changed
    return text


def _boxed(found: re.Match[bytes]) -> bytes:
    if found[0].startswith(b"<!"):
        return found[0]
    # a mesh of SDF has its URI in an element; lines stay where they are
    box = _SDF if b"<uri" in (found["inside"] or b"") else _URDF
    return box + b"\n" * found[0].count(b"\n")
