"""What becomes of includes: each case is what was written and what it must become, both as SDF."""

from collections.abc import Mapping
from pathlib import Path

import pytest
from lxml import etree

import twinform
from testbed.oracles.xml_trees import first_difference
from tests.write_files import write_files
from twinform.compiler import CompileError
from twinform.diagnostics import Fate, Ledger

ARM = """\
<sdf version="1.9"><model name="arm" canonical_link="lower">
  <pose>0 0 5 0 0 0</pose>
  <link name="upper"/>
  <link name="lower"><pose>0 0 1 0 0 0</pose>
    <visual name="v"><geometry><mesh><uri>meshes/lower.dae</uri></mesh></geometry></visual>
  </link>
  <joint name="elbow" type="revolute"><parent>upper</parent><child>lower</child>
    <axis><xyz expressed_in="__model__">0 0 1</xyz></axis></joint>
  <frame name="tip"><pose relative_to="lower">0 0 1 0 0 0</pose></frame>
  <plugin name="own" filename="own"/>
</model></sdf>
"""
FILES = {
    "arm/model.config": "<model><sdf version='1.9'>model.sdf</sdf></model>",
    "arm/model.sdf": ARM,
    "old/model.config": "<model><sdf version='1.4'>old.sdf</sdf></model>",
    "old/old.sdf": '<sdf version="1.4"><model name="old"><link name="a"/><link name="b"/>'
    '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>'
    "<limit><lower>0</lower><upper>1</upper></limit></axis></joint></model></sdf>",
    "framed.sdf": '<sdf version="1.6"><model name="framed"><link name="a"/><link name="b"><pose frame="a">1 0 0 0 0 0'
    "</pose></link></model></sdf>",
    "robot.urdf": '<robot name="robot"><link name="base"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" '
    'iyy="1" iyz="0" izz="1"/></inertial><visual name="v"><geometry><mesh filename="meshes/b.stl"/></geometry></visual>'
    "</link></robot>",
    "outer.sdf": '<sdf version="1.9"><model name="outer"><link name="base"/><include><uri>arm</uri></include>'
    "</model></sdf>",
    "lamp.sdf": '<sdf version="1.9"><light name="lamp" type="point"><pose>1 0 0 0 0 0</pose></light></sdf>',
    "walker.sdf": '<sdf version="1.9"><actor name="walker"><skin><filename>skin.dae</filename></skin></actor></sdf>',
    "spaced.sdf": '<sdf version="1.9"><model name="spaced" namespace="own"><link name="a"/></model></sdf>',
    "wrong.sdf": '<sdf version="1.9"><model name="wrong">\n<link name="a"><inertial><mass>heavy</mass></inertial>'
    "</link></model></sdf>",
}
BODY = ARM[ARM.index('  <link name="upper"') : ARM.index("  <plugin")].replace("meshes/", "model://arm/meshes/")
PLUGINS = '<plugin name="own" filename="own"/>'

EXPANSIONS: Mapping[str, tuple[str, str]] = {
    "what is not set stays as it is in the file": (
        "<include><uri>model://arm</uri></include>",
        f'<model name="arm" canonical_link="lower"><pose>0 0 5 0 0 0</pose>{BODY}{PLUGINS}</model>',
    ),
    "name, pose, placement, static and plugins": (
        (
            '<include><uri>model://arm</uri><name>left</name><pose relative_to="f">1 0 0 0 0 0</pose>'
            '<placement_frame>tip</placement_frame><static>true</static><plugin name="q" filename="q"/></include>'
            '<frame name="f"/>'
        ),
        (
            '<model name="left" canonical_link="lower" placement_frame="tip"><static>true</static>'
            f'<pose relative_to="f">1 0 0 0 0 0</pose>{BODY}{PLUGINS}<plugin name="q" filename="q"/></model>'
            '<frame name="f"/>'
        ),
    ),
    "an include inside an included file": (
        "<include><uri>outer.sdf</uri></include>",
        (
            '<model name="outer"><link name="base"/><model name="arm" canonical_link="lower"><pose>0 0 5 0 0 0</pose>'
            f"{BODY.replace('model://', '')}{PLUGINS}</model></model>"
        ),
    ),
    "merged contents": (
        (
            '<model name="m"><link name="base"/><include merge="true"><uri>model://arm</uri><name>a</name>'
            '<placement_frame>tip</placement_frame><pose relative_to="base">1 0 0 0 0 0</pose></include></model>'
        ),
        f"""<model name="m"><link name="base"/>
        <link name="upper"><pose relative_to="_merged__a__model__"/></link>
        <link name="lower"><pose relative_to="_merged__a__model__">0 0 1 0 0 0</pose>
          <visual name="v"><geometry><mesh><uri>model://arm/meshes/lower.dae</uri></mesh></geometry></visual></link>
        <joint name="elbow" type="revolute"><parent>upper</parent><child>lower</child>
          <axis><xyz expressed_in="_merged__a__model__">0 0 1</xyz></axis></joint>
        <frame name="_merged__a__model__" attached_to="lower"><pose relative_to="base">1 0 -2 0 0 0</pose></frame>
        <frame name="tip" attached_to="_merged__a__model__"><pose relative_to="lower">0 0 1 0 0 0</pose></frame>
        {PLUGINS}</model>""",
    ),
    "an older file in the syntax of a newer one": (
        "<include><uri>model://old</uri></include>",
        (
            '<model name="old"><link name="a"/><link name="b"/><joint name="j" type="revolute"><parent>a</parent>'
            '<child>b</child><axis><xyz expressed_in="__model__">0 0 1</xyz>'
            "<limit><lower>0</lower><upper>1</upper></limit></axis></joint></model>"
        ),
    ),
    "frames of before they had names": (
        "<include><uri>framed.sdf</uri></include>",
        '<model name="framed"><link name="a"/><link name="b"><pose relative_to="a">1 0 0 0 0 0</pose></link></model>',
    ),
    "a namespace in place of the model's own": (
        "<include><uri>spaced.sdf</uri><namespace>mine</namespace></include>",
        '<model name="spaced" namespace="mine"><link name="a"/></model>',
    ),
    "a light": (
        "<include><uri>lamp.sdf</uri><name>l</name><pose>2 0 0 0 0 0</pose></include>",
        '<light name="l" type="point"><pose>2 0 0 0 0 0</pose></light>',
    ),
    "an actor": (
        "<include><uri>walker.sdf</uri><name>w</name><pose>2 0 0 0 0 0</pose></include>",
        '<actor name="w"><pose>2 0 0 0 0 0</pose><skin><filename>skin.dae</filename></skin></actor>',
    ),
}


def lost(ledger: Ledger) -> list[str]:
    """The rules of all entries but those for the URIs of includes, in whose places stands what they named."""
    return [each.rule.name for each in ledger.entries if not each.location.path.endswith("/uri")]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / ".git").mkdir()
    return write_files(tmp_path, FILES)


def _world(folder: Path, body: str, version: str = "1.9") -> Path:
    path = folder / "world.sdf"
    path.write_text(f'<sdf version="{version}"><world name="w">\n{body}\n</world></sdf>')
    return path


@pytest.mark.parametrize("case", EXPANSIONS)
def test_an_include_becomes_what_it_names(folder: Path, case: str) -> None:
    written, expected = EXPANSIONS[case]
    result = twinform.convert(_world(folder, written), to="sdf", expand_includes=True)
    by_hand = f'<sdf version="1.9"><world name="w">{expected}</world></sdf>'
    assert first_difference(by_hand.encode(), result.text.encode()) is None


def test_includes_are_kept_unless_asked_otherwise(folder: Path) -> None:
    path = _world(folder, "<include><uri>model://nothing</uri></include>")
    assert twinform.convert(path, to="sdf").document == twinform.load(path)


MERGED = '<link name="base"/><include merge="true"><uri>model://arm</uri></include>'
PLACED = "<include><uri>model://arm</uri><pose>1 0 0 0 0 0</pose><placement_frame>tip</placement_frame></include>"
PLAIN = "<include><uri>model://arm</uri><name>other</name><pose>2 0 0 0 0 0</pose></include>"
NEEDED = [
    (f'<model name="m">{MERGED}</model>', "1.8", " merge="),
    (f'<model name="m">{MERGED}</model>', "1.6", " merge="),
    (f'<model name="m"><link name="l"/>{PLACED}</model>', "1.7", "<placement_frame>"),
    (PLACED, "1.6", "<placement_frame>"),
    ('<include merge="true"><uri>frames.sdf</uri></include>', "1.9", " merge="),
]


@pytest.mark.parametrize(("body", "version", "word"), NEEDED)
def test_an_older_version_has_the_contents_of_includes_that_it_cannot_have(
    folder: Path, body: str, version: str, word: str
) -> None:
    (folder / "frames.sdf").write_text('<sdf version="1.10"><model name="frames"><frame name="f"/></model></sdf>')
    made = twinform.convert(_world(folder, PLAIN + body, "1.10"), to="sdf", sdf_version=version)
    expanded = twinform.convert(
        _world(folder, PLAIN + body, "1.10"), to="sdf", sdf_version=version, expand_includes=True
    )
    assert word not in made.text
    assert [each.name for each in made.document.worlds[0].includes] == ["other"]  # which any version can have
    own, all_of_them = made.document.worlds[0], expanded.document.worlds[0]
    assert own.models == tuple(each for each in all_of_them.models if each.name != "other")
    assert (own.frames, own.joints) == (all_of_them.frames, all_of_them.joints)


@pytest.mark.parametrize(("body", "version", "word"), NEEDED)
def test_includes_stay_in_versions_that_can_have_them(folder: Path, body: str, version: str, word: str) -> None:
    for target in ("1.10", "1.12", None):
        assert word in twinform.convert(_world(folder, body, "1.10"), to="sdf", sdf_version=target).text
    # libsdformat goes by the words and not by the version, so the file is what it is
    assert word in twinform.convert(_world(folder, body, version), to="sdf").text


def test_an_include_whose_file_is_missing_has_no_older_version(folder: Path) -> None:
    path = _world(folder, '<model name="m"><link name="a"/>\n<include merge="1"><uri>none</uri></include></model>')
    with pytest.raises(CompileError) as caught:
        twinform.convert(path, to="sdf", sdf_version="1.8")
    error = caught.value.diagnostics[0]
    assert (error.rule.name, error.location.line) == ("unresolved-uri", 3)
    assert "an include of SDF 1.8 cannot stand for it" in error.message


def test_an_older_world_is_raised_to_the_version_of_what_it_includes(folder: Path) -> None:
    path = _world(folder, "<include><uri>model://arm</uri></include>", "1.6")
    assert twinform.convert(path, to="sdf", expand_includes=True).document.version == "1.9"


@pytest.mark.parametrize(("declared", "expected"), [("1.13", "1.12"), (" 1.7 ", "1.7"), ("1.0", "1.12")])
def test_a_version_that_is_not_known_counts_as_the_one_that_it_is_read_by(
    folder: Path, declared: str, expected: str
) -> None:
    links = '<link name="a"/><link name="b"><pose relative_to="a"/></link>'
    (folder / "new.sdf").write_text(f'<sdf version="{declared}"><model name="n">{links}</model></sdf>')
    old = '<model name="o"><link name="a"/><link name="b"/><joint name="j" type="revolute"><parent>a</parent>'
    joint = f"{old}<child>b</child><axis><xyz>1 0 0</xyz></axis></joint></model>"
    made = twinform.convert(
        _world(folder, f"{joint}<include><uri>new.sdf</uri></include>", "1.4"), to="sdf", expand_includes=True
    )
    assert made.document.version == expected
    assert "<xyz expressed_in=" in made.text


def test_a_model_in_a_model_needs_a_version_that_has_them(folder: Path) -> None:
    path = folder / "holder.sdf"
    path.write_text(
        '<sdf version="1.4"><model name="m"><link name="l"/><include><uri>old</uri></include></model></sdf>'
    )
    result = twinform.convert(path, to="sdf", expand_includes=True)
    assert (result.document.version, lost(result.ledger)) == ("1.5", [])
    assert "<use_parent_model_frame>true</use_parent_model_frame>" in result.text


def test_a_urdf_file_is_converted_on_the_way(folder: Path) -> None:
    result = twinform.convert(
        _world(folder, "<include><uri>robot.urdf</uri><name>r</name></include>"), to="sdf", expand_includes=True
    )
    model = result.document.worlds[0].models[0]
    assert (model.name, model.links[0].name) == ("r", "base")
    assert "<uri>meshes/b.stl</uri>" in result.text


def test_a_file_of_fuel_comes_from_the_cache(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(folder / "home"))
    cache = folder / "home/.gz/fuel/fuel.gazebosim.org/openrobotics/models/arm/2"
    cache.mkdir(parents=True)
    for name in ("model.config", "model.sdf"):
        (cache / name).write_text(FILES[f"arm/{name}"])
    uri = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Arm"
    result = twinform.convert(_world(folder, f"<include><uri>{uri}</uri></include>"), to="sdf", expand_includes=True)
    assert f"<uri>{uri}/tip/files/meshes/lower.dae</uri>" in result.text


def test_urdf_is_made_of_an_included_model(folder: Path) -> None:
    path = _world(folder, "<include><uri>outer.sdf</uri></include>")
    links = [link.name for link in twinform.convert(path, to="urdf").document.models[0].links]
    assert {"base", "arm__upper", "arm__lower"} <= set(links)


def test_for_one_model_the_others_need_not_be_there(folder: Path) -> None:
    path = _world(folder, "<include><uri>model://nothing</uri></include><include><uri>model://arm</uri><name>a</name>"
                  '</include><model name="other"><include><uri>model://nothing</uri></include></model>')  # fmt: skip
    assert twinform.convert(path, to="urdf", model="a").document.models[0].name == "a"
    with pytest.raises(CompileError, match="there are 3 models"):
        twinform.convert(path, to="urdf")


def test_an_include_is_found_by_the_name_that_its_file_has(folder: Path) -> None:
    path = _world(folder, "<include><uri>model://arm</uri></include><include><uri>outer.sdf</uri></include>")
    assert twinform.convert(path, to="urdf", model="outer").document.models[0].name == "outer"


def test_a_missing_include_of_the_model_is_an_error_on_its_line(folder: Path) -> None:
    path = _world(folder, '<model name="m"><link name="a"/>\n<include><uri>model://nothing</uri></include></model>')
    with pytest.raises(CompileError) as caught:
        twinform.convert(path, to="urdf")
    error = caught.value.diagnostics[0]
    assert (error.rule.name, error.location.line) == ("unresolved-uri", 3)
    assert str(folder) in (error.help or "")


def test_findings_in_included_files_name_them(folder: Path) -> None:
    path = _world(
        folder, "<include><uri>wrong.sdf</uri></include><include><uri>wrong.sdf</uri><name>b</name></include>"
    )
    errors = [each for each in twinform.check(path, expand_includes=True).diagnostics if each.is_error]
    assert [(each.location.file, each.location.line) for each in errors] == [(str(folder / "wrong.sdf"), 2)]


def test_a_broken_model_config_is_named(folder: Path) -> None:
    (folder / "arm/model.sdf").unlink()
    checked = twinform.check(_world(folder, "<include><uri>model://arm</uri></include>"), expand_includes=True)
    assert checked.diagnostics[0].location.file == str(folder / "arm/model.config")


def test_a_circle_is_an_error_that_names_its_files(folder: Path) -> None:
    for name, other in (("a", "b"), ("b", "a")):
        (folder / f"{name}.sdf").write_text(
            f'<sdf version="1.9"><model name="{name}"><include><uri>{other}.sdf</uri></include></model></sdf>'
        )
    checked = twinform.check(_world(folder, "<include><uri>a.sdf</uri></include>"), expand_includes=True)
    error = next(each for each in checked.diagnostics if each.is_error)
    assert error.message == "'a.sdf' includes 'b.sdf' includes 'a.sdf'"
    assert error.location.file == str(folder / "b.sdf")


@pytest.mark.parametrize(("depth", "each"), [(40, 1), (6, 10)])
def test_a_few_files_cannot_fill_the_memory(folder: Path, depth: int, each: int) -> None:
    for level in range(depth):
        inner = "".join(
            f"<include><uri>l{level + 1}.sdf</uri><name>n{number}</name></include>" for number in range(each)
        )
        text = f'<sdf version="1.9"><model name="m"><link name="a"/>{inner}</model></sdf>'
        (folder / f"l{level}.sdf").write_text(text)
    (folder / f"l{depth}.sdf").write_text('<sdf version="1.9"><model name="m"><link name="a"/></model></sdf>')
    checked = twinform.check(_world(folder, "<include><uri>l0.sdf</uri></include>"), expand_includes=True)
    assert {found.rule.name for found in checked.diagnostics if found.is_error} == {"too-many-includes"}


def test_the_ledger_counts_what_was_included(folder: Path) -> None:
    path = _world(folder, "<include><uri>model://arm</uri></include>")
    kept = twinform.convert(path, to="sdf").ledger
    expanded = twinform.convert(path, to="sdf", expand_includes=True).ledger
    size = sum(1 + len(element.attrib) for element in etree.fromstring(ARM).iter())
    assert expanded.expressed == kept.expressed + size - 1
    assert [(each.fate, each.location.path) for each in expanded.entries] == [
        (Fate.DROPPED, "/sdf/world[@name='w']/include[1]/uri")
    ]


def test_what_a_merged_model_has_as_a_whole_is_in_the_ledger(folder: Path) -> None:
    body = '<model name="m"><link name="base"/><include merge="1"><uri>model://arm</uri><static>1</static></include>'
    ledger = twinform.convert(_world(folder, body + "</model>"), to="sdf", expand_includes=True).ledger
    assert lost(ledger) == ["merged-away"]


def test_an_older_file_is_written_in_the_version_of_the_newer_one_around_it(tmp_path: Path) -> None:
    (tmp_path / "old.sdf").write_text("""<sdf version="1.5"><model name="old"><link name="a">
      <sensor name="s" type="imu"><imu><noise><rate><stddev>2e-4</stddev></rate></noise></imu></sensor>
    </link></model></sdf>""")
    (tmp_path / "new.sdf").write_text(
        """<sdf version="1.9"><world name="w"><include><uri>old.sdf</uri></include></world></sdf>"""
    )
    made = twinform.convert(tmp_path / "new.sdf", to="sdf", expand_includes=True)
    assert made.text.count('<noise type="gaussian"') == 6
    assert lost(made.ledger) == []
