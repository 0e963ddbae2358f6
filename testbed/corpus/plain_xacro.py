"""What the `xacro` command makes of a real file, beside what the compiler expands it to."""

import json
import os
import re
import resource
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from pathlib import Path

from lxml import etree

from testbed.corpus.files import CORPUS, CorpusFile, Kind, corpus_files
from twinform.compiler.input.expand_xacro import expand
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.parsing import UnreadableError
from twinform.compiler.resolve_uris import SearchPath, UriError
from twinform.diagnostics import DiagnosticSink

_RUN = Path(__file__).with_name("plain_xacro_run.py")
_SECONDS = 60
_FIND = re.compile(r"\$\(find\s+([\w-]+)\s*\)")
_ERROR = re.compile(r"^(?=error: |XML parsing error: )", re.MULTILINE)
_NO_PACKAGE = "a package that is not there"
_REASONS = {
    _NO_PACKAGE: r"package.* (?:is not|not) found",
    "a file that is not there": r"No such file or directory",
    "an argument that is not given": r"Undefined substitution argument|^(?:the )?arguments? .* ha(?:s|ve) no values?$",
    "a name that stands for nothing": r"(?:name|property|argument) '[^']+' is not defined",
    "a macro that is not there": r"unknown macro name|^there is no macro '",
    "a parameter that the macro does not have, or lacks": (
        r"Invalid parameter|Undefined parameters|Unused block|^macro '[^']+' "
    ),
    "a mistake in an expression": r"when evaluating expression|, in \$\{|invalid syntax|was never closed|unmatched",
    "a scope outside of all macros": r"has no attribute '_setitem'",
    "XML that is not well-formed": r"not well-formed XML|XML parsing error",
}


class Verdict(StrEnum):
    """What became of a file."""

    SAME = "same tree"
    BOTH_REFUSE = "refused by both"
    REFUSED_HERE = "refused here only"
    REFUSED_THERE = "refused by xacro only"
    DIFFERENT = "another tree"


@dataclass(frozen=True, slots=True)
class Compared:
    """A file, what became of it, what was printed about it, and the seconds of the processor that each took."""

    name: str
    verdict: Verdict
    ours: str = ""
    theirs: str = ""
    our_seconds: float = 0.0
    their_seconds: float = 0.0

    @property
    def reason(self) -> str:
        """Why it is refused here, by one of a few reasons."""
        return reason_of(self.ours)

    @property
    def is_alike(self) -> bool:
        """Whether both agree on it."""
        if self.verdict is Verdict.SAME:
            return True
        there = reason_of(self.theirs)
        if there == _NO_PACKAGE:  # here it is a finding, and the rest is expanded: it may have mistakes of its own
            return self.verdict in {Verdict.REFUSED_THERE, Verdict.BOTH_REFUSE}
        return self.verdict is Verdict.BOTH_REFUSE and self.reason == there


def users_of_xacro() -> tuple[CorpusFile, ...]:
    """Every file of the corpus that uses xacro, whatever its name is."""
    return tuple(file for file in corpus_files() if file.kind is Kind.XACRO or file.path.suffix == ".xacro")


def reason_of(message: str) -> str:
    """What a message is about."""
    return next((reason for reason, pattern in _REASONS.items() if re.search(pattern, message)), message)


def compare(file: CorpusFile) -> Compared:
    """Expand a file in both ways, with no arguments, and with packages from anywhere in the corpus."""
    search = SearchPath.of(_folders(file), {})
    before = _seconds()
    ours, our_errors = _ours(file.path, search)
    between = _seconds()
    theirs, their_errors = _theirs(file.path, _packages(file, search))
    seconds = (between - before, _seconds() - between)
    return Compared(file.name, _verdict(ours, theirs), our_errors, their_errors, *seconds)


def _verdict(ours: bytes | None, theirs: bytes | None) -> Verdict:
    if ours is None:
        return Verdict.BOTH_REFUSE if theirs is None else Verdict.REFUSED_HERE
    if theirs is None:
        return Verdict.REFUSED_THERE
    return Verdict.SAME if _canonical(ours) == _canonical(theirs) else Verdict.DIFFERENT


def _canonical(text: bytes) -> bytes:
    root = etree.fromstring(text, etree.XMLParser(remove_blank_text=True))
    return etree.tostring(root.getroottree(), method="c14n")


def _ours(path: Path, search: SearchPath) -> tuple[bytes | None, str]:
    sink = DiagnosticSink(str(path))
    try:
        return expand(path, LoadOptions(search=search), sink).text, ""
    except UnreadableError:
        return None, sink.diagnostics[-1].message


def _theirs(path: Path, packages: Mapping[str, str]) -> tuple[bytes | None, str]:
    environment = {**os.environ, "PACKAGES": json.dumps(packages), "PYTHONHASHSEED": "0"}
    command = [sys.executable, str(_RUN), str(path)]
    done = subprocess.run(command, capture_output=True, env=environment, timeout=_SECONDS, check=False)
    if not done.returncode:
        return done.stdout, ""
    output = done.stderr.decode(errors="replace")
    return None, " ".join(_ERROR.split(output, maxsplit=1)[-1].split())


def _packages(file: CorpusFile, search: SearchPath) -> dict[str, str]:
    found: dict[str, str] = {}
    for name in _asked_for():
        try:
            found[name] = str(search.package(name, file.path))
        except UriError:
            continue
    return found


def _folders(file: CorpusFile) -> list[Path]:
    """The folders that hold packages, those of the file's own repository first."""
    names = _asked_for()
    found = sorted({path.parent for path in _all_folders() if path.name in names})
    return sorted(found, key=lambda path: not path.is_relative_to(CORPUS / file.repository))


@cache
def _all_folders() -> tuple[Path, ...]:
    return tuple(path for path in CORPUS.rglob("*") if path.is_dir())


@cache
def _asked_for() -> frozenset[str]:
    """The packages that the files of the corpus ask for."""
    texts = (file.path.read_text(encoding="utf-8", errors="replace") for file in users_of_xacro())
    return frozenset(name for text in texts for name in _FIND.findall(text))


def _seconds() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
