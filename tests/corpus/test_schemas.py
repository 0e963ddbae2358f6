"""The XSDs on real files: assertions refuse nothing that readers take, lenient ones take what is accepted."""

from collections.abc import Set as AbstractSet
from functools import cache
from pathlib import Path

import pytest
from lxml import etree
from xmlschema import XMLSchema11

import twinform
from testbed.corpus.files import CorpusFile
from tests.corpus.portions import chunks
from tests.profile import DEEP
from twinform.compiler.input.front_ends import declared_version
from twinform.compiler.input.loading import read_tree
from twinform.compiler.input.parsing import UnreadableError
from twinform.diagnostics import DiagnosticSink, Rule, rules
from twinform.schemas import Version, XmlElement, table, xmlschema_errors
from twinform.schemas.xacro_xsd import imported_schemas
from twinform.schemas.xsd import generate_schema, lenient_schema_text

CHUNKS = chunks()
_REFUSED_BY_ALL = frozenset({rules.STRAY_TEXT, rules.INVALID_VALUE, rules.MISSING_ATTRIBUTE, rules.MISSING_ELEMENT})
"""Findings about what no schema takes, lenient or not; where the robot does not depend on it they are warnings."""

_UNUSUAL = _REFUSED_BY_ALL | {rules.UNKNOWN_ELEMENT}


@pytest.mark.parametrize("chunk", CHUNKS)
def test_schemas_take_what_is_accepted(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    assert [fault for file in CHUNKS[chunk][:: 1 if DEEP else 4] for fault in _faults(file)] == []


def _faults(file: CorpusFile) -> list[str]:
    checked = twinform.check(file.path)
    rules = {each.rule for each in checked.diagnostics}
    if not checked.accepted or checked.unreadable:
        return []
    try:
        root, _ = read_tree(file.path.read_bytes(), DiagnosticSink())
    except UnreadableError:  # of JSON
        return []
    name = "urdf" if root.tag == "robot" else "sdf"
    version = declared_version(root, name, DiagnosticSink())
    faults: list[str] = []
    if not xmlschema_errors(root, name, version) and _readers_take(file):
        faults += [f"{file.name}: {each}" for each in xmlschema_errors(root, name, version, assertions=True)]
    if not rules & _REFUSED_BY_ALL and not _lenient(name, version).is_valid(root):
        faults.append(f"{file.name} is not taken by the lenient schema")
    if not faults and _of_dialects(rules) and not _projection(name, version).validate(root):
        faults.append(f"{file.name} is not taken by the lenient schema in XSD 1.0")
    return faults


def test_schemas_of_xacro_take_the_files_of_which_nothing_is_unusual(corpus: Path, tmp_path: Path) -> None:
    schemas = {root: _xacro_schema(name, tmp_path / name) for root, name in (("robot", "urdf"), ("sdf", "sdf"))}
    files = sorted(corpus.rglob("*.xacro"))[:: 1 if DEEP else 8]
    taken = 0
    for path in files:
        checked = twinform.check(path)
        if not checked.accepted or checked.unreadable or {each.rule for each in checked.diagnostics} & _UNUSUAL:
            continue
        tree = etree.parse(path)
        assert schemas[str(tree.getroot().tag)].validate(tree), path
        taken += 1
    assert taken > len(files) // 10


def _xacro_schema(format: str, folder: Path) -> etree.XMLSchema:
    folder.mkdir()
    facts = table(format)
    main = generate_schema(facts, facts.newest, "1.0", xacro=True)
    for name, text in {"main.xsd": main, **imported_schemas()}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return etree.XMLSchema(etree.parse(folder / "main.xsd"))


def _of_dialects(found: AbstractSet[Rule]) -> bool:
    """Whether there is nothing unusual in it but the syntax of dialects and of other versions."""
    return not found & {*_REFUSED_BY_ALL, rules.UNKNOWN_ELEMENT}


def _readers_take(file: CorpusFile) -> bool:
    return file.row.get("libsdformat12") == "ok" and file.row.get("check_urdf") in {"ok", "", None}


@cache
def _lenient(name: str, version: Version) -> XMLSchema11:
    return XMLSchema11(lenient_schema_text(name, version, "1.1"), allow="none")


@cache
def _projection(name: str, version: Version) -> etree.XMLSchema:
    root: XmlElement = etree.fromstring(lenient_schema_text(name, version).encode())
    return etree.XMLSchema(root)
