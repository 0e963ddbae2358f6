"""What stands for a shape that the target lacks: what is written, what folds back, and that edits win."""

import re
from pathlib import Path

import pytest

import twinform
from twinform.compiler.audit import audit
from twinform.diagnostics import rules

TEXT = """<sdf version="1.11"><model name="m"><link name="a">{}</link></model></sdf>"""
CAPSULE = "<geometry><capsule><radius>0.1</radius><length>0.5</length></capsule></geometry>"
ELLIPSOID = "<geometry><ellipsoid><radii>0.1 0.2 0.3</radii></ellipsoid></geometry>"
CONE = "<geometry><cone><radius>0.1</radius><length>0.5</length></cone></geometry>"
COLLISION = f"<collision name='c'><pose>1 0 0 0.3 0.2 0</pose>{CAPSULE}</collision>"
EGG = f"<collision name='c'>{ELLIPSOID}</collision>"


def urdf(parts: str, **options: object) -> twinform.Conversion:
    return twinform.convert(TEXT.format(parts).encode(), to="urdf", **options)  # pyright: ignore[reportArgumentType]


def kinds(text: str | twinform.Conversion) -> list[str]:
    """The kinds of the shapes of the only link."""
    document = twinform.loads(text) if isinstance(text, str) else text.document
    link = document.models[0].links[0]
    shapes = [part.geometry.shape for part in (*link.visuals, *link.collisions) if part.geometry]
    return [shape.kind for shape in shapes if shape]


def home(text: str) -> tuple[list[str], bool]:
    """The kinds of the shapes back in SDF, and whether a carrier fitted no more."""
    back = twinform.convert(text.encode(), to="sdf")
    assert "tf:capsule" not in back.text
    assert "tf:shape" not in back.text
    return kinds(back), any(each.rule is rules.STALE_CARRIER for each in back.diagnostics)


def test_a_capsule_is_three_primitives_and_comes_home() -> None:
    made = urdf(COLLISION)
    assert kinds(made.text) == ["cylinder", "sphere", "sphere"]
    assert [each.name for each in twinform.loads(made.text).models[0].links[0].collisions] == ["c", "c_end", "c_end_1"]
    assert (home(made.text), made.side_files) == ((["capsule"], False), ())


def test_urdf_1_1_has_capsules() -> None:
    assert kinds(urdf(COLLISION, urdf_version="1.1").text) == ["capsule"]


def test_a_capsule_without_a_length_is_a_sphere() -> None:
    made = urdf(f"<collision name='c'>{CAPSULE.replace('0.5', '0')}</collision>")
    assert kinds(made.text) == ["sphere"]
    assert home(made.text) == (["capsule"], False)


def test_the_visual_of_a_capsule_is_three_of_one_color() -> None:
    color = "<material><diffuse>1 0 0 1</diffuse></material>"
    made = urdf(f"<visual name='v'>{CAPSULE}{color}</visual>")
    materials = [each.material for each in twinform.loads(made.text).models[0].links[0].visuals]
    assert [material and material.color for material in materials] == [(1, 0, 0, 1)] * 3
    assert home(made.text) == (["capsule"], False)
    assert home(made.text.replace('rgba="1 0 0 1"', 'rgba="0 1 0 1"', 1)) == (["cylinder", "sphere", "sphere"], True)


CAPSULE_EDITS = [
    ("one radius", ('sphere radius="0.1"', 'sphere radius="0.2"'), ["cylinder", "sphere", "sphere"]),
    ("length", ('length="0.5"', 'length="0.6"'), ["cylinder", "sphere", "sphere"]),
    ("place of the middle", ('xyz="1 0 0"', 'xyz="1 0 0.1"'), ["cylinder", "sphere", "sphere"]),
    ("another shape", ('<cylinder radius="0.1" length="0.5"/>', '<box size="1 1 1"/>'), ["box", "sphere", "sphere"]),
    ("name of an end", ('name="c_end_1"', 'name="bumper"'), ["cylinder", "sphere", "sphere"]),
]


@pytest.mark.parametrize(("edit", "kept"), [pytest.param(*each[1:], id=each[0]) for each in CAPSULE_EDITS])
def test_what_stands_in_the_file_counts(edit: tuple[str, str], kept: list[str]) -> None:
    text = urdf(COLLISION).text
    assert edit[0] in text
    assert home(text.replace(*edit, 1)) == (kept, True)


def test_without_an_end_it_is_no_capsule() -> None:
    text = urdf(COLLISION).text
    start = text.index('<collision name="c_end_1">')
    end = text.index("</collision>", start) + len("</collision>")
    assert home(text[:start] + text[end:]) == (["cylinder", "sphere"], True)


def test_parts_that_were_edited_alike_are_a_capsule_of_that_size() -> None:
    text = urdf(f"<collision name='c'>{CAPSULE}</collision>").text
    for old, new in (('"0.1"', '"0.2"'), ('"0.5"', '"1"'), ('"0 0 0.25"', '"0 0 0.5"'), ('"0 0 -0.25"', '"0 0 -0.5"')):
        text = text.replace(old, new)
    back = twinform.convert(text.encode(), to="sdf").text
    assert "<capsule>\n            <radius>0.2</radius>\n            <length>1</length>" in back


def test_another_name_of_the_middle_is_that_of_the_capsule() -> None:
    text = urdf(COLLISION).text.replace('<collision name="c">', '<collision name="shell">')
    back = twinform.convert(text.encode(), to="sdf").document.models[0].links[0].collisions
    assert [each.name for each in back] == ["shell"]


@pytest.mark.parametrize("geometry", [ELLIPSOID, CONE])
def test_a_mesh_lies_beside_the_file_and_comes_home(geometry: str, tmp_path: Path) -> None:
    made = urdf(f"<visual name='c'>{geometry}</visual>")
    (file,) = made.side_files
    assert file.path in made.text
    assert [each.rule for each in made.diagnostics] == [rules.REPLACED_SHAPE]
    (tmp_path / "meshes").mkdir()
    (tmp_path / file.path).write_bytes(file.data)
    robot = tmp_path / "robot.urdf"
    robot.write_text(made.text, encoding="utf-8")
    kind = "cone" if geometry is CONE else "ellipsoid"
    assert kinds(twinform.convert(robot, to="sdf")) == [kind]
    (tmp_path / file.path).write_bytes(file.data.replace(b"v 0 0 ", b"v 0 0.01 ", 1))
    assert kinds(twinform.convert(robot, to="sdf")) == ["mesh"]  # somebody edited the mesh


@pytest.mark.parametrize(
    "edit",
    [
        ('.obj"/>', '.obj" scale="2 1 1"/>'),
        ('filename="meshes/', 'filename="meshes/better_'),
        ("<mesh filename=", "<mesh filename='other.obj' old="),
    ],
)
def test_a_mesh_that_was_scaled_or_exchanged_stays(edit: tuple[str, str]) -> None:
    text = urdf(EGG).text
    assert home(text) == (["ellipsoid"], False)
    edited = text.replace(*edit, 1)
    assert edited != text
    assert home(edited.replace(" old=", " tf:old=")) == (["mesh"], True)


def test_a_mesh_that_moved_into_a_package_still_stands_for_its_shape() -> None:
    assert home(urdf(EGG).text.replace("meshes/", "package://arm/meshes/", 1)) == (["ellipsoid"], False)


def test_equal_shapes_share_a_mesh_and_the_error_is_what_was_asked_for() -> None:
    two = EGG + EGG.replace("'c'", "'d'")
    assert len(urdf(two).side_files) == 1
    (coarse,), (fine,) = urdf(EGG, shape_error=0.02).side_files, urdf(EGG, shape_error=0.001).side_files
    assert len(coarse.data) < len(fine.data)
    assert "at most 0.943 mm off" in urdf(EGG, shape_error=0.001).diagnostics[0].message


def test_a_result_has_no_more_than_two_hundred_meshes() -> None:
    many = "".join(EGG.replace("'c'", f"'c{n}'").replace("0.3", f"{n + 1}") for n in range(201))
    made = urdf(many, shape_error=100.0)
    assert len(made.side_files) == 200
    (found,) = (each.help for each in made.diagnostics if each.rule is rules.UNSAYABLE_SHAPE)
    assert found == "a result has meshes for no more than 200 shapes, and of 64 MiB"


@pytest.mark.parametrize(
    ("parts", "hint"),
    [
        (EGG, "name a file for the result with -o"),
        ("<collision name='c'><geometry><plane/></geometry></collision>", "put the ground into the world"),
        (EGG.replace("0.2", "0"), "a size that is not above 0"),
    ],
)
def test_a_finding_says_what_to_do_where_nothing_can_be_made_of_a_shape(parts: str, hint: str) -> None:
    made = urdf(parts, side_files=False)
    assert kinds(made.text) == []
    (found,) = (each for each in made.diagnostics if each.rule is rules.UNSAYABLE_SHAPE)
    assert found.location.line == 1
    assert hint in (found.help or "")
    assert kinds(twinform.convert(made.text.encode(), to="sdf")) == kinds(TEXT.format(parts))


@pytest.mark.parametrize("version", ["1.10", "1.7"])
def test_masses_that_are_computed_of_shapes_stay(version: str) -> None:
    exact = TEXT.format("<inertial auto='true'/>" + COLLISION + EGG.replace("'c'", "'e'"))
    older = twinform.convert(exact.encode(), to="sdf", sdf_version=version)
    through_urdf = twinform.convert(exact.encode(), to="urdf")
    found = [each.document.models[0].links[0].inertial for each in (older, through_urdf)]
    masses = [each and each.mass for each in found]
    assert masses[0] == pytest.approx(masses[1])


def test_a_capsule_of_urdf_1_1_comes_back_from_1_0() -> None:
    new = urdf(f"<visual name='v'>{CAPSULE}</visual>", urdf_version="1.1", carriers=False).text
    old = twinform.convert(new.encode(), to="urdf", urdf_version="1.0").text
    assert kinds(old) == ["cylinder", "sphere", "sphere"]
    assert kinds(twinform.convert(old.encode(), to="urdf", urdf_version="1.1")) == ["capsule"]
    plain = twinform.convert(new.encode(), to="urdf", urdf_version="1.0", carriers=False).text
    assert "tf:" not in plain


def test_a_capsule_is_what_its_parts_are_to_every_reader(tmp_path: Path) -> None:
    model = TEXT.format(COLLISION).encode()
    (tmp_path / "a.urdf").write_text(urdf(COLLISION).text, encoding="utf-8")
    assert twinform.diff(model, tmp_path / "a.urdf").same
    (tmp_path / "a.urdf").write_text(urdf(COLLISION).text.replace('length="0.5"', 'length="0.6"'), encoding="utf-8")
    assert not twinform.diff(model, tmp_path / "a.urdf").same


SENSED = (
    COLLISION
    + "<collision name='box'><geometry><box><size>1 1 1</size></box></geometry></collision>"
    + "<sensor name='s' type='contact'><contact><collision>c</collision><collision>box</collision></contact></sensor>"
)


def test_a_contact_sensor_feels_the_ends_of_a_capsule_too() -> None:
    made = urdf(SENSED)
    # parser_urdf.cc counts all collisions of a link, those at the ends too
    lumped = ["c_collision", "c_end_collision_1", "c_end_1_collision_2", "box_collision_3"]
    assert [f"a_fixed_joint_lump__{each}" for each in lumped] == sensed(made.text)
    assert sensed(twinform.convert(made.text.encode(), to="sdf").text) == ["c", "box"]
    older = twinform.convert(TEXT.format(SENSED).encode(), to="sdf", sdf_version="1.7")
    assert sensed(older.text) == ["c", "c_end", "c_end_1", "box"]
    assert sensed(twinform.convert(older.text.encode(), to="sdf", sdf_version="1.11").text) == ["c", "box"]


def sensed(text: str) -> list[str]:
    return re.findall(r"<collision>(.*)</collision>", text)


def test_names_that_gazebo_keeps_are_those_of_the_ends_too() -> None:
    surface = "<surface><friction><ode><mu>0.3</mu></ode></friction></surface>"
    made = urdf(COLLISION.replace("</collision>", f"{surface}</collision>"))
    names = [each.name for each in twinform.loads(made.text).models[0].links[0].collisions]
    assert names == ["a_c", "a_c_end", "a_c_end_1"]
    assert home(made.text) == (["capsule"], False)
    back = twinform.convert(made.text.encode(), to="sdf").document.models[0].links[0].collisions
    assert [each.name for each in back] == ["c"]


def test_ends_have_names_that_are_free() -> None:
    taken = f"<visual name='v_end'>{CAPSULE}</visual>"
    visuals = twinform.loads(urdf(f"<visual name='v'>{CAPSULE}</visual>{taken}").text).models[0].links[0].visuals
    names = [each.name for each in visuals]
    assert len(set(names)) == len(names) == 6


@pytest.mark.parametrize("carriers", [False, True])
def test_every_polyline_of_a_shape_is_accounted_for(carriers: bool) -> None:
    points = "<point>{0} {1}</point><point>{2} {1}</point><point>{2} {3}</point>"
    outlines = (points.format(0.137, 0.139, 0.983, 0.987), points.format(0.713, 0.317, 0.823, 0.419))
    # the audit tells elements of one name apart by their lines
    shape = "".join(f"\n<polyline>{each}<height>1</height></polyline>" for each in outlines)
    made = urdf(f"<collision name='c'><geometry>{shape}</geometry></collision>", carriers=carriers)
    assert made.source is not None
    assert kinds(made) == ["mesh"]
    assert audit(made.source, made.text, made.ledger).unaccounted == ()
