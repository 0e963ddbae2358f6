"""Relative paths of an included model, rewritten relative to the including file."""

import re
from posixpath import normpath

from twinform.ir import Document
from twinform.passes.transforms.document_uris import map_uris

_ABSOLUTE = re.compile(r"[A-Za-z][\w+.-]*:|/|__")
"""A scheme, a path from the root, or a name such as `__default__`."""

_HERE = frozenset({"", "."})


def relocate(document: Document, folder: str) -> Document:
    """The document with relative paths that lead to the same files from where its folder is called `folder`."""
    if folder in _HERE:
        return document
    return map_uris(document, lambda path, _kind, _where: relocated(path, folder) or path)


def relocated(path: str | None, folder: str) -> str | None:
    """One path; what is absolute, a URI or empty stays."""
    if not path or not path.strip() or _ABSOLUTE.match(path.strip()) or folder in _HERE:
        return path
    # `model://arm` and `meshes/a.dae` are `model://arm/meshes/a.dae`; without taking the scheme
    # apart, normpath would make one slash of two.
    scheme, separator, rest = folder.rpartition("://")
    return f"{scheme}{separator}{normpath(f'{rest}/{path.strip()}')}"
