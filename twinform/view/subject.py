"""What is looked at: a robot or world as a scene, what was found in it, and what a conversion makes of its parts."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from twinform.compiler.scene import Scene
from twinform.compiler.search.uris import SearchPath
from twinform.diagnostics import Diagnostic
from twinform.diagnostics.ledger import Entry
from twinform.ir import Document


@dataclass(frozen=True)
class Subject:
    """A document as it is shown. `path` is its file, beside which meshes are looked for."""

    document: Document
    scene: Scene
    path: str = ""
    search: SearchPath | None = None
    findings: tuple[Diagnostic, ...] = ()
    entries: tuple[Entry, ...] = ()

    @property
    def beside(self) -> Path | None:
        """Its file, if it is one."""
        return Path(self.path) if self.path else None

    @cached_property
    def _parts(self) -> Mapping[str, str]:
        """The links that parts of the file are about, by the paths of links and joints."""
        of_links = {link.where.path: link.name for link in self.scene.links}
        return of_links | {joint.where.path: joint.child for joint in self.scene.joints}

    def link_at(self, path: str) -> str | None:
        """The link that a place in the file is about; that which a joint moves, for one in a joint."""
        while path:
            if path in self._parts:
                return self._parts[path]
            path = path.rpartition("/")[0]
        return None
