"""A session of an editor: the open documents, the findings in them, and when they are checked.

A document is checked once nothing was typed for a moment, in the worker's process. If the text changes during a check,
the check goes on, since a new process would take longer, and its findings are dropped. A check that takes too long is
ended with its process.
"""

import asyncio
import os
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import replace
from pathlib import Path

from lsprotocol import types

from twinform.diagnostics import Diagnostic
from twinform.server.checking import Checked, CheckJob, EditorSettings, SettingsOf, check, robots_among
from twinform.server.diagnostics import as_protocol, by_file, notice
from twinform.server.documents import DocumentFiles, Documents, TextDocument
from twinform.server.editor_options import EditorOptions
from twinform.server.includes import ENDINGS, IncludedNeighbors, files_below
from twinform.server.locations import file_of, uri_of
from twinform.server.worker import TaskError, Worker

PAUSE = 0.15
"""Seconds without a key after which a document is checked."""
JobOf = Callable[[str], CheckJob | None]
Show = Callable[[str, "Checked | str"], Awaitable[None]]
"""Shows the result of checking a document: the findings, or why there are none."""


class Checks:
    """The checks that are waiting or running, at most one for each document."""

    def __init__(self, worker: Worker, job_of: JobOf, show: Show) -> None:
        self._worker, self._job_of, self._show = worker, job_of, show
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._wanted: dict[str, int] = {}
        self._due: dict[str, float] = {}

    def want(self, uri: str, pause: float = PAUSE) -> None:
        """Check a document after a pause without typing."""
        loop = asyncio.get_running_loop()
        self._wanted[uri] = self._wanted.get(uri, 0) + 1
        self._due[uri] = loop.time() + pause
        if uri not in self._tasks:
            self._tasks[uri] = loop.create_task(self._run(uri))

    def forget(self, uri: str) -> None:
        """Cancel the check of a document."""
        self._wanted.pop(uri, None)
        self._due.pop(uri, None)
        task = self._tasks.pop(uri, None)
        if task is not None:
            task.cancel()

    async def wait_for(self, uri: str) -> None:
        """Wait until a document is checked."""
        task = self._tasks.get(uri)
        if task is not None:
            await asyncio.wait((task,))

    def stop(self) -> None:
        """Cancel all checks."""
        for uri in list(self._tasks):
            self.forget(uri)

    async def _run(self, uri: str) -> None:
        """Check a document again until its last text is checked."""
        try:
            done = -1
            while done != self._wanted[uri]:
                await self._wait_for_pause(uri)
                done = self._wanted[uri]
                job = self._job_of(uri)
                if job is None:
                    return
                outcome = await self._check(job)
                if done == self._wanted[uri]:
                    await self._show(uri, outcome)
        except Exception as error:  # noqa: BLE001 - see below
            # whatever it is, other documents are still checked
            await self._show(uri, f"the file could not be checked: this is a fault of twinform: {error!r}")
        finally:
            if self._tasks.get(uri) is asyncio.current_task():
                del self._tasks[uri]

    async def _wait_for_pause(self, uri: str) -> None:
        """Wait until the pause is over, which each key restarts."""
        loop = asyncio.get_running_loop()
        # The pause is counted from the last key: a loop that looks again after a whole pause would
        # wait for up to two of them.
        while (left := self._due[uri] - loop.time()) > 0:
            await asyncio.sleep(left)

    async def _check(self, job: CheckJob) -> Checked | str:
        try:
            return await self._worker.run(check, job)
        except TaskError as error:
            return f"the file could not be checked: {error}"


Publish = Callable[[types.PublishDiagnosticsParams], None]
_MOST_ROBOTS = 200
"""The robots of a workspace that are checked without being open."""
_ADVICE = "it is not followed while you type; run `twinform check` on it, and open it again once it is smaller"


class Session:
    """The state of the server: requests get documents from it, and it checks documents as they change."""

    def __init__(self, settings_of: SettingsOf, publish: Publish, worker: Worker | None = None) -> None:
        self.documents = Documents()
        self.files = DocumentFiles(self.documents)
        self.neighbors = IncludedNeighbors(self.files)
        self.folders: list[Path] = []
        self.snippets = False
        self.options = EditorOptions()
        self.found: dict[str, tuple[TextDocument, tuple[Diagnostic, ...]]] = {}
        self.settings_of = settings_of
        self._publish = publish
        self.worker = worker or Worker()
        self._checks = Checks(self.worker, self.job, self._show)
        self._shown: dict[str, dict[str, list[types.Diagnostic]]] = {}
        self._read: dict[str, frozenset[str]] = {}
        self._robots: frozenset[str] = frozenset()
        self._listing: asyncio.Task[None] | None = None

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
        if uri in self._robots:
            self._checks.want(uri)

    def check_workspace(self) -> None:
        """Check the robots of the workspace that are not open, if the editor wants it."""
        if self.options.check_workspace and (self._listing is None or self._listing.done()):
            self._listing = asyncio.get_running_loop().create_task(self._check_robots())

    async def _check_robots(self) -> None:
        """Check one robot after the other, so that a document waits for no more than one of them."""
        files = [str(path) for path in files_below(self.folders, ENDINGS)]
        if not files:
            return
        try:
            settings = self.settings(Path(files[0]))
            robots = await self.worker.run(robots_among, files, settings.load_options.search)
        except TaskError:
            return  # whatever it is, the check of a document says so
        self._robots = frozenset(uri_of(Path(file)) for file in robots[:_MOST_ROBOTS])
        for uri in sorted(self._robots):
            if self.documents.state(uri) is None:
                self._checks.want(uri, pause=0)
                await self._checks.wait_for(uri)

    def changed_on_disk(self, uri: str) -> None:
        """Check a file that is not open again, and what includes it, after something else has changed it."""
        path = file_of(uri)
        document = self.files.document(path) if path is not None and self.documents.state(uri) is None else None
        if document is not None:
            self._check_includers(document)
        if uri in self._robots and self.documents.state(uri) is None:
            self._checks.want(uri)

    def stop(self) -> None:
        """End all checks and the worker."""
        if self._listing is not None:
            self._listing.cancel()
        self._checks.stop()
        self.worker.stop()

    def findings(self, document: TextDocument) -> tuple[Diagnostic, ...]:
        """Return the findings in this state of a document, by its own check and by those of documents that include it.

        Edits of their fixes name all other files.
        """
        here = document.path.absolute()
        found = [
            _seen_from(each, str(here), "" if top is document else str(top.path.absolute()))
            for uri, (top, diagnostics) in self.found.items()
            if self.documents.get(uri) is top
            for each in by_file(diagnostics, top.path.absolute()).get(here, ())
        ]
        return tuple(found)

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
                self.found.pop(uri, None)  # the edits of fixes are for the text that it had
                self._checks.want(uri)

    def job(self, uri: str) -> CheckJob | None:
        """Return what the worker has to know of a document; None if the document is not followed."""
        document = self._document(uri)
        if document is None:
            if self.documents.state(uri) is None:  # a file that is gone
                self._publish_for(uri, {uri: []})
            return None
        root = document.tree.root
        is_part = document.is_xacro and root is not None and root.tag == "robot" and root.get("name") is None
        return CheckJob(document.path.absolute(), self._unsaved(document), self.settings(document.path), is_part)

    def _document(self, uri: str) -> TextDocument | None:
        """Return an open document that is followed, or the file of a robot of the workspace that is not open."""
        if uri not in self._robots or self.documents.state(uri) is not None:
            return self.documents.get(uri)
        path = file_of(uri)
        return self.files.document(path) if path is not None else None

    def settings(self, path: Path) -> EditorSettings:
        """Return the settings for a file, which finds packages in all folders of the workspace.

        A package in the file's own folder of the workspace is found as by `check FOLDER`.
        """
        settings = self.settings_of(path)
        options = settings.load_options
        others = tuple(each for each in self.folders if not path.absolute().is_relative_to(each.absolute()))
        workspaces = (*options.search.workspaces, *others)
        search = replace(options.search, asked=tuple(self.folders), workspaces=workspaces)
        return replace(settings, load_options=replace(options, search=search))

    def _unsaved(self, document: TextDocument) -> Mapping[str, bytes]:
        """Return the texts of all open files, and of a document, which may be no file."""
        files = [each for each in self.documents if each.is_file and not each.excess]
        return {os.path.realpath(each.path): each.data for each in (*files, document)}

    async def _show(self, uri: str, outcome: Checked | str) -> None:
        """Show the result of a check."""
        document = self._document(uri)
        if document is None:
            return
        if isinstance(outcome, str):
            self._publish_for(uri, {uri: [notice(outcome)]})
            return
        self._read[uri] = outcome.files
        if self.documents.get(uri) is document:
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


def _seen_from(finding: Diagnostic, here: str, top: str) -> Diagnostic:
    """Return a finding of the check of a file `top` as one about the file `here`; no name is the same file."""
    if finding.fix is None or not top:
        return finding
    edits = (edit._replace(file="" if edit.file == here else edit.file or top) for edit in finding.fix.edits)
    return replace(finding, fix=replace(finding.fix, edits=tuple(edits)))


def _drop_repeats(found: list[types.Diagnostic]) -> list[types.Diagnostic]:
    """Drop diagnostics that repeat another one at the same place."""
    seen = {(each.range.start.line, each.range.start.character, str(each.code), each.message): each for each in found}
    return list(seen.values())
