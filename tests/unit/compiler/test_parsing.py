"""Input may be anything."""

from pathlib import Path

import pytest

import twinform
from twinform.compiler import check
from twinform.compiler.limits import LARGEST
from twinform.compiler.parsing import parse
from twinform.diagnostics import Notes

_LINK = b'<link name="a"/>'
_ROBOT = b'<robot name="r">' + _LINK + b"</robot>"

REFUSED = {
    "empty": (b"", "unreadable-file"),
    "blank": (b" \n\t", "unreadable-file"),
    "not XML": (b"robot: r", "not-well-formed"),
    "NUL": (b'<robot name="r\x00"/>', "not-well-formed"),
    "NUL first": (b"\x00\xff", "not-well-formed"),
    "bad UTF-8": (b'<robot name="\xff"/>', "not-well-formed"),
    "truncated": (b'<robot name="r"><link name="a"', "not-well-formed"),
    "two roots": (_ROBOT + _ROBOT, "not-well-formed"),
    "external entity": (
        b'<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot name="&x;"/>',
        "not-well-formed",
    ),
    "external DTD": (b'<!DOCTYPE robot SYSTEM "http://example.org/robot.dtd">' + _ROBOT, "doctype"),
    "default attributes": (b'<!DOCTYPE r [<!ATTLIST link name CDATA "a">]><robot name="r"><link/></robot>', "doctype"),
    "deep": (b"<a>" * 300 + b"</a>" * 300, "oversized-file"),
    "long text": (b'<robot name="' + b"r" * 11_000_000 + b'"/>', "oversized-file"),
    "another format": (b"<mujoco/>", "unknown-root"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_model_is_refused_with_one_rule(name: str) -> None:
    text, rule = REFUSED[name]
    checked = check(text)
    assert checked.unreadable
    assert [each.rule.name for each in checked.diagnostics if each.is_error] == [rule]


def test_entity_bombs_do_not_go_off() -> None:
    levels = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 30))
    bomb = f'<!DOCTYPE robot [<!ENTITY e0 "x">{levels}]><robot name="r">&e29;</robot>'
    assert check(bomb.encode()).unreadable


ACCEPTED = {
    "UTF-16": _ROBOT.decode().encode("utf-16"),
    "byte order mark": b"\xef\xbb\xbf" + _ROBOT,
    "Latin-1": '<?xml version="1.0" encoding="iso-8859-1"?><robot name="é"><link name="a"/></robot>'.encode("latin-1"),
    "CRLF": _ROBOT.replace(b"><", b">\r\n<"),
    "CDATA and comments": b'<robot name="r"><!-- c --><![CDATA[ ]]>' + _LINK + b"<?pi x?></robot>",
}


@pytest.mark.parametrize("name", ACCEPTED)
def test_what_is_xml_is_read(name: str) -> None:
    checked = check(ACCEPTED[name])
    assert [each.message for each in checked.diagnostics] == []


PREFIXED = b"""<robot name="r" xmlns:k="urn:known">
<link name="a" k:x="1" y:z="2"><w:part k:q="3"/><k:part y:name="4"/></link>
<y:link z="5" k:v="6" xml:space="preserve"/></robot>"""
_UNDECLARED = "{urn:twinform:undeclared:"


def test_only_names_of_undeclared_prefixes_get_a_namespace() -> None:
    notes = Notes("r.urdf")
    root = parse(PREFIXED, notes)
    assert [(each.tag, dict(each.attrib)) for each in root.iter()] == [
        ("robot", {"name": "r"}),
        ("link", {"name": "a", "{urn:known}x": "1", f"{_UNDECLARED}y}}z": "2"}),
        (f"{_UNDECLARED}w}}part", {"{urn:known}q": "3"}),
        ("{urn:known}part", {f"{_UNDECLARED}y}}name": "4"}),
        (
            f"{_UNDECLARED}y}}link",
            {"z": "5", "{urn:known}v": "6", "{http://www.w3.org/XML/1998/namespace}space": "preserve"},
        ),
    ]
    said = [(each.rule.name, each.location.file, each.location.line, each.message) for each in notes.diagnostics]
    assert said == [
        ("repaired-xml", "r.urdf", line, f"not well-formed XML, repaired: Namespace prefix {what} is not defined")
        for line, what in [(2, "y for z on link"), (2, "w on part"), (2, "y for name on part"), (3, "y on link")]
    ]


def test_a_million_mistakes_are_reported_a_thousand_times() -> None:
    checked = check(b'<robot name="r">' + _LINK + b"<x/>" * 5000 + b"</robot>")
    assert 1000 <= len(checked.diagnostics) <= 1001


def test_files_that_cannot_be_read_say_so(tmp_path: Path) -> None:
    big = tmp_path / "big.urdf"
    with big.open("wb") as file:
        file.truncate(LARGEST + 1)
    for path in (tmp_path / "nowhere.urdf", tmp_path, big, Path("a\0b")):
        checked = check(path)
        assert checked.unreadable
        assert [each.rule.name for each in checked.diagnostics] == ["unreadable-file"]


def test_errors_carry_their_diagnostics() -> None:
    with pytest.raises(twinform.CompileError, match="is there twice") as caught:
        twinform.loads('<robot name="r"><link name="a"/><link name="a"/></robot>')
    assert [each.rule.name for each in caught.value.diagnostics] == ["duplicate-name", "several-roots"][:1]


def test_a_document_is_its_own_format() -> None:
    document = twinform.loads(_ROBOT)
    text = twinform.convert(_ROBOT, to="json").text
    assert twinform.loads(text) == document


@pytest.mark.parametrize("text", ["{}", '{"format": "urdf", "links": []}', "{", '{"format": "mjcf"}'])
def test_json_that_is_no_document_is_refused(text: str) -> None:
    with pytest.raises(twinform.CompileError):
        twinform.loads(text)
