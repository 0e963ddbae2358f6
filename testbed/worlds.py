"""One world taken apart and put together again: is it the same world, and does Gazebo see the same?

It is split into files, these are put together with `--expand-includes`, `twinform diff` compares the worlds with all
that is in them, and libsdformat 12 reads the source and the split world.
"""

import re
import shutil
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from lxml import etree

import twinform
from testbed.corpus.examine import rules_of
from twinform.compiler import ConversionRequest, Language, LoadOptions, split
from twinform.compiler.resolve_uris import SearchPath
from twinform.file_access import folders_around
from twinform.ir import Document
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import models_of
from twinform.testing.oracles.libsdformat_robot import differences

_QUOTED = re.compile(r"'[^']*'")


class Together(StrEnum):
    """What `diff` reports about the world that was put together again."""

    SAME = "the same"
    DIFFERENT = "different"
    REFUSED = "refused, with a reason"
    UNKNOWN = "not comparable"
    CRASH = "crash"


class Loaded(StrEnum):
    """What libsdformat 12 reports about the split world."""

    SAME = "loads, the same"
    OTHER = "loads, another world"
    NOT = "does not load"
    NEITHER = "nor does the source load"
    UNASKED = "not asked"


@dataclass(frozen=True, slots=True)
class Outcome:
    """One world; `cause` is the first difference, or the rules by which it was refused."""

    name: str
    together: Together
    loaded: Loaded = Loaded.UNASKED
    cause: str = ""
    urdf: int = 0
    sdf: int = 0
    reasons: tuple[str, ...] = ()

    @property
    def fault(self) -> bool:
        """Whether the promise is broken."""
        return self.together in {Together.DIFFERENT, Together.CRASH} or self.loaded in {Loaded.OTHER, Loaded.NOT}


def judge(name: str, path: Path, folders: tuple[Path, ...], out: Path, to: Language = "urdf") -> Outcome | None:
    """Take one world apart and put it together in the folder `out`; nothing where there is no model in the file.

    No exception comes out of it.
    """
    around = _around(path, folders)
    checked = twinform.check(path, paths=around)
    if checked.document is None or not checked.accepted or not _has_models(checked.document):
        return None
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    try:
        return _judged(name, path, around, out, to)
    except Exception as error:  # noqa: BLE001 - every exception is a fault to report
        return Outcome(name, Together.CRASH, cause=f"{type(error).__name__}: {error}")


def _has_models(document: Document) -> bool:
    return bool(document.models or any(world.models for world in document.worlds))


def _around(path: Path, folders: tuple[Path, ...]) -> tuple[Path, ...]:
    """Where the includes of a file are searched for, also from elsewhere."""
    near = folders_around(path)
    return (*near, *(folder / "models" for folder in near), *folders)


def _judged(name: str, path: Path, folders: tuple[Path, ...], out: Path, to: Language) -> Outcome:
    source = _source(path, folders, out / "source")
    reading = LoadOptions(search=SearchPath.of(folders))
    try:
        found = split(ConversionRequest(to=to), source, reading)
    except twinform.CompileError as error:
        return Outcome(name, Together.REFUSED, cause=", ".join(rules_of(error.diagnostics)))
    (out / "split").mkdir()
    for file, text in found.files.items():
        (out / "split" / file).write_text(text, encoding="utf-8")
    world = out / "split" / list(found.files)[-1]
    try:
        cause = next(_changes(source, world, folders), "")
    except MissingError as error:
        return Outcome(name, Together.UNKNOWN, cause=str(error))
    loaded, seen = _loaded(source, world, folders)
    return Outcome(
        name,
        Together.DIFFERENT if cause else Together.SAME,
        loaded,
        cause or seen,
        urdf=sum(file.endswith(".urdf") for file in found.files),
        sdf=len(found.files) - 1 - sum(file.endswith(".urdf") for file in found.files),
        reasons=tuple(_reason(each.message) for each in found.diagnostics if each.rule.name == "kept-as-sdf"),
    )


def _reason(message: str) -> str:
    """Why a model stays SDF, without the names in it."""
    return _QUOTED.sub("...", message.partition(" stays SDF: ")[2])


def _source(path: Path, folders: tuple[Path, ...], out: Path) -> Path:
    """The file, or, where the files of its includes are not here, the file without those of its worlds."""
    with suppress(twinform.CompileError):
        _expanded(path, folders)
        return path
    root = etree.parse(path, etree.XMLParser(recover=True)).getroot()
    for include in [*root.iterfind("include"), *root.iterfind("world/include")]:
        parent = include.getparent()
        if parent is not None:
            parent.remove(include)
    out.mkdir()
    target = out / path.name
    target.write_bytes(etree.tostring(root))
    return target


class MissingError(Exception):
    """The source has includes whose files are not here."""


def _expanded(path: Path, folders: tuple[Path, ...]) -> twinform.Conversion:
    return twinform.convert(path, to="sdf", expand_includes=True, paths=folders)


def _changes(source: Path, world: Path, folders: tuple[Path, ...]) -> Iterator[str]:
    """What is not as it was once all is in one file again."""
    try:
        before = _expanded(source, folders)
    except twinform.CompileError as error:
        raise MissingError(error.diagnostics[0].message) from error
    after = _expanded(world, folders)
    found = twinform.diff(before.text.encode(), after.text.encode(), carriers=True)
    for each in found.differences:
        yield each.message.replace(found.a, "source").replace(found.b, "result")
    if [each.name for each in before.document.worlds] != [each.name for each in after.document.worlds]:
        yield "the worlds have other names"


def _loaded(source: Path, world: Path, folders: tuple[Path, ...]) -> tuple[Loaded, str]:
    if not libsdformat.available():
        return Loaded.UNASKED, ""
    before, models = models_of(source, folders)
    if not before.ok:
        return Loaded.NEITHER, ""
    after, again = models_of(world, folders)
    if not after.ok:
        return Loaded.NOT, after.errors[0]
    cause = next(differences(models, again), "")
    return (Loaded.OTHER, cause) if cause else (Loaded.SAME, "")
