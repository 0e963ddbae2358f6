"""Canonical MJCF: what is not in the case files, such as hostile sizes, and where findings about it are."""

from pathlib import Path

import pytest
from lxml import etree

import twinform
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.mjcf.normalize import normalize
from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.ir import Link
from twinform.schemas import Context, XmlElement, known_version, versions_of


def _normalized(text: str) -> tuple[XmlElement | None, list[Diagnostic]]:
    sink = DiagnosticSink("robot.xml")
    version = known_version("mjcf", versions_of("mjcf")[-1])
    assert version is not None
    tree = normalize(etree.fromstring(text), Context(sink, sink.file, "mjcf", version), LoadOptions())
    return tree, sink.diagnostics


def _rules(found: list[Diagnostic]) -> set[str]:
    return {each.rule.name for each in found}


def _world(text: str) -> str:
    return f"<mujoco><worldbody>{text}</worldbody></mujoco>"


def test_the_tree_is_left_as_it_is() -> None:
    text = _world("<frame pos='0 0 1'><geom size='1' euler='90 0 0'/></frame>")
    root = etree.fromstring(text)
    sink = DiagnosticSink()
    version = known_version("mjcf", versions_of("mjcf")[-1])
    assert version is not None
    assert normalize(root, Context(sink, "", "mjcf", version), LoadOptions()) is not None
    assert etree.tostring(root) == etree.tostring(etree.fromstring(text))


def test_elements_keep_the_lines_that_they_were_written_on() -> None:
    tree, _ = _normalized(
        "<mujoco>\n<worldbody>\n<replicate count='2'>\n<body name='b'/>\n</replicate>\n</worldbody></mujoco>"
    )
    assert tree is not None
    assert [(body.get("name"), body.sourceline) for body in tree.iter("body")] == [("b0", 4), ("b1", 4)]


def test_a_canonical_tree_is_its_own_canonical_tree() -> None:
    text = _world(
        "<frame pos='0 0 1' euler='90 0 0'><body name='b'><joint range='0 90'/><geom size='1'/></body></frame>"
    )
    tree, _ = _normalized(text)
    assert tree is not None
    again, _ = _normalized(etree.tostring(tree, encoding="unicode"))
    assert again is not None
    assert etree.tostring(again) == etree.tostring(tree)


_MANY_FOLLOWERS = (
    "<mujoco><worldbody><replicate count='10000'><site name='s'/></replicate></worldbody><sensor>"
    + "<touch site='s'/>" * 1000
    + "</sensor></mujoco>"
)


@pytest.mark.parametrize(
    "text",
    [
        _world("<replicate count='1000000000'><geom size='1'/></replicate>"),
        _world("<replicate count='100'>" * 10 + "<geom size='1'/>" + "</replicate>" * 10),
        _MANY_FOLLOWERS,
    ],
    ids=["many copies", "copies of copies", "what refers to copies"],
)
def test_copies_are_counted_before_they_are_made(text: str) -> None:
    _, found = _normalized(text)
    assert "oversized-file" in _rules(found)


@pytest.mark.parametrize("count", ["0", "-3", "1e9", "", "99999999999999999999999"])
def test_a_replicate_without_copies_is_nothing(count: str) -> None:
    tree, found = _normalized(_world(f"<replicate count='{count}'/>"))
    assert tree is not None
    assert [*tree.iter("replicate")] == found == []


@pytest.mark.parametrize("numbers", ["nan 1 1 0 0 0", "inf 1 1 0 0 0", "1 1 1 2 0 0"])
def test_an_inertia_that_is_no_number_is_found(numbers: str) -> None:
    _, found = _normalized(_world(f"<body><inertial pos='0 0 0' mass='1' fullinertia='{numbers}'/></body>"))
    assert _rules(found) == {"indefinite-inertia"}


@pytest.mark.parametrize("sequence", ["xy", "abc", "xyzx", ""])
def test_a_sequence_of_axes_that_is_none_is_found(sequence: str) -> None:
    _, found = _normalized(
        f"<mujoco><compiler eulerseq='{sequence}'/><worldbody><body euler='1 2 3'/></worldbody></mujoco>"
    )
    assert _rules(found) == {"invalid-value"}


def test_deep_trees_need_no_recursion() -> None:
    tree, found = _normalized(_world("<frame pos='0 0 1'>" * 200 + "<geom size='1'/>" + "</frame>" * 200))
    assert tree is not None
    assert found == []
    assert next(tree.iter("geom")).get("pos") == "0 0 200"
    assert "oversized-file" in _rules(
        [*twinform.check(_world("<body>" * 1000 + "</body>" * 1000).encode()).diagnostics]
    )


def test_a_finding_in_an_included_file_is_reported_there(tmp_path: Path) -> None:
    (tmp_path / "main.xml").write_text("<mujoco>\n<worldbody>\n<include file='arm.xml'/>\n</worldbody>\n</mujoco>\n")
    (tmp_path / "arm.xml").write_text(
        "<mujocoinclude>\n<body>\n\n<geom size='0.1' class='no'/></body></mujocoinclude>\n"
    )
    (found,) = [each for each in twinform.check(tmp_path / "main.xml").diagnostics if each.is_error]
    assert (found.rule.name, found.location.file, found.location.line) == (
        "unknown-class",
        str(tmp_path / "arm.xml"),
        4,
    )


def test_files_of_others_are_not_included(tmp_path: Path) -> None:
    (tmp_path / "secret.xml").write_text("<x><body name='secret'/></x>")
    (tmp_path / "robot").mkdir()
    main = tmp_path / "robot" / "main.xml"
    main.write_text("<mujoco><worldbody><include file='../secret.xml'/></worldbody></mujoco>")
    found = twinform.check(main).diagnostics
    assert [each.rule.name for each in found] == ["unreadable-file"]
    assert not [each for each in twinform.check(main, paths=[tmp_path]).diagnostics if each.is_error]


def test_a_nested_include_is_looked_for_beside_the_main_file_first(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "main.xml").write_text("<mujoco><worldbody><include file='parts/a.xml'/></worldbody></mujoco>")
    (tmp_path / "parts" / "a.xml").write_text("<x><include file='b.xml'/></x>")
    (tmp_path / "parts" / "b.xml").write_text("<x><body name='beside'><geom size='1'/></body></x>")
    assert [link.name for link in _links(tmp_path / "main.xml")] == ["beside"]
    (tmp_path / "b.xml").write_text("<x><body name='above'><geom size='1'/></body></x>")
    assert [link.name for link in _links(tmp_path / "main.xml")] == ["above"]


def _links(path: Path) -> list[Link]:
    document = twinform.load(path)
    models = [*document.models, *(model for world in document.worlds for model in world.models)]
    return [link for model in models for link in model.links]


def test_a_text_that_is_no_file_includes_nothing() -> None:
    found = twinform.check(_world("<include file='arm.xml'/>").encode()).diagnostics
    assert [each.rule.name for each in found if each.is_error] == ["include-not-expanded"]


def test_frames_have_names_of_their_own() -> None:
    _, found = _normalized(_world("<frame name='f'/><frame name='f'/><body name='f'/>"))
    assert _rules(found) == {"duplicate-name"}


def test_a_document_in_the_terms_of_mjcf_keeps_its_includes(tmp_path: Path) -> None:
    (tmp_path / "main.xml").write_text("<mujoco><worldbody><include file='arm.xml'/></worldbody></mujoco>")
    (tmp_path / "arm.xml").write_text("<x><body name='arm'/></x>")
    text = twinform.convert(tmp_path / "main.xml", to="mjcf").text
    assert '<include file="arm.xml"/>' in text
