"""Texts of files that documents name: those of the editor, else those on the disk, which are kept until they change."""

from pathlib import Path

from twinform.file_access import Readable
from twinform.server.documents import Documents, TextDocument, excess_of
from twinform.server.editor_uris import uri_of
from twinform.server.settings import LARGEST
from twinform.text import SourceText, UndecodableError

_MOST = 500
"""So many files are kept."""


class DocumentFiles:
    """Documents by their files, whether they are open or not."""

    def __init__(self, documents: Documents) -> None:
        self._documents = documents
        self._read: dict[Path, tuple[tuple[int, int], TextDocument]] = {}

    def document(self, path: Path) -> TextDocument | None:
        """The document of a file; None for one that cannot be read, is no text, or is too large."""
        found = self._documents.of_path(path)
        return found if found is not None else self._on_disk(path)

    def _on_disk(self, path: Path) -> TextDocument | None:
        try:
            status = path.stat()
            state = (status.st_mtime_ns, status.st_size)
            if path in self._read and self._read[path][0] == state:
                return self._read[path][1]
            if status.st_size > LARGEST:
                return None
            text = SourceText.of(Readable.of(path).read(path, LARGEST)).text
        except (OSError, ValueError, UndecodableError):
            return None
        if excess_of(text):
            return None
        if len(self._read) >= _MOST:
            self._read.clear()
        document = TextDocument(uri_of(path), text, encoding=self._documents.encoding)
        self._read[path] = (state, document)
        return document
