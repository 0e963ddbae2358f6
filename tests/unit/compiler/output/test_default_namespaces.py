"""Prefixes and their namespaces, wherever a file declares them, and however many there are."""

from typing import Literal

import pytest
from lxml import etree

import twinform
from twinform.schemas.xml import path_of, prefix_of


def namespaces(text: str) -> dict[str, str]:
    return dict(twinform.loads(f'<robot name="r" {text}</robot>').namespaces)


def test_all_that_are_declared_are_known_and_each_once() -> None:
    inner = '<link name="a" xmlns:b="urn:b"><b:x xmlns:c="urn:c"><c:y xmlns:a="urn:a"/></b:x></link>'
    assert namespaces(f'xmlns:a="urn:a">{inner}') == {"a": "urn:a", "b": "urn:b", "c": "urn:c"}


def test_a_prefix_of_two_namespaces_is_two() -> None:
    inner = "".join(f'<p:x xmlns:p="urn:{n}"/>' for n in (0, 1, 2, 1))
    found = namespaces(f'xmlns:p2="urn:other"><link name="a"/>{inner}')
    assert found == {"p": "urn:0", "p2": "urn:other", "p3": "urn:1", "p4": "urn:2"}


def test_undeclared_prefixes_are_known_too() -> None:
    found = namespaces('xmlns:a="urn:a"><link name="l"/><q:x/><link name="m" q:y="1" a:y="1"/>' + _JOINT)
    assert {prefix: uri.rpartition(":")[2] for prefix, uri in found.items()} == {"a": "a", "q": "q"}


_JOINT = '<joint name="j" type="fixed"><parent link="l"/><child link="m"/></joint>'


def test_names_are_shown_with_the_prefix_that_they_were_written_with() -> None:
    root = etree.fromstring('<r xmlns:a="urn:1" xmlns:b="urn:1"><b:x a:y="1" b:z="2"/></r>')
    (child,) = root
    assert path_of(child) == "/r/b:x"
    assert [prefix_of(child, str(name)) for name in child.attrib] == ["a", "b"]
    assert prefix_of(root, "r") is None


def written(content: str, root: str = "", to: Literal["urdf", "sdf"] = "urdf") -> str:
    plugin = f'<plugin name="p" filename="p.so">{content}</plugin>'
    text = f'<robot name="r" {root}><link name="a"/><gazebo>{plugin}</gazebo></robot>'
    made = twinform.convert(text.encode(), to=to).text
    again = twinform.convert(made.encode(), to=to).text
    assert again == made or "xmlns:ns0" in made
    inside = made.partition("<plugin")[2].partition(">")[2].partition("</plugin>")[0]
    return " ".join(inside.split()).replace("> <", "><")


INSIDE = {
    "alone": '<param xmlns="urn:v"><gain>1</gain></param>',
    "with others in it": '<param xmlns="urn:v"><b xmlns="urn:2"><c/></b><gain>1</gain></param>',
    "twice": '<a xmlns="urn:v"/><b xmlns="urn:v"/>',
    "with text around": '<a xmlns="urn:v">x</a>y',
}


@pytest.mark.parametrize("to", ["urdf", "sdf"])
@pytest.mark.parametrize("root", ["", 'xmlns="urn:r"'])
@pytest.mark.parametrize("name", INSIDE)
def test_a_default_namespace_stays_one(name: str, root: str, to: Literal["urdf", "sdf"]) -> None:
    assert written(INSIDE[name], root, to) == INSIDE[name]


def test_a_default_on_the_root_stays_beside_others() -> None:
    plugin = '<plugin name="p" filename="p"><b xmlns="urn:v"/></plugin>'
    text = f'<sdf xmlns="urn:r" version="1.11"><model name="m"><link name="a"/>{plugin}</model></sdf>'
    made = twinform.convert(text.encode(), to="sdf").text
    assert etree.fromstring(made).nsmap == {None: "urn:r"}
    assert '<b xmlns="urn:v"/>' in made
    assert {str(each.tag) for each in etree.fromstring(made).iter()} == {
        str(each.tag) for each in etree.fromstring(text).iter()
    }


def test_a_prefix_that_is_declared_is_used() -> None:
    assert written('<ns0:a xmlns:ns0="urn:v"/>') == "<ns0:a/>"
    assert written('<v:a/><b xmlns="urn:v"/>', 'xmlns:v="urn:v"') == "<v:a/><v:b/>"


def test_a_default_takes_in_no_part_without_a_namespace() -> None:
    inside = written('<a xmlns="urn:v"><b xmlns=""/></a>')
    assert [each.tag for each in etree.fromstring(f"<x>{inside}</x>").iter()] == ["x", "{urn:v}a", "b"]


def test_attributes_keep_their_namespace() -> None:
    inside = written('<a xmlns="urn:v" xmlns:w="urn:v" w:b="1"/>')
    (element,) = etree.fromstring(f'<x xmlns:w="urn:v">{inside}</x>')
    assert (element.tag, dict(element.attrib)) == ("{urn:v}a", {"{urn:v}b": "1"})
