"""Prefixes and their namespaces, wherever a file declares them, and however many there are."""

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
