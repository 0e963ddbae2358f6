"""Which files of a folder are models: by their names, and where these leave it open, by a look."""

from pathlib import Path
from typing import Protocol

XACRO = ".xacro"
_MODELS = (".urdf", ".sdf", ".world")
_JSON_MARK = b"urn:twinform:document:"
_ENOUGH = 2**12
"""Bytes of a JSON document that has the mark of ours, if it is ours."""
# Bytes of a xacro file that is looked into; a larger one counts as a model and is refused when it
# is read.
_LARGEST = 2**24
_DEFINITIONS = frozenset({"arg", "include", "macro", "property", "insert_block"})
"""Elements of xacro that make no part of a robot by themselves."""
_SHARED = frozenset({"material", "xacro:if", "xacro:unless"})
"""What files of definitions have as well."""


class FileKind(Protocol):
    """Whether a file of a folder is meant; `named` means that a pattern was given for its kind of names."""

    def __call__(self, path: Path, /, *, named: bool = False) -> bool:
        """Look at the name, and at the file where that leaves it open."""
        ...


def is_model(path: Path, *, named: bool = False) -> bool:
    """Whether a file is a model.

    Not to be read is no reason to leave it out: whoever reads it says so.
    """
    name = path.name.lower()
    if name.endswith(XACRO):
        return _is_xacro_model(path)
    if name.endswith(".json"):
        return _JSON_MARK in _start(path, _ENOUGH)
    return named or name.endswith(_MODELS)


def is_text(path: Path, *, named: bool = False) -> bool:
    """Whether a file is laid out as XML: a model, or a file of macros."""
    return named or path.name.lower().endswith((*_MODELS, XACRO))


def is_plain(path: Path, *, named: bool = False) -> bool:
    """Whether a file is a model whose text is read as it stands, without xacro."""
    return is_text(path, named=named) and not path.name.lower().endswith((XACRO, ".json"))


def _start(path: Path, size: int) -> bytes:
    from twinform.file_access import Readable  # noqa: PLC0415 - few names leave it open

    try:
        return Readable.of(path).read(path, size)
    except (OSError, ValueError):
        return b""


def _is_xacro_model(path: Path) -> bool:
    """Whether a xacro file makes a robot, and does not only define macros for others.

    The root has a name, and parts of a robot in it, or nothing but includes. Held to 386 files of public repositories:
    every one that expands to a robot is found so, and nothing that only defines.
    """
    from twinform.text import SourceText, UndecodableError, UnplacedError, spans  # noqa: PLC0415 - as above

    data = _start(path, _LARGEST)
    if not data and path.is_symlink():
        return True  # whoever reads it says why it is not followed
    try:
        text = SourceText.of(data).text
        root = spans(text)
    except (UndecodableError, UnplacedError):
        return bool(data.strip()) or not path.is_file()
    if root.name.of(text) == "sdf":
        return True
    names = {child.name.of(text) for child in root.children}
    parts = {name for name in names if name.removeprefix("xacro:") not in _DEFINITIONS}
    assembles = "xacro:include" in names and "xacro:macro" not in names
    return root.name.of(text) == "robot" and "name" in root.attributes and (assembles or not parts <= _SHARED)
