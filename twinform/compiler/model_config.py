"""Reads the model.config of a folder, which says which of its SDF files is the model."""

import os
from collections.abc import Iterator
from pathlib import Path

from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.parsing import UnreadableError, parse, read_bytes
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.file_access import Readable
from twinform.ir import Document, Format
from twinform.schemas import Version, parse_version, versions_of

MANIFESTS = ("model.config", "manifest.xml")
"""The present name, and an older one."""


@dataclass(frozen=True, slots=True)
class _Entry:
    name: str
    version: Version
    line: int


def manifest(folder: Path) -> Path | None:
    """Return the file that names the model files of a folder; None where there is none."""
    return next((folder / name for name in MANIFESTS if (folder / name).is_file()), None)


def newest_read(document: Document, load_options: LoadOptions) -> Version:
    """Return the newest version that the reader of a document knows: the reader's own, or that of the document."""
    own = document.version if document.format is Format.SDF and document.version in versions_of("sdf") else None
    reader = parse_version(load_options.sdf_version)
    return max(parse_version(own), reader) if own else reader


def model_file(config: Path, asked: Version | None, sink: DiagnosticSink) -> Path | None:
    """Return the newest SDF file that a model.config names, up to the version `asked`, or else the newest of all.

    None where there is no file that can be read; the reason is reported.
    """
    own = DiagnosticSink(file=str(config), strict=sink.strict)
    try:
        return _choose(config, asked, own)
    except UnreadableError:
        return None
    finally:
        sink.extend(own.diagnostics)


def _choose(config: Path, asked: Version | None, sink: DiagnosticSink) -> Path | None:
    entries = list(_entries(config, sink))
    if not entries:
        message = "the model.config names no SDF file"
        sink.report(rules.BROKEN_MODEL_CONFIG, message, Location(line=1, path="/model"), expected="<sdf>")
        return None
    fitting = [entry for entry in entries if asked is None or entry.version <= asked]
    best = max(fitting or entries, key=lambda entry: entry.version)
    path = config.parent / best.name
    where = Location(line=best.line, path="/model/sdf")
    if not Readable((os.path.realpath(config.parent),)).allows(path):
        message = f"the model.config names {best.name!r}, which is not in its folder"
        sink.report(rules.URI_LEAVES_FOLDER, message, where, found=best.name)
        return None
    if not path.is_file():
        message = f"the model.config names {best.name!r}, which is not there"
        sink.report(rules.BROKEN_MODEL_CONFIG, message, where, found=best.name)
        return None
    return path


def _entries(config: Path, sink: DiagnosticSink) -> Iterator[_Entry]:
    for element in parse(read_bytes(config, sink), sink).iterchildren("sdf"):
        name = (element.text or "").strip()
        if name:
            yield _Entry(name, _version(element.get("version")), element.sourceline or 0)


def _version(text: str | None) -> Version:
    """Parse a version; one that is not written, or not a version, is older than all others."""
    try:
        return parse_version(text) if text else (0, 0)
    except ValueError:
        return (0, 0)
