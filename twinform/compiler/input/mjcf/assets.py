"""Assets of canonical MJCF: meshes, height fields, textures and materials by their names."""

from collections.abc import Iterable
from pathlib import PurePosixPath

from twinform.compiler.input.mjcf.pieces import Piece

_KINDS = ("mesh", "hfield", "texture", "material", "skin", "model")


class AssetTable:
    """The assets of a file; each kind has its own names."""

    def __init__(self, sections: Iterable[Piece]) -> None:
        self.pieces = tuple(each for section in sections for each in section.inside)
        self._by_name: dict[tuple[str, str], Piece] = {}
        for each in self.pieces:
            name = asset_name(each)
            if name is not None:
                self._by_name.setdefault((each.tag, name), each)

    def find(self, kind: str, name: str | None) -> Piece | None:
        """Return the asset of a kind that a name means."""
        return None if name is None else self._by_name.get((kind, name))


def asset_name(piece: Piece) -> str | None:
    """Return the name of an asset: the written one, or that of its file without the suffix."""
    return piece.name or file_stem(piece)


def file_stem(piece: Piece) -> str | None:
    """Return the name that the file of an asset gives it."""
    file = piece.peek("file")
    return PurePosixPath(file.replace("\\", "/")).stem if file else None
