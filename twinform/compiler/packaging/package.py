"""`Package`: the files of a package before they are written, by their paths in it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from types import MappingProxyType

Content = bytes | Path
"""What is in a file: bytes, or those of another file."""


@dataclass(frozen=True, slots=True)
class Package:
    """What a package is called, and its files: paths with `/`, sorted, none of which leaves the folder.

    Raises:
        ValueError: a path leaves the folder, is below a file, or two are one file where capitals do not count.
    """

    name: str
    files: Mapping[str, Content]

    def __post_init__(self) -> None:
        seen: dict[str, str] = {}
        for path in self.files:
            if not is_inner_path(path):
                raise ValueError(f"{path!r} is no path in a package")
            other = seen.setdefault(path.casefold(), path)
            if other != path:
                raise ValueError(f"{path!r} and {other!r} are one file where capitals do not count")
        for path in self.files:
            if any(str(folder).casefold() in seen for folder in PurePosixPath(path).parents):
                raise ValueError(f"{path!r} is below a file")
        object.__setattr__(self, "files", MappingProxyType(dict(sorted(self.files.items()))))

    @property
    def folders(self) -> tuple[str, ...]:
        """The folders directly in it, sorted."""
        return tuple(sorted({path.partition("/")[0] for path in self.files if "/" in path}))

    def below(self, folder: str) -> Iterator[str]:
        """The paths in one of its folders."""
        return (path for path in self.files if path.startswith(f"{folder}/"))


def is_inner_path(path: str) -> bool:
    """Whether a path stays in the folder that it is relative to, as far as there are no links."""
    parts = path.split("/")
    return all(parts) and not {".", ".."}.intersection(parts) and "\\" not in path and "\0" not in path
