"""Files that passes have made and nobody has written yet, such as simpler meshes: they keep their paths."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from posixpath import dirname, join, normpath
from typing import Self

from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.file_kinds import suffix_of
from twinform.diagnostics import SideFile
from twinform.passes.mesh_references import FORMATS


@dataclass(frozen=True, slots=True)
class MadeFiles:
    """The files by their paths below the folder of the result."""

    files: Mapping[str, bytes]

    @classmethod
    def of(cls, side_files: Iterable[SideFile]) -> Self:
        """Collect the files that passes have put into a diagnostic sink."""
        return cls({path: data if isinstance(data, bytes) else data.encode() for path, data, *_ in side_files})

    def named(self, uri: str) -> str | None:
        """The file that a URI of some scheme ends with; None where no pass has made it."""
        return next((path for path in self.files if uri == path or uri.endswith(f"/{path}")), None)

    def put(self, path: str, collection: Collection) -> str:
        """Put a file into the package, and those that it names; gives its place, which is its path.

        Raises:
            UncollectedError: another file is in its place.
        """
        waiting = [path]
        done: set[str] = set()
        while waiting:
            one = waiting.pop()
            if one not in done:
                done.add(one)
                collection.put(one, self.files[one])
                waiting += self._named(one)
        return path

    def _named(self, path: str) -> list[str]:
        format_ = FORMATS.get(suffix_of(path))
        names = format_.references(self.files[path]) if format_ else []
        return [inner for name in names if (inner := normpath(join(dirname(path), name))) in self.files]
