"""Where files come from: the package or model that each lies in, by which it is named and held inside."""

from dataclasses import dataclass, field
from pathlib import Path

from twinform.compiler.search.search_roots import folders_around
from twinform.compiler.search.uris import LocalAssets

HIGHEST = 8
"""So many folders up a package or model is looked for."""


@dataclass(frozen=True, slots=True)
class Origins:
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

    def is_inside(self, real: Path, by: Path) -> bool:
        """Whether a file may be read because another one leads to it.

        It lies in the same package or model, in a folder that was named, in the folders of the document and of what
        that names, or in some other package.
        """
        search = self.assets.search
        roots = [*search.own, *search.models, *search.packages, *search.workspaces, *search.fuel]
        holder = self._holder(by.parent)
        roots += [holder[0]] if holder else [by.parent]
        roots += [around for around in folders_around(self.assets.beside) if by.is_relative_to(around)][:1]
        return any(real.is_relative_to(root.resolve()) for root in roots) or self._holder(real.parent) is not None

    def _holder(self, folder: Path) -> tuple[Path, str] | None:
        """The nearest folder around that has a package.xml or model.config, and its name."""
        for around in (folder, *folder.parents)[:HIGHEST]:
            if around not in self._known:
                name = self.assets.holder(around, "package") or self.assets.holder(around, "model")
                self._known[around] = (around, name) if name else None
            if self._known[around] is not None:
                return self._known[around]
        return None
