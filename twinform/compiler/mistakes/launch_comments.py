"""Comments of robots that break the launch files which start them.

What a command prints is read as YAML where it becomes a parameter (launch_ros, `evaluate_parameter_dict`), unless the
launch file says that it is a text. An XML text is one plain scalar for YAML, up to a colon before a blank or a number
sign behind one. PyYAML then says "mapping values are not allowed here", or takes the rest of the line for a comment,
which ends the document.
"""

import re
from collections.abc import Collection, Iterator
from pathlib import Path

from twinform.compiler.input.load_options import LoadResult
from twinform.compiler.input.xacro_needs import launch_files_of
from twinform.compiler.resolve_uris import SearchPath
from twinform.diagnostics import DiagnosticSink, Location, Span, rules
from twinform.ir import Format
from twinform.lazy import lazy_pattern
from twinform.text import Lines, SourceText, UndecodableError
from twinform.text.tokens import COMMENT

_COMMENT = lazy_pattern(COMMENT)
_BREAK = lazy_pattern(r":(?=\s)|(?<=\s)#+")


_COMMAND = lazy_pattern(r"\bCommand\(|\$\(command\b")
_AS_TEXT = lazy_pattern(r"""\bParameterValue\b|\bvalue_type\b|\btype\s*[=:]\s*["']?str\b""")


def report_comments(loaded: LoadResult, search: SearchPath, sink: DiagnosticSink) -> None:
    """Report in each file of a robot of URDF the first comment that stops a launch file beside the robot."""
    document = loaded.document
    if document is None or document.format is not Format.URDF or loaded.content is None or loaded.path[:1] == "<":
        return
    text = _text_of(loaded.content)
    # xacro leaves out what stands before its own elements, and all that is in macros which nothing calls
    kept = {_words(comment.of(text)) for comment in breaking_comments(text)}
    launch = _launch_file(Path(loaded.path), search) if kept else None
    if launch is not None:
        texts = loaded.expansion.texts if loaded.expansion else {loaded.path: loaded.content}
        for name, data in texts.items():
            _report_file(name, data, kept, launch, sink)


def _launch_file(path: Path, search: SearchPath) -> Path | None:
    """Return a launch file that passes a robot on as what a command prints, and does not say that it is a text."""
    for file, text in launch_files_of(path, search.readable(path)):
        if path.name in text and "robot_description" in text and _COMMAND.search(text) and not _AS_TEXT.search(text):
            return file
    return None


def _report_file(name: str, data: bytes, kept: Collection[str], launch: Path, sink: DiagnosticSink) -> None:
    text = _text_of(data)
    found = [each for each in breaking_comments(text) if _words(each.of(text)) in kept]
    if not found:
        return
    first = next(breaks_in(text, found[0]))
    line, column = Lines(text).place(first.start())
    others = f", and {len(found) - 1} more" if len(found) > 1 else ""
    shown = "':' before a blank" if first[0] == ":" else f"{first[0]!r} behind a blank"
    message = f"a comment with {shown}{others}: {launch.name} passes the robot on as YAML, and stops there"
    help = "change the comments, or write ParameterValue(Command(...), value_type=str) in the launch file"
    where, related = Location(name, line, "", column), (Location(str(launch)),)
    sink.report(rules.YAML_IN_COMMENT, message, where, found=first[0], help=help, related=related)


def breaking_comments(text: str) -> Iterator[Span]:
    """Yield the comments of a text that YAML stops at."""
    for comment in _COMMENT.finditer(text):
        if _BREAK.search(comment[0]):
            yield Span(*comment.span())


def breaks_in(text: str, comment: Span) -> Iterator[re.Match[str]]:
    """Yield what YAML stops at in a comment."""
    return _BREAK.finditer(text, *comment)


def _text_of(data: bytes) -> str:
    try:
        return SourceText.of(data).text
    except UndecodableError:
        return ""


def _words(comment: str) -> str:
    return " ".join(comment.split())
