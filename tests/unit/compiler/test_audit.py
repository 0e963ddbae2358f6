"""The audit finds what became of each part, with carriers and without."""

from pathlib import Path

import pytest

import twinform
from tests.snippets import INERTIAL
from twinform.compiler import Language
from twinform.compiler.audit import audit

_ROBOT = b'<robot name="r"><link name="a"><visual>paint<geometry><box size="1 1 1"/></geometry></visual></link></robot>'
_MODEL = b'<sdf version="1.9"><model name="m"><link name="a"><inertial name="heavy"/></link></model></sdf>'


@pytest.mark.parametrize("carriers", [True, False])
@pytest.mark.parametrize(("source", "to", "count"), [(_ROBOT, "sdf", 1), (_MODEL, "urdf", 2)])  # 2: and the version
def test_text_and_attributes_of_no_format_are_carried_or_dropped(
    source: bytes, to: Language, count: int, carriers: bool
) -> None:
    made = twinform.convert(source, to=to, carriers=carriers)
    assert made.source is not None
    found = audit(made.source, made.text, made.ledger)
    assert (found.carried, found.dropped, found.unaccounted) == ((count, 0, ()) if carriers else (0, count, ()))


_LINKS = "".join(f'<link name="{name}"><inertial><mass>1</mass></inertial></link>' for name in "abc")
_BASE = '<joint name="{0}" type="revolute"><parent>a</parent><child>{1}</child><axis><xyz>0 0 1</xyz></axis></joint>'
_JOINTS = {
    "universal": "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>",
    "revolute2": "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>",
    "ball": "",
    "screw": "<thread_pitch>3</thread_pitch><axis><xyz>0 0 1</xyz></axis>",
    "gearbox": "<gearbox_ratio>2</gearbox_ratio><gearbox_reference_body>a</gearbox_reference_body>"
    "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2>",
}
_PLANAR = (
    f'<robot name="r"><link name="a">{INERTIAL}</link><link name="b">{INERTIAL}</link>'
    '<joint name="j" type="planar"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>'
)


def _there(source: str) -> tuple[str, Language]:
    """What a text becomes in the other format, and what that becomes in its own."""
    own: Language = "sdf" if source.startswith("<sdf") else "urdf"
    there = twinform.convert(source.encode(), to="urdf" if own == "sdf" else "sdf").text
    return there, own


def _model(kind: str) -> str:
    first = _BASE.format("x", "b") + (_BASE.format("y", "c") if kind == "gearbox" else "")
    joint = f'<joint name="j" type="{kind}"><parent>b</parent><child>c</child>{_JOINTS[kind]}</joint>'
    return f'<sdf version="1.11"><model name="m">{_LINKS}{first}{joint}</model></sdf>'


@pytest.mark.parametrize("source", [*map(_model, _JOINTS), _PLANAR], ids=[*_JOINTS, "planar"])
def test_chains_that_became_one_joint_again_are_all_accounted_for(source: str) -> None:
    there, own = _there(source)
    back = twinform.convert(there.encode(), to=own)
    assert back.source is not None
    assert audit(back.source, back.text, back.ledger).unaccounted == ()


def test_a_chain_that_is_lost_is_not_accounted_for() -> None:
    there, _ = _there(_model("ball"))
    back = twinform.convert(there.encode(), to="sdf")
    assert back.source is not None
    without = back.text.replace('name="j" type="ball"', 'name="j" type="fixed"')
    assert {"j_z", "j_z_link", "j_y_link"} <= {
        part.text for part in audit(back.source, without, back.ledger).unaccounted
    }


@pytest.mark.parametrize("name", ["", " ", "arm "])
def test_names_that_were_made_up_and_are_gone_are_accounted_for(name: str) -> None:
    source = f'<robot name="{name}"><link name="{name or "a"}x "><inertial/></link></robot>'
    there, _ = _there(source)
    back = twinform.convert(there.encode(), to="urdf")
    assert back.source is not None
    assert audit(back.source, back.text, back.ledger).unaccounted == ()


@pytest.mark.parametrize("to", ["urdf", "sdf"])
@pytest.mark.parametrize("gravity", ["true", "false"])
def test_a_boolean_is_accounted_for_by_its_opposite(gravity: str, to: Language) -> None:
    source = f"""<sdf version="1.11"><model name="m"><link name="a"><gravity>{gravity}</gravity>
      <inertial><mass>2</mass><inertia><ixx>3</ixx><iyy>3</iyy><izz>3</izz></inertia></inertial></link></model></sdf>"""
    made = twinform.convert(source.encode(), to="urdf")
    again = twinform.convert(made.text.encode(), to=to)
    for each in (made, again):
        assert each.source is not None
        assert audit(each.source, each.text, each.ledger).unaccounted == ()


def test_what_a_xacro_file_expands_to_is_found_in_the_ledger(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf.xacro"
    path.write_text(
        """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="part" params="name">

    <link name="${name}"/>
    <transmission name="${name}_drive"><type>odd/${name}</type></transmission>
  </xacro:macro>
  <xacro:part name="a"/>
</robot>"""
    )
    made = twinform.convert(path, to="sdf", carriers=False)
    assert made.source is not None
    assert 5 in {each.location.line for each in made.ledger.entries}
    assert audit(made.source, made.text, made.ledger).unaccounted == ()
