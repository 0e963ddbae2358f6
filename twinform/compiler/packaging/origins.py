"""Where files come from: the package or model that each lies in, by which it is named and held inside."""

from dataclasses import dataclass, field
from pathlib import Path

from twinform.compiler.search.resolve_uris import LocalAssets

HIGHEST = 8
"""So many folders up a package or model is looked for."""


@dataclass(frozen=True, slots=True)
class FileOrigins:
    """The packages and models around files that a document names."""

    assets: LocalAssets
    _known: dict[Path, tuple[Path, str] | None] = field(default_factory=dict[Path, tuple[Path, str] | None])

    def place(self, file: Path) -> tuple[str, tuple[str, ...]]:
        """The package or model that a file lies in, by its name, and the path in it; empty where it lies in none."""
        holder = self._holder(file.parent)
        if holder is not None:
            folder, name = holder
            return name, file.relative_to(folder).parts
        own = self.assets.folder
        if own is not None and file.is_relative_to(own) and ".." not in file.relative_to(own).parts:
            return "", file.relative_to(own).parts
        return "", (file.name,)

    def _holder(self, folder: Path) -> tuple[Path, str] | None:
        """The nearest folder around that has a package.xml or model.config, and its name."""
        for around in (folder, *folder.parents)[:HIGHEST]:
            if around not in self._known:
                name = self.assets.holder(around, "package") or self.assets.holder(around, "model")
                self._known[around] = (around, name) if name else None
            if self._known[around] is not None:
                return self._known[around]
        return None
