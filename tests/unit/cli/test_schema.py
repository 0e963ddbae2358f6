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


def test_the_newest_version_and_xsd_1_1_are_the_default(run: Run) -> None:
    assert run("schema", "sdf").stdout == run("schema", "sdf", "--version", "1.12", "--xsd", "1.1").stdout


def test_a_file_is_written(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "urdf.xsd"
    assert run("schema", "urdf", "--xsd", "1.0", "-o", file).stdout == ""
    assert etree.XMLSchema(etree.parse(file)).validate(etree.fromstring(GOOD))


@pytest.mark.parametrize("arguments", [["sdf", "--version", "9.9"], ["mjcf"], []])
def test_what_does_not_exist_exits_2(run: Run, arguments: list[str]) -> None:
    assert run("schema", *arguments).exit_code == 2
