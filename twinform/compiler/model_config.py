"""Reads the model.config of a folder, which says which of its SDF files is the model."""

import os
from collections.abc import Sequence
from pathlib import Path

from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.parsing import UnreadableError, parse, read_bytes
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.file_access import Readable
from twinform.ir import Document, Format
from twinform.lazy import lazy_pattern
from twinform.schemas import Version, XmlElement, parse_version, versions_of

MANIFESTS = ("model.config", "manifest.xml")
"""The present name, and an older one."""


_NUMBER = lazy_pattern(r"\s*(\d{1,9})")
_UNVERSIONED = (0,)


@dataclass(frozen=True, slots=True)
class _Entry:
    name: str
    version: tuple[int, ...]
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
    """Return the newest SDF file that a model.config names, up to the version `asked`, or else the first.

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
    best = _best(_entries(config, sink), asked)
    if sink.has_errors:
        return None
    if best is None or not best.name:
        message = "the model.config names no SDF file"
        where = Location(line=best.line, path="/model/sdf") if best else Location(line=1, path="/model")
        sink.report(rules.BROKEN_MODEL_CONFIG, message, where, expected="<sdf>")
        return None
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


def _best(entries: Sequence[_Entry], asked: Version | None) -> _Entry | None:
    # parser.cc, getBestSupportedModelVersion: of equal versions the first, and the first of all
    # where every version is newer than the reader, which refuses that file then.
    fitting = [each for each in entries if each.version > _UNVERSIONED and (asked is None or each.version <= asked)]
    return max(fitting, key=lambda entry: entry.version, default=next(iter(entries), None))


def _entries(config: Path, sink: DiagnosticSink) -> list[_Entry]:
    root = parse(read_bytes(config, sink), sink)
    if root.tag != "model":
        message = f"the root of the model.config is <{root.tag}>; expected <model>"
        sink.report(rules.BROKEN_MODEL_CONFIG, message, Location(line=root.sourceline or 1, path=f"/{root.tag}"))
        return []
    return [_entry(element, sink) for element in root.iterchildren("sdf")]


def _entry(element: XmlElement, sink: DiagnosticSink) -> _Entry:
    name, text, line = (element.text or "").strip(), element.get("version"), element.sourceline or 0
    version = _version(text) if text else _UNVERSIONED
    if version is None:
        message = f"the version {text!r} is no version of SDF, and Gazebo does not survive it"
        where = Location(line=line, path="/model/sdf/@version")
        sink.report(rules.BROKEN_MODEL_CONFIG, message, where, found=text, expected="such as 1.9")
    return _Entry(name, version or _UNVERSIONED, line)


def _version(text: str) -> tuple[int, ...] | None:
    """Parse a version as SemanticVersion of libsdformat does, which takes the number that each part begins with."""
    found = [_NUMBER.match(part) for part in text.split(".", 2)]
    return tuple(int(each[1]) for each in found if each) if all(found) else None
