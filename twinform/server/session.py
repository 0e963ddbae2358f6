"""A session of an editor: the open documents, and the findings in them as the editor shows them."""

import os
from collections.abc import Callable, Mapping
from pathlib import Path

from lsprotocol import types

from twinform.diagnostics import Diagnostic
from twinform.server.checking import Checked, CheckJob, SettingsOf
from twinform.server.diagnostics import as_protocol, by_file, notice
from twinform.server.documents import DocumentFiles, Documents, TextDocument
from twinform.server.includes import IncludedNeighbors
from twinform.server.scheduling import PAUSE, Checks, Worker

Publish = Callable[[types.PublishDiagnosticsParams], None]
_ADVICE = "it is not followed while you type; run `twinform check` on it, and open it again once it is smaller"


class Session:
    """The state of the server: requests get documents from it, and it checks documents as they change."""

    def __init__(self, settings_of: SettingsOf, publish: Publish, worker: Worker | None = None) -> None:
        self.documents = Documents()
        self.files = DocumentFiles(self.documents)
        self.neighbors = IncludedNeighbors(self.files)
        self.folders: list[Path] = []
        self.snippets = False
        self.found: dict[str, tuple[TextDocument, tuple[Diagnostic, ...]]] = {}
        self.settings_of = settings_of
        self._publish = publish
        self.worker = worker or Worker()
        self._checks = Checks(self.worker, self.job, self._show)
        self._shown: dict[str, dict[str, list[types.Diagnostic]]] = {}
        self._read: dict[str, frozenset[str]] = {}

    def opened(self, item: types.TextDocumentItem) -> None:
        """Follow a document that was opened."""
        document = self.documents.follow(item.uri, item.text, item.version, item.language_id)
        self._changed(document, pause=0)

    def changed(self, params: types.DidChangeTextDocumentParams) -> None:
        """Follow what was typed."""
        item = params.text_document
        document = self.documents.change(item.uri, params.content_changes, item.version)
        if document is not None:
            self._changed(document, PAUSE)

    def closed(self, uri: str) -> None:
        """Forget a document that was closed, and remove the findings of its check."""
        document = self.documents.state(uri)
        self.documents.close(uri)
        self._checks.forget(uri)
        self.found.pop(uri, None)
        self._read.pop(uri, None)
        self._publish_for(uri, {uri: []})
        if document is not None:
            self._check_includers(document)

    def stop(self) -> None:
        """End all checks and the worker."""
        self._checks.stop()
        self.worker.stop()

    def findings(self, document: TextDocument) -> tuple[Diagnostic, ...]:
        """Return the findings in this state of a document; none if it was not checked yet."""
        found = self.found.get(document.uri)
        return found[1] if found is not None and found[0] is document else ()

    def _changed(self, document: TextDocument, pause: float) -> None:
        if document.excess:
            self._checks.forget(document.uri)
            self._publish_for(document.uri, {document.uri: [notice(f"{document.excess}: {_ADVICE}")]})
        else:
            self._checks.want(document.uri, pause)
        self._check_includers(document)

    def _check_includers(self, document: TextDocument) -> None:
        """Check the documents that include a document again."""
        for uri, files in self._read.items():
            if document.is_file and uri != document.uri and str(document.path.absolute()) in files:
                self._checks.want(uri)

    def job(self, uri: str) -> CheckJob | None:
        """Return what the worker has to know of a document; None if the document is not followed."""
        document = self.documents.get(uri)
        if document is None:
            return None
        root = document.tree.root
        is_part = document.is_xacro and root is not None and root.tag == "robot" and root.get("name") is None
        return CheckJob(document.path.absolute(), self._unsaved(document), self.settings_of(document.path), is_part)

    def _unsaved(self, document: TextDocument) -> Mapping[str, bytes]:
        """Return the texts of all open files, and of a document, which may be no file."""
        files = [each for each in self.documents if each.is_file and not each.excess]
        return {os.path.realpath(each.path): each.data for each in (*files, document)}

    async def _show(self, uri: str, outcome: Checked | str) -> None:
        """Show the result of a check."""
        document = self.documents.get(uri)
        if document is None:
            return
        if isinstance(outcome, str):
            self._publish_for(uri, {uri: [notice(outcome)]})
            return
        self._read[uri] = outcome.files
        self.found[uri] = (document, outcome.diagnostics)
        made: dict[str, list[types.Diagnostic]] = {}
        for file, found in by_file(outcome.diagnostics, document.path.absolute()).items():
            of_file = document if file == document.path.absolute() else self.files.document(file)
            if of_file is not None:
                made[of_file.uri] = [as_protocol(each, of_file, self.files.document) for each in found]
        problem = self.settings_of(document.path).problem
        if problem:
            made[uri].insert(0, notice(f"the configuration cannot be used: {problem}"))
        self._publish_for(uri, made)

    def _publish_for(self, uri: str, made: dict[str, list[types.Diagnostic]]) -> None:
        """Show what the check of a document found in each file, with the findings of other documents there."""
        touched = {*made, *self._shown.get(uri, {})}
        shown = {file: found for file, found in made.items() if found}
        if shown:
            self._shown[uri] = shown
        else:
            self._shown.pop(uri, None)
        for file in sorted(touched):
            together = [each for own in self._shown.values() for each in own.get(file, ())]
            state = self.documents.state(file)
            version = state.version if state is not None else None
            self._publish(types.PublishDiagnosticsParams(file, _drop_repeats(together), version))


def _drop_repeats(found: list[types.Diagnostic]) -> list[types.Diagnostic]:
    """Drop diagnostics that repeat another one at the same place."""
    seen = {(each.range.start.line, each.range.start.character, str(each.code), each.message): each for each in found}
    return list(seen.values())
