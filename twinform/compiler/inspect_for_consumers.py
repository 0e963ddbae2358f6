"""Findings of `check --for`: what the consumers that a file is for make of it."""

from collections.abc import Sequence
from pathlib import Path

from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.resolve_uris import LocalAssets
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location
from twinform.diagnostics.rules import UNREAD_FORMAT
from twinform.ir import Format
from twinform.profiles import Profile, ProfiledFile, assess, findings

_FORMATS = {"robot": Format.URDF, "sdf": Format.SDF, "gazebo": Format.SDF}
"""The formats by the roots of their files."""


def subject_of(
    loaded: LoadResult, load_options: LoadOptions, found: Sequence[Diagnostic] | None = None
) -> ProfiledFile:
    """Return a file that was read and inspected as profiles see it; consumers also see what its comments allow."""
    found = (*loaded.diagnostics, *loaded.allowed) if found is None else found
    assets = LocalAssets(load_options.search, Path(loaded.path))
    format_ = _format(loaded)
    return ProfiledFile(loaded.text_name, format_, loaded.document, loaded.tree, loaded.content, tuple(found), assets)


def report_for_consumers(loaded: LoadResult, load_options: LoadOptions, sink: DiagnosticSink) -> None:
    """Report what consumers mind; findings that are there already get the names of the consumers."""
    found = assess(subject_of(loaded, load_options, (*sink.diagnostics, *sink.allowed)), load_options.profiles)
    told = {id(judgment.finding) for each in found for judgment in each.judgments}
    sink.diagnostics = [each for each in sink.diagnostics if id(each) not in told]
    sink.allowed = [each for each in sink.allowed if id(each) not in told]
    sink.has_errors = any(each.is_error for each in sink.diagnostics)
    sink.extend(findings(found))
    sink.extend(
        # `for` in twinform.toml is about all files of a project, of both formats: that MuJoCo does
        # not read the SDF beside its URDF is no finding there. Typed on a command line, nothing
        # would be judged at all.
        unread(each.profile, _format(loaded), loaded.path)
        for each in found
        if each.profile.named and not each.reads
    )


def unread(profile: Profile, format_: Format | None, path: str) -> Diagnostic:
    """Make the finding that a consumer does not read a format at all."""
    reads = " and ".join(each.upper() for each in profile.formats)
    message = f"{profile.label} does not read {format_.upper() if format_ else 'this format'}; it reads {reads}"
    advice = f"twinform convert --to {profile.formats[0]} --for {profile.consumer}"
    return Diagnostic(UNREAD_FORMAT, message, Location(path, 1, "/"), UNREAD_FORMAT.severity, help=advice)


def _format(loaded: LoadResult) -> Format | None:
    if loaded.format is not None:
        return loaded.format
    root = str(loaded.tree.tag) if loaded.tree is not None else ""
    return _FORMATS.get(root)
