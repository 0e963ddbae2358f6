"""The XSDs as files: made from the facts, and accepted by three engines."""

from collections.abc import Iterable, Iterator

import pytest
import xmlschema
from lxml import etree

from generators.schemas import FORMATS
from twinform.schemas import Fact, Version, parse_version, schema_text, table
from twinform.schemas.facts import parse_facts
from twinform.schemas.packaged import XsdVersion
from twinform.schemas.xsd import generate_schema
from twinform.schemas.xsd_values import XS

pytestmark = pytest.mark.slow

VERSIONS = [(name, parse_version(version)) for name in FORMATS for version in table(name).versions]


@pytest.mark.parametrize(("name", "version"), VERSIONS)
def test_all_engines_compile_the_schemas(name: str, version: Version):
    projection, normative = schema_text(name, version, "1.0"), schema_text(name, version)
    assert etree.XMLSchema(etree.fromstring(projection.encode())) is not None
    assert xmlschema.XMLSchema10(projection, allow="none").built
    assert xmlschema.XMLSchema11(normative, allow="none").built


@pytest.mark.parametrize("xsd", ["1.0", "1.1"])
@pytest.mark.parametrize(("name", "version"), VERSIONS)
def test_a_schema_needs_no_other_file_and_has_one_root(name: str, version: Version, xsd: XsdVersion):
    schema = etree.fromstring(schema_text(name, version, xsd).encode())
    assert schema.get("targetNamespace") is None
    assert [child.get("name") for child in schema.iterchildren(XS + "element")] == [table(name).root]
    assert not {etree.QName(child).localname for child in schema} & {"include", "import", "redefine", "override"}


@pytest.mark.parametrize("name", FORMATS)
def test_a_version_has_one_row_of_a_name(name: str):
    facts = table(name)
    for version in map(parse_version, facts.versions):
        for fact in _with_rows(facts.definitions.values()):
            names = [row.name for row in fact.rows if row.exists_in(version)]
            assert len(names) == len(set(names)), f"{fact.name} in {version}"


def test_an_unknown_version_has_no_schema():
    with pytest.raises(FileNotFoundError):
        schema_text("sdf", (9, 9))


def test_children_of_a_free_element_cannot_be_distinguished_from_others():
    facts = table("urdf")
    (robot,) = parse_facts(["robot any", "  link *"], "robot.facts")
    odd = type(facts)("urdf", ("1.0",), "robot", {"robot": robot})
    with pytest.raises(ValueError, match="robot"):
        generate_schema(odd, (1, 0), "1.0")


def _with_rows(facts: Iterable[Fact]) -> Iterator[Fact]:
    for fact in facts:
        yield fact
        yield from _with_rows(fact.rows)
