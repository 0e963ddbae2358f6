"""From text to document: what is found about the root and the version, and what is there in spite of errors."""

import gc
from pathlib import Path

import pytest
from lxml import etree

import twinform
from tests.snippets import INERTIAL as BODY
from twinform.compiler import LoadResult, check, dumps
from twinform.compiler.input.front_ends import lower_tree
from twinform.compiler.input.loading import LoadOptions, garbage_collection_paused, load, loads, read
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location
from twinform.ir import Document

Finding = tuple[str, str, int, str, str, str | None, str | None]
"""A finding: rule, severity, line, path, message, found, expected."""

VERSIONS = "1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 1.10, 1.11, 1.12"
MODEL = '<model name="m"><link name="a"/></model>'
LINK = '<link name="a"/>'
XACRO = "http://www.ros.org/wiki/xacro"
UNEXPANDED = "of xacro will not be expanded"

ROOTS: dict[str, tuple[str, list[Finding]]] = {
    "another format": (
        "\n<scene/>",
        [
            (
                "unknown-root",
                "error",
                2,
                "/scene",
                "the root element is <scene>; expected <robot>, <sdf> or <mujoco>",
                "scene",
                "robot, sdf or mujoco",
            )
        ],
    ),
    "SDF 1.2 with its old root": (
        f'\n\n<gazebo version="1.2">{MODEL}</gazebo>',
        [
            (
                "old-root",
                "warning",
                3,
                "/gazebo",
                "the root of SDF 1.2 is <gazebo>; read, and written, as <sdf>",
                None,
                None,
            )
        ],
    ),
    "an old root of another language": (
        '<gazebo version="1.0"/>',
        [
            (
                "unknown-root",
                "error",
                1,
                "/gazebo",
                "the root element is <gazebo>; expected <robot>, <sdf> or <mujoco>",
                "gazebo",
                "robot, sdf or mujoco",
            )
        ],
    ),
    "a version that SDF does not have": (
        f'\n<sdf version="9">{MODEL}</sdf>',
        [("unknown-version", "warning", 2, "/sdf/@version", "SDF has no version '9'; read as 1.12", "9", VERSIONS)],
    ),
    "a version that URDF does not have": (
        f'\n<robot name="r" version="7">{LINK}</robot>',
        [
            (
                "unknown-version",
                "warning",
                2,
                "/robot/@version",
                "URDF has no version '7'; read as 1.2",
                "7",
                "1.0, 1.1, 1.2",
            )
        ],
    ),
    "SDF without a version": (
        f"<sdf>{MODEL}</sdf>",
        [("missing-attribute", "error", 1, "/sdf", "<sdf> has no attribute 'version'", None, "@version")],
    ),
    "URDF without a version": (f'<robot name="r">{LINK}</robot>', []),
    "one macro": (
        f'<robot name="r" xmlns:xacro="{XACRO}">\n{LINK}\n<xacro:arm/></robot>',
        [("unexpanded-xacro", "warning", 3, "/robot", f"1 element {UNEXPANDED}", "xacro", None)],
    ),
    "macros": (
        f'<robot name="r" xmlns:xacro="{XACRO}">{LINK}\n<xacro:arm/>\n<xacro:arm><xacro:hand/></xacro:arm></robot>',
        [("unexpanded-xacro", "warning", 2, "/robot", f"3 elements {UNEXPANDED}", "xacro", None)],
    ),
    "a namespace for macros, and none": (f'<robot name="r" xmlns:xacro="{XACRO}">{LINK}</robot>', []),
    "macros that are only mentioned": (f'<robot name="r">{LINK}<!-- <xacro:arm/> --></robot>', []),
}


def findings(found: tuple[Diagnostic, ...]) -> list[Finding]:
    return [
        (
            each.rule.name,
            str(each.severity),
            each.location.line,
            each.location.path,
            each.message,
            each.found,
            each.expected,
        )
        for each in found
    ]


@pytest.mark.parametrize("name", ROOTS)
def test_the_root_is_looked_at_first(name: str) -> None:
    text, expected = ROOTS[name]
    loaded = read(text.encode(), LoadOptions(), name="model.xml")
    assert findings(loaded.diagnostics) == expected
    assert {each.location.file for each in loaded.diagnostics} <= {"model.xml"}
    assert loaded.path == "model.xml"
    assert loaded.unreadable is any(each[0] == "unknown-root" for each in expected)
    assert (loaded.document is None, loaded.tree is None) == (loaded.unreadable, loaded.unreadable)


@pytest.mark.parametrize(
    ("text", "format", "version"),
    [
        (f'<gazebo version="1.2">{MODEL}</gazebo>', "sdf", "1.2"),
        (f'<sdf version="1.6">{MODEL}</sdf>', "sdf", "1.6"),
        (f'<robot name="r" version="1.1">{LINK}</robot>', "urdf", "1.1"),
        (f'<robot name="r">{LINK}</robot>', "urdf", None),
    ],
)
def test_the_document_has_the_version_that_is_declared(text: str, format: str, version: str | None) -> None:
    document = loads(text)
    assert (document.format, document.version) == (format, version)


TWO_FAULTS = """<robot name="r"><link name="a"/><link name="b"/><link name="a"/>
<material name="blue"/>
<joint name="j" type="revolute"><parent link="a"/><child link="z"/><limit lower="x" upper="1"/></joint></robot>"""


@pytest.mark.parametrize("strict", [False, True])
def test_names_are_checked_in_spite_of_errors(*, strict: bool) -> None:
    loaded = check(TWO_FAULTS.encode(), name="r.urdf", strict=strict)
    assert [(each.rule.name, str(each.severity), each.location.line) for each in loaded.diagnostics] == [
        ("duplicate-name", "error", 1),
        ("several-roots", "error", 1),
        ("bare-material", "error" if strict else "warning", 2),
        ("invalid-value", "error", 3),
        ("missing-attribute", "error", 3),
        ("missing-attribute", "error", 3),
        ("dangling-link", "error", 3),
        ("missing-axis", "info", 3),
    ]
    assert {each.location.file for each in loaded.diagnostics} == {"r.urdf"}
    assert loaded.document
    assert not loaded.accepted
    assert not loaded.unreadable


JOINT = (
    f'{LINK}<link name="b">{BODY}</link><joint name="j" type="{{}}"><parent link="a"/><child link="{{}}"/>{{}}</joint>'
)
AXIS = '<axis xyz="1 0 0"/>'
MATERIAL = '<link name="a"><visual><geometry><sphere radius="1"/></geometry><material name="x"/></visual></link>'
RED = '<material name="{}"><color rgba="red"/></material>'
CONSEQUENCES = {
    "no limit": (JOINT.format("revolute", "b", AXIS), ["missing-limit"]),
    "a limit that cannot be read": (
        JOINT.format("revolute", "b", f'{AXIS}<limit lower="0" upper="1" effort="x" velocity="1"/>'),
        ["invalid-value"],
    ),
    "an error elsewhere": (JOINT.format("revolute", "b", AXIS) + RED.format("y"), ["missing-limit", "invalid-value"]),
    "a misspelt type": (JOINT.format("revolut", "b", AXIS), ["invalid-value", "missing-limit"]),
    "a type that nobody knows": (
        JOINT.format("bent", "c", '<axis xyz="0 0 2"/>'),
        ["several-roots", "invalid-value", "dangling-link"],
    ),
    "a child without a name": (
        f'{LINK}<link name="b"/>' + '<joint name="j" type="fixed"><parent link="a"/><child/></joint>',
        ["missing-attribute"],
    ),
    "a link without a name": (
        f'{LINK}<link/><joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint><gazebo reference="c"/>',
        ["missing-attribute"],
    ),
    "two roots and an error elsewhere": (
        f'{LINK}<link name="b"/>' + RED.format("y"),
        ["several-roots", "invalid-value"],
    ),
    "no material": (MATERIAL, ["unknown-material"]),
    "a material that cannot be read": (MATERIAL + RED.format("x"), ["invalid-value"]),
}


@pytest.mark.parametrize("name", CONSEQUENCES)
def test_an_error_hides_only_what_may_follow_from_it(name: str) -> None:
    content, expected = CONSEQUENCES[name]
    found = check(f'<robot name="r">{content}</robot>'.encode()).diagnostics
    assert sorted(each.rule.name for each in found if each.rule.name != "bare-material") == sorted(expected)


def test_without_a_name_there_is_a_tree_and_no_document() -> None:
    loaded = check(b'<robot name="r"><link/></robot>')
    assert [each.rule.name for each in loaded.diagnostics] == ["missing-attribute"]
    assert loaded.path == "<bytes>"
    assert loaded.document is None
    assert loaded.tree is not None
    assert loaded.tree.tag == "robot"
    assert not loaded.unreadable


STRANGE = '<robot name="r"><link name="a" strange="1"/></robot>'


def test_a_file_is_loaded_as_strictly_as_one_asks(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(STRANGE, encoding="utf-8")
    assert load(path) == load(str(path)) == loads(STRANGE) == loads(STRANGE.encode())
    assert load(path).models[0].links[0].location.file == str(path)
    with pytest.raises(twinform.CompileError, match="'strange' is not an attribute of <link>") as caught:
        load(path, strict=True)
    assert not caught.value.unreadable
    assert [str(each.location) for each in caught.value.diagnostics] == [
        str(Location(str(path), 1, "/robot[@name='r']/link[@name='a']/@strange"))
    ]
    with pytest.raises(FileNotFoundError, match=r"s\.urdf"):
        load(tmp_path / "s.urdf")
    (tmp_path / "s.urdf").touch()
    with pytest.raises(twinform.CompileError, match="the file is empty") as caught:
        load(tmp_path / "s.urdf")
    assert caught.value.unreadable


def test_a_text_is_loaded_as_strictly_as_one_asks() -> None:
    assert loads(STRANGE).models[0].links[0].location == Location("<string>", 1, "/robot[@name='r']/link[@name='a']")
    with pytest.raises(twinform.CompileError) as caught:
        loads(STRANGE, "mine", strict=True)
    assert [(each.rule.name, each.location.file) for each in caught.value.diagnostics] == [
        ("unknown-attribute", "mine")
    ]


def test_all_that_loading_is_asked_for_reaches_the_reader(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[object] = []

    def asked_for(source: object, load_options: LoadOptions, *, name: str = "") -> LoadResult:
        asked.append(
            (
                source,
                load_options.strict,
                load_options.engine,
                load_options.search.own,
                dict(load_options.arguments),
                name,
            )
        )
        return LoadResult("r.urdf", Document.model_validate({"format": "urdf"}), ())

    monkeypatch.setattr("twinform.compiler.input.loading.read", asked_for)
    load("r.urdf", strict=True, engine="xmlschema", paths=["a", "b"], arguments={"c": "d"})
    loads("é", "s.urdf", strict=True, engine="xmlschema")
    assert asked == [
        ("r.urdf", True, "xmlschema", (Path("a"), Path("b")), {"c": "d"}, ""),
        ("é".encode(), True, "xmlschema", (), {}, "s.urdf"),
    ]


NAMESPACES: dict[str, tuple[str, dict[str, str]]] = {
    "none": ("<robot name='r'><link name='a'/></robot>", {}),
    "the default one first": (
        "<robot name='r' xmlns='urn:d' xmlns:b='urn:b' xmlns:a='urn:a'><link name='a' b:x='1'/></robot>",
        {"": "urn:d", "a": "urn:a", "b": "urn:b"},
    ),
    "one of a part": (
        "<robot name='r' xmlns:b='urn:b'><link name='a'><a:x xmlns:a='urn:a'/></link></robot>",
        {"a": "urn:a", "b": "urn:b"},
    ),
    "one prefix for three": (
        "<robot name='r' xmlns:a='urn:1'><link name='a'><a:x xmlns:a='urn:3'/><a:x xmlns:a='urn:2'/></link></robot>",
        {"a": "urn:1", "a2": "urn:2", "a3": "urn:3"},
    ),
    "one that has another prefix inside": (
        "<robot name='r' xmlns:a='urn:1' xmlns:b='urn:2'><link name='a'><a:x xmlns:a='urn:2'/></link></robot>",
        {"a": "urn:1", "b": "urn:2"},
    ),
    "one that nobody declared": (
        "<robot name='r'><link name='a' z:x='1'/></robot>",
        {"z": "urn:twinform:undeclared:z"},
    ),
}


@pytest.mark.parametrize("name", NAMESPACES)
def test_prefixes_are_kept(name: str) -> None:
    text, expected = NAMESPACES[name]
    assert loads(text).namespaces == tuple(expected.items())


def test_a_tree_of_ours_is_lowered_as_a_file_is() -> None:
    text = STRANGE.replace("<robot", '<robot xmlns:a="urn:a"')
    sink = DiagnosticSink(file="ours.urdf")
    document = lower_tree(etree.fromstring(text), sink)
    assert document
    assert document == loads(text)
    assert document.namespaces == (("a", "urn:a"),)
    assert document.models[0].links[0].location.file == "ours.urdf"
    assert [(each.rule.name, each.location.file) for each in sink.diagnostics] == [("unknown-attribute", "ours.urdf")]


def test_the_size_of_a_source_is_its_elements_and_attributes() -> None:
    assert check(b'<robot name="r"><link name="a"/><link name="b"/></robot>').size == 6
    foreign = f'<sdf version="1.11"><model name="m"><x:a xmlns:x="urn:x"><x:b c="1"/></x:a>{MODEL}</model></sdf>'
    assert check(foreign.encode()).size == 11
    assert check(dumps(loads(STRANGE), to="json").encode()).size == check(STRANGE.encode()).size
    assert check(b"<scene/>").size == 0


@pytest.mark.parametrize("enabled", [True, False])
def test_the_collector_is_left_as_it_was(*, enabled: bool) -> None:
    before = gc.isenabled()
    (gc.enable if enabled else gc.disable)()
    try:
        with garbage_collection_paused():
            assert not gc.isenabled()
        assert gc.isenabled() is enabled
        with pytest.raises(KeyError), garbage_collection_paused():
            raise KeyError
        assert gc.isenabled() is enabled
        assert gc.get_freeze_count() == 0
    finally:
        (gc.enable if before else gc.disable)()


def test_what_others_have_frozen_stays_so() -> None:
    gc.freeze()
    try:
        with garbage_collection_paused():
            pass
        assert gc.get_freeze_count() > 0
    finally:
        gc.unfreeze()


_BODY = """<mujoco model="m">
  <compiler inertiafromgeom="{}"/>
  <asset><mesh name="gone" file="gone.obj"/></asset>
  <worldbody><body name="a">{}</body></worldbody>
  <custom><text name="note" data="${{not an expression of xacro}}"/></custom>
</mujoco>"""


@pytest.mark.parametrize(
    ("setting", "geom", "mass"),
    [
        ("auto", '<geom type="box" size="0.5 0.5 0.5"/>', 1000),
        ("false", '<geom type="box" size="0.5 0.5 0.5"/>', None),
        ("auto", '<geom type="mesh" mesh="gone" density="0"/>', None),
        ("false", '<geom type="mesh" mesh="gone"/>', None),
    ],
)
def test_geoms_of_mjcf_have_a_mass_where_the_file_says_so(setting: str, geom: str, mass: float | None) -> None:
    document = twinform.loads(_BODY.format(setting, geom), name="m.xml")
    robot = twinform.convert(document, to="urdf").document.models[0]
    inertial = next(link.inertial for link in robot.links if link.name == "a")
    assert (inertial.mass if inertial and inertial.mass and inertial.mass > 1e-9 else None) == mass
