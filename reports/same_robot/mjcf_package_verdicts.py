"""What others make of a file of MJCF once it is SDF or URDF, and of what comes home; runs in a worker process."""

import importlib
import os
import re
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

from lxml import etree

import twinform
from reports.same_robot.reader_verdicts import shown
from testbed.mjcf.canonical_models import PACKAGES, load
from testbed.mjcf.home_trips import came_home
from testbed.mjcf.of_mjcf import Tree, differences_in_sdf, differences_in_urdf, trees_of, without_rotors
from twinform.compiler.conversion import Conversion
from twinform.compiler.request import Language

_ROBOTS = 8
"""So many robots of a world become a URDF each."""
_MASSLESS = "counts for no mass"
_OF_MASSES = (
    "body_(inertia|ipos|iquat|mass|subtreemass|invweight0)|dof_(invweight0|M0)|meanmass|center|extent"
    "|(light|cam)_poscom0"
)
_ACCOUNTS = (
    (r"the tree is another one|missing: \S+: '", "stray-text", ""),
    (r"the tree is another one|missing: \S+/@\w+: ''", "blank-value", ""),
    (r"MuJoCo has more bodies", "mjcf-only", r"<(flex|flexcomp|composite)>.* is kept as it is"),
    (r"missing: /mujoco/body", "unknown-element", r"<body> is not an element of <mujoco>"),
    (r"the (mass|inertia|bias)|massless-link", "unreadable-mesh", _MASSLESS),
    (r"array (geom|mat)_rgba$|changed: .*/@rgba\b", "mjcf-only", r"^the color .* is cut"),
    (rf"array ({_OF_MASSES})$", "unreadable-mesh", _MASSLESS),
)
"""What a difference may come from: patterns of it, the rule, and a pattern of the message of that finding."""
_QUOTED = re.compile(r" '[^']*'")


class Question(StrEnum):
    """What is asked about a file."""

    READ = "read"
    TREE = "same tree"
    SDF = "SDF in Drake"
    URDF = "URDF in Drake"
    SDF_HOME = "home from SDF"
    URDF_HOME = "home from URDF"


@dataclass(frozen=True, slots=True)
class PackageFile:
    """A file of a package, by its path below the folder of all packages."""

    path: Path

    @property
    def name(self) -> str:
        """The path below the folder of the packages."""
        return self.path.relative_to(PACKAGES).as_posix()


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer to a question about a file: what differs, or is refused; nothing where all is the same.

    `reason` is what the ledger or a finding of the conversion says about all of it, if they say so.
    """

    name: str
    question: Question
    cause: str = ""
    reason: str = ""

    @property
    def package(self) -> str:
        """The package of the file."""
        return self.name.partition("/")[0]

    def __str__(self) -> str:
        return f"{self.name}: {self.question}: {self.cause}"


def judge(file: PackageFile) -> list[Answer]:
    """All answers about a file; none where MuJoCo refuses it."""
    mujoco: Any = importlib.import_module("mujoco")
    model = load(mujoco, file.path)
    if model is None:
        return []
    found = _Judge(mujoco, model, file.path)
    answers: list[Answer] = []
    for question, ask in found.questions():
        causes = _causes(ask)
        answers.append(Answer(file.name, question, shown(causes), reason_of(causes, found.said)))
    return answers


def _causes(ask: Callable[[], Iterable[str]]) -> list[str]:
    """The differences, or why there is no answer."""
    try:
        return list(ask())
    except twinform.CompileError as error:
        first = next((each for each in error.diagnostics if each.is_error), error.diagnostics[0])
        return [f"{first.rule.name}: {first.message}"]
    except Exception as error:  # noqa: BLE001 - Drake has no narrower type
        return [f"{type(error).__name__}: {str(error).strip().partition(chr(10))[0]}"]


def reason_of(causes: Iterable[str], said: Collection[tuple[str, str]]) -> str:
    """Return what a conversion said, by rule and message, of all of these differences.

    Nothing where any of them passed unseen.
    """
    reasons = [_reason_of(each, said) for each in causes]
    return "; ".join(dict.fromkeys(reasons)) if all(reasons) else ""


def _reason_of(cause: str, said: Collection[tuple[str, str]]) -> str:
    for pattern, rule, message in _ACCOUNTS:
        if re.match(pattern, cause):
            found = (text for name, text in said if name == rule and re.search(message, text))
            if (first := next(found, None)) is not None:
                return f"{rule}: {_QUOTED.sub('', first)}"
    return ""


class _Judge:
    """Asks about one file."""

    def __init__(self, mujoco: Any, model: Any, path: Path) -> None:
        self.mujoco, self.model, self.path = mujoco, model, path
        self.compiled = without_rotors(mujoco, path)
        self.said: dict[tuple[str, str], None] = {}
        """The rules and messages of what conversions of the file found, and of their ledgers."""

    def questions(self) -> Iterable[tuple[Question, Callable[[], Iterable[str]]]]:
        """Yield what can be asked: what is not read is not converted."""
        try:
            made = self._convert(self.path, "sdf")
        except twinform.CompileError as error:
            raised = error

            def refused() -> Iterable[str]:
                raise raised

            yield Question.READ, refused
            return
        yield Question.READ, lambda: ()
        yield Question.TREE, self._tree
        yield Question.SDF, lambda: differences_in_sdf(self.compiled, made)
        yield Question.SDF_HOME, lambda: self._home(made.text, ".sdf")
        trees = trees_of(self.compiled, made.document)
        if isinstance(trees, str):
            return
        is_model = bool(made.document.models)
        yield Question.URDF, lambda: self._urdfs(trees[:_ROBOTS], is_model=is_model)
        if is_model:  # of a world, URDF holds the robot alone
            yield Question.URDF_HOME, lambda: self._home(self._convert(self.path, "urdf").text, ".urdf")

    def _convert(self, path: Path, to: Language, model: str | None = None) -> Conversion:
        made = twinform.convert(path, to=to, model=model, paths=[PACKAGES])
        if path == self.path:
            said = [*made.diagnostics, *made.ledger.entries]
            self.said.update(dict.fromkeys((each.rule.name, each.message) for each in said))
        return made

    def _tree(self) -> Iterable[str]:
        one, other = (_plain(text) for text in (self.path.read_bytes(), self._convert(self.path, "mjcf").text.encode()))
        return [] if one == other else ["the tree is another one"]

    def _urdfs(self, trees: list[Tree], *, is_model: bool) -> Iterable[str]:
        for tree in trees:
            made = self._convert(self.path, "urdf", None if is_model else tree.model.name)
            yield from differences_in_urdf(self.compiled, tree, made)

    def _home(self, text: str, suffix: str) -> Iterable[str]:
        beside = self.path.with_name(f".there-{os.getpid()}-{self.path.stem}{suffix}")
        try:
            beside.write_text(text)
            home = self._convert(beside, "mjcf").text
        finally:
            beside.unlink()
        return came_home(self.mujoco, self.path, self.model, home)


def _plain(text: bytes) -> bytes:
    parser = etree.XMLParser(remove_blank_text=True, remove_comments=True, remove_pis=True)
    root = etree.fromstring(text, parser)
    for each in root.iter():
        if each.text and not each.text.strip():  # around a comment, which the parser keeps
            each.text = None
    return etree.tostring(root, method="c14n")
