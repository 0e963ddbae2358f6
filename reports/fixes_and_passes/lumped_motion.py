"""One robot before and after lumping, let go in Drake; runs in a worker process."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import twinform
from reports.harness.let_go import Motion, motion
from testbed.corpus.files import CorpusFile
from testbed.output_files import OUT, kept
from twinform.ir import Document

_JOINTS = 1


@dataclass(frozen=True, slots=True)
class Mode:
    """A method of lumping, the format of the robots that it is tried on, and that of the result."""

    name: str
    source: Literal["urdf", "sdf"]
    target: Literal["urdf", "sdf"]
    passes: str


MODES = (
    Mode("URDF", "urdf", "urdf", "lump-fixed-joints"),
    Mode("URDF to SDF, as libsdformat", "urdf", "sdf", "lump-fixed-joints{compat=libsdformat}"),
    Mode("SDF", "sdf", "sdf", "lump-fixed-joints"),
)
_UNFIT = frozenset({"impossible-inertia", "indefinite-inertia"})
"""Drake puts inertias of its own in the place of these, and others when links are lumped."""


def move(job: tuple[Mode, CorpusFile]) -> Motion | None:
    """The motions of a robot that has fixed joints; None where nothing is lumped, or inertias are impossible."""
    mode, file = job
    try:
        plain = twinform.load(file.path, paths=file.paths)
        found = twinform.check(file.path, paths=file.paths).diagnostics
        if not _is_interesting(plain) or _UNFIT & {each.rule.name for each in found}:
            return None
        conversion = twinform.convert(file.path, to=mode.target, passes=mode.passes, paths=file.paths)
        source = _source(mode, file)
    except twinform.CompileError:
        return None
    links = _bodies(plain)
    lumped = links - _bodies(conversion.document)
    if not lumped:
        return None
    return motion(mode.name, file.name, lumped, source, _written(mode.name, mode, file, conversion.text))


def _is_interesting(document: Document) -> bool:
    """Whether it is one robot, with fixed joints and some that move."""
    if len(document.models) != 1:
        return False
    types = [joint.type for joint in document.models[0].joints]
    return "fixed" in types and len([each for each in types if each != "fixed"]) >= _JOINTS


def _bodies(document: Document) -> int:
    """The links that have mass; in SDF all have."""
    links = document.models[0].links
    if document.format == "sdf":
        return len(links)
    return sum(1 for link in links if link.inertial is not None and link.inertial.mass)


def _source(mode: Mode, file: CorpusFile) -> Path:
    """The robot as it is, in the format of the result: Drake reads rotors of motors in URDF, and not in SDF."""
    if mode.source == mode.target:
        return file.path
    return _written("as it is", mode, file, twinform.convert(file.path, to=mode.target, paths=file.paths).text)


def _written(folder: str, mode: Mode, file: CorpusFile, text: str) -> Path:
    """A robot in a file; Drake is not asked for meshes."""
    root = OUT / "lumping" / "motion" / folder.replace(" ", "_").replace(",", "")
    return kept(root / f"{file.name}.{mode.target}", text)
