"""Names of MJCF in an editor: where they are defined, what refers to them, and what a change of one changes."""

from pathlib import Path

import pytest

import twinform
from tests.unit.server.test_navigation import opened, renamed
from twinform.server.document_names import names_of, undefined_names
from twinform.server.document_outline import outline
from twinform.server.hover import hover
from twinform.server.navigation import RenameRefusedError, definitions, rename

_MODEL = """\
<mujoco model="m">
  <default><default class="soft"><geom condim="4"/><default class="softer"/></default></default>
  <asset>
    <texture name="wood" builtin="flat" type="2d" width="8" height="8"/>
    <material name="wood" texture="wood"/>
    <mesh name="tri" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/>
  </asset>
  <worldbody>
    <light mode="targetbody" target="hip"/>
    <body name="hip" childclass="soft">
      <joint name="hip"/>
      <geom name="hip" class="softer" size="0.1" material="wood"/>
      <site name="hip" pos="0 0 0.1"/>
      <body name="a::knee"><joint name="knee"/><geom type="mesh" mesh="tri"/><site name="end"/></body>
    </body>
  </worldbody>
  <contact><exclude body1="hip" body2="a::knee"/></contact>
  <equality><joint joint1="hip" joint2="knee"/><weld body1="a::knee" active="false"/></equality>
  <tendon><spatial name="cord"><site site="hip"/><site site="end"/></spatial></tendon>
  <actuator><motor name="drive" joint="hip"/><motor tendon="cord"/></actuator>
  <sensor><gyro site="hip"/><framepos objtype="geom" objname="hip" reftype="body" refname="a::knee"/>
    <actuatorfrc actuator="drive"/><jointpos joint="knee"/></sensor>
</mujoco>
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    found = tmp_path / "m.xml"
    found.write_text(_MODEL)
    return found


def test_every_name_can_be_changed_and_all_that_refers_to_it_does(path: Path) -> None:
    session, document = opened(path)
    defined = [each for each in names_of(document) if each.defines]
    assert {each.kind for each in defined} >= {
        "default", "texture", "material", "mesh", "body", "joint", "geom", "site", "tendon", "actuator",
    }  # fmt: skip
    for each in defined:
        (text,) = renamed(session, document, f"{_MODEL[: each.span.start]}|", "another").values()
        assert twinform.check(text.encode()).diagnostics == (), each
    assert list(undefined_names(document)) == []


@pytest.mark.parametrize(
    ("at", "line"),
    [
        ('childclass="so|ft"', 2),
        ('joint1="h|ip"', 11),
        ('objname="h|ip"', 12),
        ('refname="a::|knee"', 14),
        ('target="h|ip"', 10),
        ('texture="w|ood"', 4),
        ('tendon="c|ord"', 19),
    ],
)
def test_a_reference_leads_to_what_has_the_name_and_is_of_its_kind(at: str, line: int, path: Path) -> None:
    session, document = opened(path)
    before, _, behind = at.partition("|")
    (place,) = definitions(session, document, _MODEL.index(before + behind) + len(before))
    assert document.positions.position(place.span.start).line + 1 == line


def test_a_name_that_another_of_its_kind_has_is_refused(path: Path) -> None:
    session, document = opened(path)
    with pytest.raises(RenameRefusedError, match="a joint is called 'knee' already"):
        rename(session, document, _MODEL.index('joint1="hip"') + 9, "knee")


def test_what_an_included_file_names_is_renamed_there(tmp_path: Path) -> None:
    (tmp_path / "drives.xml").write_text('<mujocoinclude><actuator><motor joint="hip"/></actuator></mujocoinclude>')
    whole = tmp_path / "m.xml"
    whole.write_text(_MODEL.replace("</mujoco>", '<include file="drives.xml"/></mujoco>'))
    texts = renamed(*opened(whole), '<joint name="h|ip"/>', "pelvis")
    assert '<motor joint="pelvis"/>' in texts["drives.xml"]
    assert '<motor name="drive" joint="pelvis"/>' in texts["m.xml"]


def test_the_outline_has_bodies_with_what_is_in_them(path: Path) -> None:
    (root,) = outline(opened(path)[1])
    world = next(each for each in root.children or () if each.name == "<worldbody>")
    hip = next(each for each in world.children or () if each.name == "hip")
    assert [each.name for each in hip.children or ()] == ["hip", "hip", "hip", "a::knee"]


@pytest.mark.parametrize(
    ("at", "expected"),
    [
        ('<mot|or name="drive"', "motor"),
        ('material="w|ood"', "material"),
        ('cond|im="4"', "condim"),
        ("<fr|amepos", "framepos"),
    ],
)
def test_what_stands_under_the_cursor_is_explained(at: str, expected: str, path: Path) -> None:
    session, document = opened(path)
    before, _, behind = at.partition("|")
    found = hover(session, document, _MODEL.index(before + behind) + len(before))
    assert found is not None
    assert expected in str(found.contents)
    assert "MJCF" in str(found.contents)
