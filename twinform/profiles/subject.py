"""`Subject`: a file that is held against profiles."""

from dataclasses import dataclass, field

from twinform.diagnostics import Diagnostic
from twinform.ir import Document, Format
from twinform.passes import NO_ASSETS, AssetError, Assets
from twinform.schemas import XmlElement


@dataclass(frozen=True, slots=True)
class ProfiledFile:
    """A file before consumers: its bytes, tree and document as far as it has them, and what `check` finds in it."""

    path: str
    format: Format | None
    document: Document | None = None
    tree: XmlElement | None = None
    content: bytes | None = field(default=None, repr=False)
    diagnostics: tuple[Diagnostic, ...] = ()
    assets: Assets = field(default=NO_ASSETS, compare=False, repr=False)

    def has_file(self, uri: str) -> bool:
        """Whether a URI leads to a file."""
        try:
            return self.assets.find(uri).is_file()
        except AssetError:
            return False
