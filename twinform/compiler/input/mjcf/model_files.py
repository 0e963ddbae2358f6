"""The files of the models that MJCF attaches: each is read once, however often it is attached."""

from contextlib import suppress
from dataclasses import field
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.input.load_options import LoadOptions, unexpanded_name
from twinform.compiler.input.mjcf.attached_keys import AttachedKeys
from twinform.compiler.input.mjcf.compiler_settings import CompilerSettings
from twinform.compiler.input.mjcf.element_findings import ElementFindings
from twinform.compiler.input.mjcf.splice_includes import splice_includes
from twinform.compiler.input.parsing import UnreadableError, parse, read_bytes, strip_default_namespace
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, rules
from twinform.schemas import XmlElement

_DEEPEST = 32


class CanonicalModel(NamedTuple):
    """A tree in which all is canonical but its frames, the settings of its compiler, and keyframes attached to it."""

    root: XmlElement
    settings: CompilerSettings
    keys: AttachedKeys


class _Read(NamedTuple):
    """The tree of a file, and why there is none."""

    root: XmlElement | None
    problem: Diagnostic | None = None


@dataclass(slots=True)
class ModelFiles:
    """What was read of files so far, and the trees of them that were made canonical."""

    load_options: LoadOptions
    main: Path
    canonical: dict[Path, CanonicalModel | None] = field(default_factory=dict[Path, CanonicalModel | None])
    _read: dict[Path, _Read] = field(default_factory=dict[Path, _Read])

    def name_of(self, asset: XmlElement, path: Path) -> str:
        """Return the name of a model among the assets: where it has none, the one that its file says."""
        name = asset.get("name")
        if name:
            return name
        root = self._tree(path).root
        return "" if root is None else root.get("model", "MuJoCo Model")

    def find(
        self, asset: XmlElement, path: Path, above: tuple[Path, ...], findings: ElementFindings
    ) -> XmlElement | None:
        """Return the tree of the file of an asset, or None where it cannot be read, which is reported."""
        file = asset.get("file", "")
        if path in above:
            message = f"{file!r} attaches itself, directly or by way of others"
            findings.report(rules.INCLUDE_CYCLE, asset, message, "@file", found=file)
            return None
        if len(above) > _DEEPEST:
            message = f"{file!r} is attached inside of {_DEEPEST} other models"
            findings.report(rules.TOO_MANY_INCLUDES, asset, message, "@file", found=file)
            return None
        root, problem = self._tree(path)
        if problem is not None or root is None:
            _report_unread(problem, file, asset, findings)
            return None
        if root.tag != "mujoco":
            message = f"{file!r} is a <{root.tag}>, and only MJCF can be attached here"
            help_ = f"write it as MJCF: twinform convert {file} --to mjcf" if root.tag == "robot" else None
            findings.report(
                rules.UNATTACHED_MODEL, asset, message, "@file", found=file, expected="<mujoco>", help=help_
            )
            return None
        return root

    def _tree(self, path: Path) -> _Read:
        if path not in self._read:
            found = DiagnosticSink(str(path))
            root: XmlElement | None = None
            with suppress(UnreadableError):
                root = self._parsed(path, found)
            self._read[path] = _Read(root, next((each for each in found.diagnostics if each.is_error), None))
        return self._read[path]

    def _parsed(self, path: Path, sink: DiagnosticSink) -> XmlElement:
        search, limits = self.load_options.search, self.load_options.limits
        unsaved = search.unsaved_of(path)
        text = read_bytes(path, sink, limits, search.readable(self.main)) if unsaved is None else unsaved
        search.seen.add(path)
        spliced = splice_includes(path, text, sink, self.load_options) if b"<include" in text else None
        root = parse(spliced.text if spliced else text, sink, limits)
        strip_default_namespace(root)
        return root


def main_file(name: str) -> Path:
    """Return the path of the file that is being read."""
    return Path(unexpanded_name(name)).resolve()


def _report_unread(problem: Diagnostic | None, file: str, asset: XmlElement, findings: ElementFindings) -> None:
    why = problem.message if problem else "it cannot be read"
    hint = problem.help if problem else None
    findings.report(rules.UNATTACHED_MODEL, asset, f"{file!r}: {why}", "@file", found=file, help=hint)
