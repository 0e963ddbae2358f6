"""Input may be anything."""

from pathlib import Path

import pytest
from lxml import etree

import twinform
from twinform.compiler import check
from twinform.compiler.input.parsing import UnreadableError, parse, read_bytes, strip_default_namespace
from twinform.compiler.input.size_limits import LARGEST, Limits
from twinform.diagnostics import DiagnosticSink, Location

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
    "another format": (b"<scene/>", "unknown-root"),
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
    "byte order mark": b"\xef\xbb\xbf" + _ROBOT,
    "Latin-1": '<?xml version="1.0" encoding="iso-8859-1"?><robot name="é"><link name="a"/></robot>'.encode("latin-1"),
    "CRLF": _ROBOT.replace(b"><", b">\r\n<"),
    "CDATA and comments": b'<robot name="r"><!-- c --><![CDATA[ ]]>' + _LINK + b"<?pi x?></robot>",
}


@pytest.mark.parametrize("name", ACCEPTED)
def test_what_is_xml_is_read(name: str) -> None:
    checked = check(ACCEPTED[name])
    assert [each.message for each in checked.diagnostics] == []


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_what_has_several_bytes_for_a_letter_is_read_with_a_warning(encoding: str) -> None:
    text = '<?xml version="1.0" encoding="UTF-16"?>' + _ROBOT.decode()
    checked = check(text.encode(encoding))
    assert [(each.rule.name, str(each.severity), each.help) for each in checked.diagnostics] == [
        ("wide-encoding", "warning", "save the file as UTF-8")
    ]
    assert checked.document == check(_ROBOT).document
    assert not check(text.encode(encoding), strict=True).accepted


PREFIXED = b"""<robot name="r" xmlns:k="urn:known">
<link name="a" k:x="1" y:z="2"><w:part k:q="3"/><k:part y:name="4"/></link>
<y:link z="5" k:v="6" xml:space="preserve"/></robot>"""
_UNDECLARED = "{urn:twinform:undeclared:"


def test_only_names_of_undeclared_prefixes_get_a_namespace_and_each_prefix_is_one_finding() -> None:
    sink = DiagnosticSink("r.urdf")
    root = parse(PREFIXED, sink)
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
    findings = [(each.rule.name, each.location.file, each.location.line, each.message) for each in sink.diagnostics]
    assert findings == [
        ("repaired-xml", "r.urdf", line, f"not well-formed XML, repaired: the prefix {what} is not declared")
        for line, what in [
            (2, "'y' of the attribute y:z"),
            (2, "'w' of <w:part>"),
        ]
    ]


def test_a_million_mistakes_are_reported_a_thousand_times() -> None:
    checked = check(b'<robot name="r">' + _LINK + b"<x/>" * 5000 + b"</robot>")
    assert 1000 <= len(checked.diagnostics) <= 1001


def test_files_that_cannot_be_read_are_reported(tmp_path: Path) -> None:
    big = tmp_path / "big.urdf"
    with big.open("wb") as file:
        file.truncate(LARGEST + 1)
    for path in (tmp_path / "nowhere.urdf", tmp_path, big, Path("a\0b")):
        checked = check(path)
        assert checked.unreadable
        assert [each.rule.name for each in checked.diagnostics] == ["unreadable-file"]


def test_errors_carry_their_diagnostics() -> None:
    with pytest.raises(twinform.CompileError, match="is defined twice") as caught:
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


NO_MODEL = "a model begins with '<': delete what stands before it, or name another file if this is no model"
NO_START = "not well-formed XML: the file ends before its first tag"
NO_TAG = "write <robot> or <sdf> with the model in it"
ENCODING = "save the file as UTF-8, or name an encoding that it may have, such as UTF-8 or ISO-8859-1"
CROWD = " ".join(f"{{}}a{n}='1'" for n in range(257))
NOWHERE = Location("r.urdf")
TOP = Location("r.urdf", 1, "/")

FINDINGS: dict[str, tuple[bytes, list[tuple[str, Location, str, str | None]]]] = {
    "nothing": (b" \n", [("unreadable-file", NOWHERE, "the file is empty", None)]),
    "no element": (
        b"<!-- a -->",
        [("not-well-formed", TOP._replace(column=11, end_line=1, end_column=11), NO_START, NO_TAG)],
    ),
    "zero bytes": (
        b"\0\0",
        [
            (
                "not-well-formed",
                TOP._replace(column=1, end_line=1, end_column=2),
                "not well-formed XML: the file does not begin with a tag",
                NO_MODEL,
            )
        ],
    ),
    "a document type": (
        b"\n<!DOCTYPE robot><robot/>",
        [("doctype", Location("r.urdf", 2, "/", 1, 2, 10), "the document has a DOCTYPE; none is allowed", None)],
    ),
    "an encoding": (
        b"<?xml version='1.0' encoding='utf-7'?><robot/>",
        [("not-well-formed", TOP, "the encoding 'utf-7' is none that models are written in", ENCODING)],
    ),
    "a crowd": (
        f"<robot>\n<link {CROWD.format(*[''] * 257)}/></robot>".encode(),
        [
            (
                "oversized-file",
                Location("r.urdf", 2, "/robot/link"),
                "<link> has 257 attributes; the limit is 256",
                None,
            )
        ],
    ),
    "a crowd with a prefix": (
        f"<robot {CROWD.format(*['x:'] * 257)}/>".encode(),
        [("oversized-file", Location("r.urdf", 1, "/robot"), "<robot> has 257 attributes; the limit is 256", None)],
    ),
}


@pytest.mark.parametrize("name", FINDINGS)
def test_why_there_is_no_tree_is_all_that_is_reported(name: str) -> None:
    text, expected = FINDINGS[name]
    sink = DiagnosticSink("r.urdf")
    with pytest.raises(UnreadableError):
        parse(text, sink)
    assert [(each.rule.name, each.location, each.message, each.help) for each in sink.diagnostics] == expected


@pytest.mark.parametrize(
    ("path", "reason"),
    [("nowhere", "No such file or directory"), (".", "Is a directory"), ("a\0b", "no file can have such a name")],
)
def test_why_a_file_cannot_be_read_is_reported(path: str, reason: str) -> None:
    sink = DiagnosticSink("r.urdf")
    with pytest.raises(UnreadableError):
        read_bytes(Path(path), sink)
    (found,) = sink.diagnostics
    assert (found.rule.name, found.location, found.message) == (
        "unreadable-file",
        NOWHERE,
        f"cannot read the file: {reason}",
    )


def test_a_file_may_have_as_many_bytes_as_the_limit(tmp_path: Path) -> None:
    few = Limits(size=1000)
    path = tmp_path / "r.urdf"
    path.write_bytes(b"x" * 1000)
    sink = DiagnosticSink("r.urdf")
    assert read_bytes(path, sink, few) == b"x" * 1000
    assert sink.diagnostics == []
    path.write_bytes(b"x" * 1001)
    with pytest.raises(UnreadableError):
        read_bytes(path, sink, few)
    assert [(each.location, each.message) for each in sink.diagnostics] == [
        (NOWHERE, "the file has more than 1,000 bytes, which is the limit")
    ]


@pytest.mark.parametrize("flaw", ["", " z:z='1'"])
def test_comments_and_instructions_are_left_out(flaw: str) -> None:
    """The same where the text is fixed."""
    root = parse(
        f"<!-- a --><robot{flaw}>a<!-- b -->c<?p?>d<link/>e<!-- f -->g</robot><?q?>".encode(), DiagnosticSink()
    )
    assert [(each.tag, each.text, each.tail) for each in root.iter()] == [("robot", "acd", None), ("link", None, "eg")]
    assert root.getprevious() is None
    assert root.getnext() is None


@pytest.mark.parametrize(
    ("text", "namespace", "tags"),
    [
        ("<a xmlns='urn:a'><b/><c xmlns='urn:c'/></a>", "urn:a", ["a", "b", "{urn:c}c"]),
        ("<a xmlns='urn:a' xmlns:p='urn:a'><p:b/></a>", "urn:a", ["a", "b"]),
        ("<a xmlns='urn:a' xmlns:p='urn:p'><p:b/></a>", "urn:a", ["a", "{urn:p}b"]),
        ("<p:a xmlns:p='urn:p'><b/></p:a>", None, ["{urn:p}a", "b"]),
        ("<a><b xmlns='urn:b'/></a>", None, ["a", "{urn:b}b"]),
    ],
)
def test_the_default_namespace_of_the_root_is_taken_off(text: str, namespace: str | None, tags: list[str]) -> None:
    root = etree.fromstring(text)
    assert strip_default_namespace(root) == namespace
    assert [each.tag for each in root.iter()] == tags
