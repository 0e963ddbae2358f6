"""A folder of meshes beside no document, as the assets that passes ask for."""

from pathlib import Path

from twinform.file_access import Readable


class MeshFolder:
    """Meshes by their names in a folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.readable = Readable.of(folder / "model.urdf")

    def find(self, uri: str) -> Path:
        return self.folder / uri

    def xml(self, path: Path, largest: int) -> bytes:
        return self.readable.read(path, largest)

    def holder(self, folder: Path, kind: str) -> str | None:
        del folder, kind
        return None

    def address(self, file: Path) -> str | None:
        del file
        return None
