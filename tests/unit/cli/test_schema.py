import json
from pathlib import Path

import pytest
from lxml import etree

from twinform.schemas import table

from .conftest import GOOD, Run

VERSIONS = [(language, version) for language in ("urdf", "sdf") for version in table(language).versions]


@pytest.mark.parametrize(("language", "version"), VERSIONS)
def test_every_version_has_a_schema_that_libxml2_compiles(run: Run, language: str, version: str) -> None:
    done = run("schema", language, "--version", version, "--xsd", "1.0")
    assert done.exit_code == 0
    etree.XMLSchema(etree.fromstring(done.stdout_bytes))


def test_the_newest_version_and_xsd_1_0_which_editors_read_are_the_default(run: Run) -> None:
    assert run("schema", "sdf").stdout == run("schema", "sdf", "--version", "1.12", "--xsd", "1.0").stdout
    assert "xs:assert" in run("schema", "sdf", "--xsd", "1.1").stdout


def test_a_lenient_schema_takes_dialects(run: Run) -> None:
    robot = etree.fromstring('<robot name="r"><link name="a" odd="1"><contact/></link><mujoco/></robot>')
    strict, lenient = (run("schema", "urdf", *words).stdout_bytes for words in ((), ("--lenient",)))
    assert not etree.XMLSchema(etree.fromstring(strict)).validate(robot)
    assert etree.XMLSchema(etree.fromstring(lenient)).validate(robot)
    newer = run("schema", "urdf", "--lenient", "--xsd", "1.1").stdout
    assert "##definedSibling" in newer


def test_the_schema_of_json_is_a_json_schema(run: Run) -> None:
    schema = json.loads(run("schema", "json").stdout)
    assert schema["$id"] == "urn:twinform:document:1"
    assert schema["$defs"]["Joint"]["properties"]["parent"]["description"]


def test_a_file_is_written(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "urdf.xsd"
    assert run("schema", "urdf", "--xsd", "1.0", "-o", file).stdout == ""
    assert etree.XMLSchema(etree.parse(file)).validate(etree.fromstring(GOOD))


def test_the_schema_of_xacro_files_is_written_with_those_that_it_imports(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "robot.xsd"
    assert run("schema", "urdf", "--xacro", "-o", file).exit_code == 0
    assert len(list(tmp_path.iterdir())) == 4
    head = '<robot xmlns:xacro="http://ros.org/wiki/xacro">'
    schema = etree.XMLSchema(etree.parse(file))
    assert schema.validate(etree.fromstring(head + '<xacro:arg name="a" default="${b}"/></robot>'))
    assert not schema.validate(etree.fromstring(head + '<xacro:arg name="a"/></robot>'))


def test_a_schema_that_would_be_written_over_is_an_error(run: Run, tmp_path: Path) -> None:
    done = run("schema", "urdf", "--xacro", "-o", tmp_path / "xacro-ros.org.xsd")
    assert (done.exit_code, list(tmp_path.iterdir())) == (2, [])


WRONG = [
    "sdf --version 9.9",
    "usd",
    "",
    "json --version 1",
    "json --lenient",
    "json --xsd 1.0",
    "json --xacro -o a",
    "mjcf --xacro -o a",
    "urdf --xacro",
    "urdf --xacro --xsd 1.1 -o a",
]


@pytest.mark.parametrize("arguments", [words.split() for words in WRONG])
def test_what_does_not_exist_exits_2(run: Run, arguments: list[str]) -> None:
    assert run("schema", *arguments).exit_code == 2
