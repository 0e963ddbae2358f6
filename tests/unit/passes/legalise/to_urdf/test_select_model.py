"""One model out of a file: what is reported of all that is left."""

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink, Fate
from twinform.ir import Document, Pose
from twinform.passes.legalise.to_urdf.select_model import SelectModel

WORLD = """<sdf version="1.11">
<world name="w"><gravity>0 0 -1</gravity>
<frame name="dock"><pose>1 0 0 0 0 0</pose></frame>
<model name="n"><link name="a"/></model>
<model name="m">
<pose relative_to="dock">0 2 0 0 0 0</pose>
<link name="a"/></model>
<light name="sun" type="point"/>
<plugin name="p" filename="libp.so"/>
<mine x="1"/>
</world>
<world name="other"/>
<light name="moon" type="point"/>
<mine name="x"/>
</sdf>"""
W = "/sdf/world[@name='w']"


def selected(text: str, model: str | None = None) -> tuple[Document, DiagnosticSink, Document]:
    document, sink = twinform.loads(text, "w.sdf"), DiagnosticSink("w.sdf")
    return document, sink, SelectModel(model=model).run(document, sink)


@pytest.mark.parametrize("name", ["m", "w::m"])
def test_every_part_around_the_model_is_accounted_for_where_it_stands(name: str) -> None:
    document, sink, made = selected(WORLD, name)
    placed = document.worlds[0].models[1].copy(pose=Pose(xyz=(1, 2, 0)))
    nothing = {"worlds": (), "lights": (), "opaque": ()}
    assert made == document.copy(**{"models": (placed,), **nothing})
    assert sink.diagnostics == []
    found = [(each.location.line, each.location.path, each.message, each.weight) for each in sink.entries]
    pose = "the pose of model 'm' is relative to 'dock', which"
    assert found == [
        (line, path, f"{part} is not part of the robot", weight)
        for line, path, part, weight in [
            (6, f"{W}/model[@name='m']/pose", pose, 1),
            (14, "/sdf/mine", "<mine> 'x'", 2),
            (13, "/sdf/light[@name='moon']", "light 'moon'", 3),
            (2, f"{W}/@name", "world 'w' around the model", 2),
            (10, f"{W}/mine", "<mine>", 2),
            (2, f"{W}/gravity", "<gravity> of the world", 1),
            (4, f"{W}/model[@name='n']", "model 'n'", 4),
            (8, f"{W}/light[@name='sun']", "light 'sun'", 3),
            (3, f"{W}/frame[@name='dock']", "frame 'dock'", 5),
            (9, f"{W}/plugin[@name='p']", "plugin 'p'", 3),
            (12, "/sdf/world[@name='other']", "world 'other'", 2),
        ]
    ]
    assert {(each.fate, each.rule.name, each.location.file) for each in sink.entries} == {
        (Fate.DROPPED, "outside-model", "w.sdf")
    }


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (None, "there are 2 models, and a URDF file holds one robot; choose one of w::n, w::m"),
        ("x", "no models are called 'x'; there are w::n, w::m"),
    ],
)
def test_it_has_to_be_clear_which_model_is_meant(name: str | None, message: str) -> None:
    document, sink, made = selected(WORLD, name)
    assert made is document
    (one,) = sink.diagnostics
    assert (one.rule.name, one.message, one.found, one.expected) == ("model-not-chosen", message, name, "w::n, w::m")
    assert (one.location.line, one.location.path) == (1, "/sdf")
    assert [(each.line, each.path) for each in one.related] == [
        (4, f"{W}/model[@name='n']"),
        (5, f"{W}/model[@name='m']"),
    ]
    assert sink.entries == []


def test_a_file_without_a_model_is_reported() -> None:
    _, sink, _ = selected('<sdf version="1.11"><world name="w"/></sdf>')
    (one,) = sink.diagnostics
    assert (one.rule.name, one.message, one.expected) == ("model-not-chosen", "there is no model in the file", "none")


def test_an_include_that_was_not_read_is_no_model() -> None:
    document, sink, made = selected(
        '<sdf version="1.11"><world name="w">\n<include><uri>model://x</uri></include></world></sdf>'
    )
    assert made is document
    (one,) = sink.diagnostics
    assert (one.rule.name, one.message, one.found, one.location.line) == (
        "include-not-expanded",
        "the model is in 'model://x', which was not read",
        "model://x",
        2,
    )


def test_a_pose_in_the_world_or_in_no_frame_at_all_stays() -> None:
    text = WORLD.replace(' relative_to="dock"', "")
    document, sink, made = selected(text, "m")
    assert made.models[0] is document.worlds[0].models[1]
    assert "pose" not in [each.location.path.rpartition("/")[2] for each in sink.entries]


def test_a_frame_that_nobody_knows_is_an_error() -> None:
    document = twinform.loads(WORLD)
    world = document.worlds[0]
    document = document.copy(worlds=(world.copy(frames=()),))
    sink = DiagnosticSink()
    SelectModel(model="m").run(document, sink)
    (one,) = sink.diagnostics
    assert (one.rule.name, one.message, one.found) == ("dangling-frame", "there is no frame 'dock'", "dock")


MJCF = """<sdf version="1.11" xmlns:tf="urn:twinform:1"><world name="w">
<model name="m"><link name="a"><tf:mjcf><geom type="mesh" mesh="post" material="wood"/></tf:mjcf></link></model>
<model name="n"><link name="b"/></model>
<tf:mjcf><asset><texture name="grain"/><material name="wood" texture="grain"/><mesh name="post"/>
<mesh name="b"/></asset></tf:mjcf></world></sdf>"""


def test_assets_of_mjcf_go_with_the_model_that_names_them() -> None:
    _, sink, made = selected(MJCF, "m")
    assets = [each.get("name") for part in made.models[0].opaque if part.element for each in part.element.walk()]
    assert [each for each in assets if each] == ["grain", "wood", "post"]
    # the element of ours, the section, and a mesh with its name
    assert [each.weight for each in sink.entries if "mjcf" in each.location.path] == [4]
    assert not selected(MJCF, "n")[2].models[0].opaque
