"""What libsdformat makes of a URDF, `<gazebo>` tags and all, is what it makes of the SDF of the same robot."""

from pathlib import Path

import pytest

import twinform
from reports.harness.sample import is_good
from reports.same_robot.equipment import reason
from testbed.corpus.files import ROOT, CorpusFile, Kind
from testbed.equipment.judging import Outcome, Verdict, judge
from tests.corpus.portions import chunks
from twinform.testing.oracles import libsdformat

_MODELS = chunks(Kind.SDF) | {f"{chunk}-urdf": files for chunk, files in chunks(Kind.URDF).items()}
_CASES = sorted(path for path in (ROOT / "tests/cases/convert").glob("*.sdf") if ".expected" not in path.name)
_ROBOT = """<robot name='m'><link name='base'>
  <inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>
  <visual><geometry><sphere radius='1'/></geometry><material name='m'>{}</material></visual>
  <collision name='{}'><geometry><sphere radius='1'/></geometry></collision>
</link><gazebo reference='base'>{}</gazebo></robot>"""
_MODEL = "<sdf version='1.9'><model name='m'><link name='base'>{}</link></model></sdf>"
_GEOMETRY = "<geometry><sphere><radius>{}</radius></sphere></geometry>"
_FRICTION = "<surface><friction><ode>{}</ode></friction></surface>"


@pytest.fixture(autouse=True)
def reader() -> None:
    if not libsdformat.available():
        pytest.skip(libsdformat.MISSING)


def _judged(text: str, folder: Path) -> Outcome:
    path = folder / "model.sdf"
    path.write_text(text)
    (found,) = judge(CorpusFile(str(path), Kind.SDF, {}))
    return found


@pytest.mark.parametrize("name", ["collision", "base", "base_collision", "base_fixed_joint_lump__a_collision_1", "b"])
@pytest.mark.parametrize(
    "values",
    [
        _FRICTION.format("<mu>0.1</mu><mu2>0.2</mu2><fdir1>1 0 0</fdir1>"),
        _FRICTION.format("<slip1>0.1</slip1>"),
        "<surface><contact><ode><kp>1e5</kp><kd>2</kd><max_vel>3</max_vel><min_depth>0.1</min_depth></ode></contact></surface>",
        "<surface><bounce><restitution_coefficient>0.5</restitution_coefficient></bounce></surface>",
        "<max_contacts>3</max_contacts><laser_retro>7</laser_retro>",
    ],
)
def test_gazebo_finds_the_values_of_a_collision_of_any_name(name: str, values: str, tmp_path: Path) -> None:
    found = _judged(_MODEL.format(f"<collision name='{name}'>{_GEOMETRY.format(1)}{values}</collision>"), tmp_path)
    assert (found.found, found.parts) == ((), 1)


@pytest.mark.parametrize("name", ["visual", "base", "base_visual", "base_fixed_joint_lump__a_visual_1", "b"])
@pytest.mark.parametrize(
    "values",
    ["<transparency>0.5</transparency>", "<cast_shadows>false</cast_shadows>", "<meta><layer>1</layer></meta>"],
)
def test_gazebo_finds_the_values_of_a_visual_of_any_name(name: str, values: str, tmp_path: Path) -> None:
    found = _judged(_MODEL.format(f"<visual name='{name}'>{_GEOMETRY.format(1)}{values}</visual>"), tmp_path)
    assert (found.found, found.parts) == ((), 1)


@pytest.mark.parametrize("names", [("collision", "other"), ("base", "base_collision"), ("base_1", "1")])
def test_contact_sensors_name_collisions_as_gazebo_does(names: tuple[str, str], tmp_path: Path) -> None:
    shapes = "".join(f"<collision name='{name}'>{_GEOMETRY.format(n)}</collision>" for n, name in enumerate(names, 1))
    sensed = "".join(f"<collision>{name}</collision>" for name in names)
    sensor = f"<sensor name='s' type='contact'><contact>{sensed}<topic>t</topic></contact></sensor>"
    found = _judged(_MODEL.format(shapes + sensor), tmp_path)
    assert (found.found, found.parts) == ((), 1)


@pytest.mark.parametrize(
    ("robot", "rules"),
    [
        (("<color rgba='0.4 0 1 1'/>", "base", ""), {"gazebo-material"}),
        (("<texture filename='a.png'/>", "base", ""), {"gazebo-material"}),
        (("<color rgba='0 1 0 1'/>", "ball", "<mu1>0.1</mu1>"), {"unreached-shape"}),
        (("<color rgba='0 1 0 1'/>", "base", "<mu1>0.1</mu1><selfCollide>true</selfCollide>"), set[str]()),
    ],
)
def test_a_conversion_says_what_gazebo_makes_else_of_urdf(
    robot: tuple[str, str, str], rules: set[str], tmp_path: Path
) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(_ROBOT.format(*robot))
    (found,) = judge(CorpusFile(str(path), Kind.URDF, {}))
    said = {each.rule.name for each in twinform.convert(path, to="sdf").diagnostics}
    assert (found.verdict, said & {"gazebo-material", "unreached-shape"}) == (
        Verdict.SAID if rules else Verdict.SAME,
        rules,
    )


@pytest.mark.parametrize("path", _CASES, ids=lambda path: path.stem)
def test_gazebo_finds_what_the_case_has(path: Path) -> None:
    found = judge(CorpusFile(str(path), Kind.SDF, {}))
    assert [each for one in found for each in one.silent] == []


@pytest.mark.parametrize("chunk", _MODELS)
def test_gazebo_finds_what_a_model_of_the_corpus_has(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    found = [one for file in _MODELS[chunk] if is_good(file) for one in judge(file) if one.verdict is Verdict.DIFFERENT]
    assert [f"{one.name}: {one.cause}" for one in found if not reason(one)] == []


def test_gazebo_finds_the_values_of_links_that_it_lumps(tmp_path: Path) -> None:
    """Links without mass on fixed joints become a part of the base, whose name one of theirs begins with."""
    links = "".join(
        f"<link name='{name}'><inertial><mass>{mass}</mass></inertial>{_lumped(number)}</link>"
        for number, (name, mass) in enumerate((("base", 1), ("base_tool", 0), ("arm", 0)), start=1)
    )
    joints = "".join(
        f"<joint name='{name}_joint' type='fixed'><parent>base</parent><child>{name}</child></joint>"
        for name in ("base_tool", "arm")
    )
    found = _judged(f"<sdf version='1.9'><model name='m'>{links}{joints}</model></sdf>", tmp_path)
    assert found.found == ()
    assert found.parts == len("ccv" + "s") * len(("base", "base_tool", "arm"))


def _lumped(number: int) -> str:
    """Shapes with values at places of their own, and a contact sensor for one of them."""
    friction = _FRICTION.format(f"<mu>0.{number}</mu>")
    places = {name: f"<pose>{number} {y} 0 0 0 0</pose>{_GEOMETRY.format(1)}" for y, name in enumerate("cdv")}
    shapes = "".join(f"<collision name='{name}'>{places[name]}{friction}</collision>" for name in "cd")
    visual = f"<visual name='v'>{places['v']}<transparency>0.{number}</transparency></visual>"
    sensor = f"<sensor name='s{number}' type='contact'><contact><collision>d</collision></contact></sensor>"
    return shapes + visual + sensor
