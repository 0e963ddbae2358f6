"""What must hold for any input at all; `fuzz/` runs these under atheris, and the tests on what that has found."""

import atexit
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from functools import cache
from io import BytesIO
from pathlib import Path

from click.testing import CliRunner

import twinform
from testbed.editor.playing import play
from testbed.fixed_files import fixed_file
from twinform.cli.check import command as check_command
from twinform.cli.command import UNUSABLE
from twinform.cli.format import command as format_command
from twinform.cli.model_files import PatternError
from twinform.cli.path_patterns import PathPatterns
from twinform.compiler import check
from twinform.compiler.batch.archives import LEAST_BYTES, MOST_TIMES, unpacked
from twinform.compiler.batch.entries import FolderError
from twinform.compiler.companions.follow_renames import Renames, follow_in, leaves_in
from twinform.compiler.companions.name_places import mentions
from twinform.compiler.companions.yaml_leaves import YamlError, read_yaml
from twinform.compiler.input.load_options import LoadResult
from twinform.compiler.output.emitting import emit
from twinform.compiler.output.json import json_text
from twinform.compiler.reproducers import Reproducer
from twinform.compiler.resolve_uris import SearchPath, UriError
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.baseline import Baseline, BaselineError
from twinform.diagnostics.suppressions import parse_suppressions
from twinform.ir import Document
from twinform.passes import PipelineError, parse_pipeline
from twinform.passes.mesh_references import FORMATS
from twinform.server.serving import read_messages

MODEL = b'<robot name="a"><link name="b"/></robot>'
MESH_KINDS = sorted(FORMATS)
_SEPARATOR = "\0"
_REPETITIONS = 100


def load(data: bytes) -> None:
    """Nothing but findings comes of any bytes, and what is accepted is the same text once written, read and written."""
    checked, document = _checked(data)
    if document is None:
        return
    sink = DiagnosticSink()
    text = emit(document, sink)
    # what comments allow is an error again in a text without them
    if not sink.has_errors and not checked.allowed:
        assert emit(twinform.loads(text), sink) == text, "another text once read again"


def parameters(data: bytes) -> None:
    """YAML of any bytes has values at their places, or is refused; a rename in it, or in SRDF, keeps what it names."""
    with suppress(YamlError):
        found = read_yaml(data)
        spans = [step.place for leaf in found.leaves for step in (*leaf.path, leaf.value)]
        assert all(0 <= span.start <= span.end <= len(found.text) for span in spans), "a place outside of the text"
        parse_suppressions(found.comments())
    for name in ("a.yaml", "a.srdf"):
        path = Path(name)
        followed = follow_in(path, data, Renames({"base": "b: 2"}, {"hip": "h'2"}))
        if followed.changed:
            before, after = (list(mentions(leaves_in(path, each))) for each in (data, followed.after))
            assert [each.kind for each in before] == [each.kind for each in after], "another meaning after a rename"


def pipeline(data: bytes) -> None:
    """A text is a pipeline, whose own text is the same pipeline, or a PipelineError."""
    try:
        found = parse_pipeline(data.decode("utf-8", errors="replace"))
    except PipelineError:
        return
    assert parse_pipeline(str(found)) == found, "another pipeline once written and parsed again"


def editor_protocol(data: bytes) -> None:
    """Messages of an editor, one in each line: each request has one answer, and documents are still checked."""
    assert len(list(read_messages(BytesIO(data)))) <= len(data), "messages out of nothing"
    play(data.splitlines())


def fixers(data: bytes) -> None:
    """Fixes of any file, safe ones and all, add no finding, change nothing outside of their edits, and end."""
    faults = fixed_file("", data).faults
    assert not faults, faults


def patterns(data: bytes) -> None:
    """Lines of patterns, NUL, and lines of names: all is decided, in the same way each time; so are suppressions.

    Without a `!` several patterns ignore what any of them ignores. Names are tried many times as long, too.
    """
    text, _, names = data.decode("utf-8", errors="surrogateescape").partition(_SEPARATOR)
    lines, names = text.splitlines(), [each for name in names.splitlines() for each in (name, name * _REPETITIONS)]
    suppressions = parse_suppressions((line, number, number, number) for number, line in enumerate(lines, start=1))
    assert len(suppressions.entries) + len(suppressions.flaws) <= len(lines)
    decisions = _decisions(lines, names)
    if decisions is None:
        return
    assert decisions == _decisions(lines, names), "another decision the second time"
    if "!" not in text:
        single = [found for line in lines if (found := _decisions([line], names)) is not None]
        assert decisions == [any(each) or None for each in zip(*single, strict=True)] or not single


def _decisions(lines: Iterable[str], names: Sequence[str]) -> list[bool | None] | None:
    """What patterns say about each name of a folder; None where one of them is no pattern."""
    try:
        compiled = PathPatterns.of("/project", lines)
    except PatternError:
        return None
    return [compiled.decide(f"/project/{name}", is_folder=folder) for name in names for folder in (False, True)]


def configurations(data: bytes) -> None:
    """Any bytes as `twinform.toml` are settings that `check` and `format` work with, or an error that names a file."""
    with tempfile.TemporaryDirectory() as folder:
        settings, model = Path(folder, "twinform.toml"), Path(folder, "a.urdf")
        settings.write_bytes(data)
        model.write_bytes(MODEL)
        for command, *options in ((check_command,), (format_command, "--diff")):
            result = CliRunner().invoke(command, [*options, "--config", str(settings), str(model)])
            if result.exception is not None and not isinstance(result.exception, SystemExit):
                raise result.exception
            assert result.exit_code != UNUSABLE or folder in result.output, f"no file is named: {result.output}"


def archives(data: bytes) -> None:
    """Any bytes as an archive are unpacked within limits, below one folder, or refused; nothing is left."""
    with tempfile.TemporaryDirectory() as folder:
        archive = Path(folder, "a.zip" if data.startswith(b"PK") else "a.tar")
        archive.write_bytes(data)
        with suppress(FolderError), unpacked(archive) as made:
            files = [each for each in made.folder.rglob("*") if not each.is_dir()]
            assert all(each.is_file() and not each.is_symlink() for each in files), "more than files"
            size = sum(each.stat().st_size for each in files)
            assert size <= max(LEAST_BYTES, MOST_TIMES * len(data)), "larger than promised"
        assert [each.name for each in Path(folder).iterdir()] == [archive.name], "written beside the archive"


def json(data: bytes) -> None:
    """Any JSON is a document, a baseline or a reproducer that its own text gives again, or is refused."""
    text = data.decode("utf-8", errors="replace")
    for parse, refusal in ((Baseline.parse, BaselineError), (Reproducer.model_validate_json, ValueError)):
        with suppress(refusal):
            _require_same(parse, parse(text))
    checked, document = _checked(data)
    if document is None:
        return
    written = json_text(document)
    if not checked.allowed:
        again = check(written.encode()).document
        assert again is not None, "refused once written"
        assert json_text(again) == written, "another text once read again"


def _checked(data: bytes) -> tuple[LoadResult, Document | None]:
    """What comes of a check, and the document if it is accepted; what is not has a finding that says why."""
    checked = check(data)
    document = checked.document if checked.accepted else None
    assert document is not None or checked.diagnostics, "refused without a word"
    return checked, document


def _require_same(parse: Callable[[str], Baseline | Reproducer], found: Baseline | Reproducer) -> None:
    assert parse(found.to_json()) == found, "another one once written and read again"


def addresses(data: bytes) -> None:
    """Any text as a URI leads to something below the project or the cache of Fuel, or is refused."""
    top = _project()
    search = SearchPath.of((), {"HOME": str(top), "GZ_FUEL_CACHE_PATH": str(top / "cache")})
    try:
        found = search.find(data.decode("utf-8", errors="surrogateescape"), top / "project" / "arm" / "w.sdf")
    except UriError:
        return
    assert any(found.resolve().is_relative_to(top / name) for name in ("project", "cache")), f"leads to {found}"


@cache
def _project() -> Path:
    """A folder with a project, a cache of Fuel, and a file that is in neither, to which a link leads."""
    top = Path(os.path.realpath(tempfile.mkdtemp(prefix="twinform-fuzz-")))
    atexit.register(shutil.rmtree, top)
    for name in ("project/.git/HEAD", "project/arm/a.stl", "project/crate/model.config", "secret/a.stl"):
        (top / name).parent.mkdir(parents=True, exist_ok=True)
        (top / name).write_bytes(b"")
    cached = top / "cache" / "fuel.gazebosim.org" / "o" / "models" / "crate" / "1"
    cached.mkdir(parents=True)
    for folder in (top / "project", cached):
        (folder / "away").symlink_to(top / "secret")
    return top


def meshes(data: bytes) -> None:
    """A byte for the kind of file, and the file: what it names is found, and stays where the names stay."""
    kind = FORMATS[MESH_KINDS[data[0] % len(MESH_KINDS)]] if data else FORMATS["obj"]
    with suppress(ValueError):
        names = kind.references(data[1:])
        assert kind.references(kind.rewritten(data[1:], {})) == names, "other names once written"
