"""Where the real models are, and what each of them is."""

import csv
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("TWINFORM_SHARED", ROOT.parent / "shared"))
CORPUS = Path(os.environ.get("TWINFORM_CORPUS", SHARED / "corpus"))
INDEX = SHARED / "reference" / "corpus_index.csv"
MISSING = f"there is no corpus at {os.path.relpath(CORPUS, ROOT)}; TWINFORM_CORPUS names its folder"

_ASIDE = re.compile(rb"<!--.*?-->|<\?.*?\?>", re.DOTALL)
_FIRST_TAG = re.compile(rb"<([A-Za-z_][\w:.-]*)")
_SUFFIXES = frozenset({".urdf", ".sdf", ".world", ".xacro", ".config", ".in", ".gazebo", ".xml"})
_SEARCHED = {"": "osrf+gazebo_models", "gazebosim+sdformat/test": "gazebosim+sdformat/test/integration/model"}
"""Where includes are searched for beside the folders around the file: what came with Gazebo Classic for all, and what
the tests of a repository set."""


class Kind(StrEnum):
    """What a file of the corpus is; the first three are the compiler's business, of which the corpus has no MJCF."""

    URDF = "urdf"
    SDF = "sdf"
    MJCF = "mjcf"
    XACRO = "xacro"
    CONFIG = "model.config"
    TEMPLATE = "template"
    OLD_GAZEBO = "old <gazebo> root"


@dataclass(frozen=True, slots=True)
class CorpusFile:
    """A real model: `name` is its path in the corpus, `row` what other readers reported on it."""

    name: str
    kind: Kind
    row: Mapping[str, str] = field(compare=False)

    @property
    def path(self) -> Path:
        """Where it lies."""
        return CORPUS / self.name

    @property
    def paths(self) -> tuple[Path, ...]:
        """The folders in which its includes are searched for: nothing in the corpus says where a project ends."""
        repository = CORPUS / self.repository
        return (
            repository,
            *(around / "models" for around in self.path.parents if around.is_relative_to(repository)),
            *(CORPUS / there for here, there in _SEARCHED.items() if self.name.startswith(here)),
        )

    @property
    def repository(self) -> str:
        """The folder of the corpus that it came from."""
        return self.name.split("/", 1)[0]


@cache
def corpus_files() -> tuple[CorpusFile, ...]:
    """Every model of the corpus, sorted by name; nothing where there is no corpus."""
    rows = _index()
    paths = sorted(path for path in CORPUS.rglob("*") if path.is_file())
    names = [(path, path.relative_to(CORPUS).as_posix()) for path in paths]
    wanted = [(path, name) for path, name in names if _is_model(path, name, rows)]
    return tuple(CorpusFile(name, _kind(path), rows.get(name, {})) for path, name in wanted)


def models() -> tuple[CorpusFile, ...]:
    """Those that the compiler reads: URDF and SDF."""
    return tuple(file for file in corpus_files() if file.kind in {Kind.URDF, Kind.SDF})


def xacro_files() -> tuple[CorpusFile, ...]:
    """Those that the compiler expands before it reads them; a file in xacro under another name is not one of them."""
    return tuple(file for file in corpus_files() if file.path.suffix == ".xacro")


def _is_model(path: Path, name: str, rows: Mapping[str, Mapping[str, str]]) -> bool:
    # the index knows which .xml files are models; a corpus without an index goes by the suffix alone
    if rows:
        return name in rows
    return path.suffix in _SUFFIXES and path.name != "package.xml"


def _kind(path: Path) -> Kind:
    if path.suffix == ".config":
        return Kind.CONFIG
    if path.suffix == ".in":
        return Kind.TEMPLATE
    data = path.read_bytes()
    match = _FIRST_TAG.search(_ASIDE.sub(b"", data))
    root = match.group(1).decode() if match else ""
    if path.suffix == ".xacro" or (root == "robot" and b"<xacro:" in data):
        return Kind.XACRO
    if root.split(":")[0] == "gazebo":
        return Kind.OLD_GAZEBO
    if root in {"robot", "sdf"}:
        return Kind.URDF if root == "robot" else Kind.SDF
    # not XML, or a root that neither format has: the name shows what it was meant to be
    return Kind.URDF if path.suffix == ".urdf" else Kind.SDF


def _index() -> dict[str, Mapping[str, str]]:
    if not INDEX.is_file() or CORPUS != SHARED / "corpus":
        return {}
    with INDEX.open(encoding="utf-8", newline="") as file:
        return {row["path"]: row for row in csv.DictReader(file)}
