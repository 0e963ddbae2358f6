"""Findings with columns: the piece that is wrong, in files of all kinds."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from twinform.compiler.input.finding_spans import SourceFiles, located, with_columns
from twinform.diagnostics import Diagnostic, Location, Severity
from twinform.diagnostics.rules import UNKNOWN_ELEMENT

from .test_syntax_places import ENCODINGS, place_of

HEAD = '<robot name="r">\n  <link name="a"/>\n  '
FOUND = {
    "a value": HEAD + '<link name="b"><inertial><mass value="«heavy»"/></inertial></link></robot>',
    "a name": HEAD + '<link «nam»="b" name="c"/></robot>',
    "an element": HEAD + "<«lnik»/></robot>",
    "what is missing": HEAD + "<«link»/></robot>",
    "on another line than its tag": HEAD
    + '<joint\n    name="j"\n    type="«hinge»"\n  ><parent link="a"/><child link="a"/></joint></robot>',
    "after tabs and wide letters": HEAD + '<!-- 中文 \U0001f600 -->\t<link name="e\u0301" «x»="1"/></robot>',
    "after two hyphens in a comment": HEAD + '<!-- a -- b --><link name="b" «x»="1"/></robot>',
    "of a reference": HEAD + '<gazebo reference="a"><«nothing»>1</nothing></gazebo></robot>',
    "with a prefix": HEAD
    + '<gazebo reference="a"><sensor name="s" type="camera" xmlns:g="u" g:x="1"><camera><«foo»/></camera>'
    "</sensor></gazebo></robot>",
    "text": '<sdf version="1.9">\n<model name="m">«stray»<link name="a"/></model></sdf>',
    "text with a comment in it": '<sdf version="1.9">\n<model name="m"><link name="a"><pose>«1 2 '
    "<!-- 3 --> 3 0 0 0»</pose></link></model></sdf>",
    "one number of several": '<sdf version="1.9">\n<model name="m"><link name="a"><pose>0 0 0 0 0 «90»'
    "</pose></link></model></sdf>",
    "in two roots of one name": '<sdf version="1.9">\n<world name="w"><model name="m"><link name="a"/>'
    "<«lnk»/></model></world></sdf>",
}


def _places(found: tuple[Diagnostic, ...]) -> list[tuple[int, ...]]:
    return [each.location[1:2] + each.location[3:] for each in found]


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("name", FOUND)
def test_the_piece_is_found(name: str, encoding: str) -> None:
    text, place = place_of(FOUND[name])
    if encoding == "utf-16" and "<!-- 3" in text:
        return  # what is asked of the bytes is not asked in UTF-16, which no reader of models takes
    for data in (text, text.replace("\n", "\r\n")):
        assert place in _places(located(twinform.check(data.encode(encoding), name="r")))


def test_latin_1_is_counted_in_letters() -> None:
    text, place = place_of(
        "<?xml version='1.0' encoding='iso-8859-1'?>\n<robot name='ü' «nam»='x'><link name='a'/></robot>"
    )
    assert place in _places(located(twinform.check(text.encode("latin-1"))))


def test_lines_beyond_those_that_libxml2_counts() -> None:
    links = "".join(f'<link name="l{n}"/>\n\n\n\n' for n in range(20_000))
    text = f'<robot name="r">\n{links}<link name="last"><visual>\n<«foo»/></visual></link></robot>'
    text, place = place_of(text)
    assert place in _places(located(twinform.check(text.encode())))


def test_a_file_without_findings_is_not_looked_at() -> None:
    files = SourceFiles({"r": b"<robot"})
    assert with_columns((), files) == ()
    assert located(twinform.check(b"<robot name='r'><link name='a'/></robot>")) == ()


@pytest.mark.parametrize(
    "where",
    [
        Location("r.urdf", 1, "/robot/link[@name='b']"),
        Location("r.urdf", 2, "/robot/link[@name='a']"),
        Location("r.urdf", 7, "/robot"),
        Location("r.urdf", 9, ""),
        Location("r.urdf", 0, ""),
        Location("other.urdf", 1, "/robot"),
        Location("r.urdf", 1, "/sdf/@"),
        Location("r.urdf", 1, "no path"),
    ],
)
def test_where_there_is_doubt_there_is_no_column(where: Location) -> None:
    files = SourceFiles({"r.urdf": b"<robot name='r'><link name='a'/><link name='a'/></robot>"})
    one = Diagnostic(UNKNOWN_ELEMENT, "odd", where, Severity.ERROR)
    assert with_columns((one,), files) == (one,)


def test_json_has_lines_only(tmp_path: Path) -> None:
    file = tmp_path / "r.json"
    document = twinform.loads('<robot name="r"><link name="a"/></robot>')
    file.write_text(twinform.dumps(document, to="json").replace('"a"', '""'))
    loaded = twinform.check(file)
    found = located(loaded)
    assert found
    assert all(each.location.line and not each.location.column for each in found)
    assert (SourceFiles.of(loaded).line(str(file), found[0].location.line) or "").strip() == "{"


def test_a_part_of_an_included_file_is_found_in_that_file(tmp_path: Path) -> None:
    link = '<link name="a"><pose «frame»="x">0 0 0 0 0 0</pose></link>'
    inner, place = place_of(f'<sdf version="1.9">\n<model name="m">\n {link}</model></sdf>')
    (tmp_path / "m.sdf").write_text(inner)
    world = tmp_path / "w.sdf"
    world.write_text('<sdf version="1.9"><world name="w"><include><uri>m.sdf</uri></include></world></sdf>')
    found = located(twinform.check(world, expand_includes=True))
    places = [(each.location.file, *each.location[1:2], *each.location[3:]) for each in found]
    assert (os.fspath(tmp_path / "m.sdf"), *place) in places


def test_files_that_are_gone_pipes_or_changed_have_no_places(tmp_path: Path) -> None:
    file = tmp_path / "r.urdf"
    file.write_text("<robot name='r'><link name='a'/><foo/></robot>")
    loaded = twinform.check(file)
    (found,) = loaded.diagnostics
    assert with_columns((found,), SourceFiles())[0].location.column == 34
    file.write_text("<robot name='r'>\n<link name='a'/></robot>")
    assert with_columns((found,), SourceFiles()) == (found,)
    file.unlink()
    assert with_columns((found,), SourceFiles()) == (found,)
    os.mkfifo(file)
    assert with_columns((found,), SourceFiles()) == (found,)
    assert SourceFiles().line(os.fspath(file), 1) is None


def test_source_files_know_lines_and_places() -> None:
    files = SourceFiles({"a": "ä\r\nbc\rd".encode()})
    assert [files.line("a", number) for number in range(6)] == [None, "ä", "bc", "d", None, None]
    assert [files.place("a", offset) for offset in (0, 1, 3, 7)] == [(1, 1), (1, 2), (2, 1), (3, 2)]
    assert files.place("a", 8) is None
    assert files.place("nothing", 0) is None
    assert SourceFiles({"a": b"\xff"}).line("a", 1) is None


SEED = (
    b'<?xml version="1.0"?>\n<robot name="r" x="1">\r\n\t<link name="a"><!-- - --><inertial><mass value="m"/>'
    b'</inertial></link>\n<joint name="j" type="fixd"><parent link="b"/><child link="a"/></joint>'
    b"<![CDATA[x]]><g:y/></robot>"
)
EDITS = st.tuples(
    st.integers(0, len(SEED)),
    st.integers(0, 6),
    st.sampled_from([b"", b"<", b">", b'"', b"--", b"\xff", b"\n", b"&", b"'"]),
)


@given(st.lists(EDITS, min_size=1, max_size=3))
def test_whatever_is_in_a_file_each_finding_has_a_place_in_it_or_none(edits: list[tuple[int, int, bytes]]) -> None:
    data = SEED
    for start, count, new in edits:
        data = data[:start] + new + data[start + count :]
    loaded = twinform.check(data, name="r")
    found, files = located(loaded), SourceFiles.of(loaded)
    assert len(found) == len(loaded.diagnostics)
    for each in found:
        where = each.location
        if where.column:
            assert where[1:2] + where[3:4] <= where[4:]
            line = files.line("r", where.line)
            assert line is None or where.column <= len(line) + 1
