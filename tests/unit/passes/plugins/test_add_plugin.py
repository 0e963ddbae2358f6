"""Rules: nothing-to-add-to, plugin-reference, measured-wheels, wheels-not-measured, world-system-needed."""

import pickle
from pathlib import Path

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes import PipelineError, parse_pipeline
from twinform.passes.framework.pass_base import option_name
from twinform.passes.plugins.add_plugin import AddPlugin
from twinform.passes.plugins.catalog import system, systems
from twinform.passes.plugins.check_plugins import CheckPlugins
from twinform.passes.plugins.plugin_options import options_of
from twinform.passes.plugins.sites import plugins_of

_EXAMPLES = Path(__file__).parents[4] / "examples"
LEFT, RIGHT = ([f"{end}_{side}_wheel_joint" for end in ("front", "rear")] for side in ("left", "right"))
WHEELS = f"left-joint=[{','.join(LEFT)}] right-joint=[{','.join(RIGHT)}]"
WORLD = """<sdf version="1.11"><world name="w"><plugin name="p" filename="mine"/><model name="a"><link name="base">
  <visual name="skin"><geometry><sphere><radius>1</radius></sphere></geometry></visual>
  <sensor name="eye" type="camera"/></link>
  <model name="inner"><link name="hand"/></model></model><model name="b"><link name="base"/></model></world></sdf>"""


def run(text: str, document: Document) -> tuple[Document, list[tuple[str, str]]]:
    sink = DiagnosticSink()
    made = parse_pipeline(text).run(document, sink)
    return made, [(each.rule.name, each.help or "") for each in sink.diagnostics]


def rover() -> Document:
    return twinform.load(_EXAMPLES / "four_wheels.urdf")


def test_wheels_are_measured_where_the_options_leave_them_out() -> None:
    made, found = run(f"add-plugin{{system=diff-drive {WHEELS}}}", rover())
    assert [rule for rule, _ in found] == ["measured-wheels"]
    [(plugin, site)] = plugins_of(made)
    assert site.scope == "model"
    values = {each.name: each.text for each in plugin.content}
    assert values["wheel_separation"] == "0.43"  # the joints are at y = +-0.215, the wheels' middles as well
    assert values["wheel_radius"] == "0.1"


def test_a_measure_that_is_given_counts() -> None:
    made, found = run(f"add-plugin{{system=diff-drive {WHEELS} wheel-separation=1 wheel-radius=2}}", rover())
    assert not found
    assert {"1", "2"} <= {each.text for each in plugins_of(made)[0][0].content}


@pytest.mark.parametrize(
    ("text", "frames"),
    [
        (f"system=diff-drive {WHEELS}", ("frame_id", "odom", "child_frame_id", "base_link")),
        (f"system=diff-drive {WHEELS} frame-id=map", ("frame_id", "map", "child_frame_id", "base_link")),
        ("system=odometry-publisher", ("odom_frame", "odom", "robot_base_frame", "base_link")),
    ],
)
def test_odometry_is_in_frames_that_ros_has(text: str, frames: tuple[str, str, str, str]) -> None:
    values = {each.name: each.text for each in plugins_of(run(f"add-plugin{{{text}}}", rover())[0])[0][0].content}
    frame, odometry, child, base = frames
    assert (values[frame], values[child]) == (odometry, base)


def test_every_measure_of_a_mecanum_drive_is_read_off() -> None:
    corners = " ".join(
        f"{end}-{side}-joint={name}_{side}_wheel_joint"
        for end, name in (("front", "front"), ("back", "rear"))
        for side in ("left", "right")
    )
    made, _ = run(f"add-plugin{{system=mecanum-drive {corners}}}", rover())
    values = {each.name: each.text for each in plugins_of(made)[0][0].content}
    assert (values["wheelbase"], values["wheel_separation"], values["wheel_radius"]) == ("0.38", "0.43", "0.1")


def test_tracks_are_measured_from_link_to_link() -> None:
    links = "".join(f'<link name="{name}"><pose>0.1 {y} 0 0 0 0</pose></link>' for name, y in (("l", 0.3), ("r", -0.2)))
    document = twinform.loads(f'<sdf version="1.11"><model name="m"><link name="base"/>{links}</model></sdf>')
    made, found = run("add-plugin{system=tracked-vehicle left-track-link=l right-track-link=r}", document)
    assert found == [("measured-wheels", "")]
    assert {each.name: each.text for each in plugins_of(made)[0][0].content}["tracks_separation"] == "0.5"


def test_an_ackermann_drive_is_measured_at_its_steering_joints_and_driven_wheels() -> None:
    shape = '<collision name="c"><geometry><cylinder><radius>0.2</radius><length>0.1</length></cylinder></geometry>'
    side = '<pose relative_to="{0}">0 0 0 1.5707963267948966 0 0</pose></collision>'
    ends = [
        (end, hand, x, y) for end, x in (("front", 0.8), ("rear", 0.0)) for hand, y in (("left", 0.5), ("right", -0.5))
    ]
    links = "".join(
        f'<link name="{end}_{hand}"><pose>{x} {y} 0 0 0 0</pose>{shape}{side.format(f"{end}_{hand}")}</link>'
        f'<joint name="{end}_{hand}_wheel" type="revolute"><parent>{"base" if end == "rear" else f"k_{hand}"}</parent>'
        f"<child>{end}_{hand}</child><axis><xyz>0 1 0</xyz></axis></joint>"
        for end, hand, x, y in ends
    )
    knuckles = "".join(
        f'<link name="k_{hand}"><pose>0.8 {y} 0 0 0 0</pose></link><joint name="steer_{hand}" type="revolute">'
        f"<parent>base</parent><child>k_{hand}</child><axis><xyz>0 0 1</xyz></axis></joint>"
        for hand, y in (("left", 0.4), ("right", -0.4))
    )
    text = f'<sdf version="1.11"><model name="m"><link name="base"/>{knuckles}{links}</model></sdf>'
    joints = " ".join(
        f"{hand}-steering-joint=steer_{hand} {hand}-joint=rear_{hand}_wheel" for hand in ("left", "right")
    )
    made, _ = run(f"add-plugin{{system=ackermann-steering {joints}}}", twinform.loads(text))
    values = {each.name: each.text for each in plugins_of(made)[0][0].content}
    assert (values["wheel_base"], values["kingpin_width"]) == ("0.8", "0.8")
    assert (values["wheel_separation"], values["wheel_radius"]) == ("1", "0.2")


def test_adding_twice_is_adding_once() -> None:
    once = f"add-plugin{{system=diff-drive {WHEELS}}}"
    assert run(f"{once},{once}", rover())[0] == run(once, rover())[0]


def test_what_is_added_passes_check_plugins() -> None:
    made, _ = run(f"add-plugin{{system=diff-drive {WHEELS}}},add-plugin{{system=joint-state-publisher}}", rover())
    sink = DiagnosticSink()
    CheckPlugins().run(made, sink)
    assert not sink.diagnostics


def test_the_first_plugin_of_a_world_brings_those_that_it_switches_off() -> None:
    made, _ = run("add-plugin{system=physics}", twinform.loads('<sdf version="1.11"><world name="w"/></sdf>'))
    names = [(plugin.name or "").rsplit("::", 1)[-1] for plugin, _ in plugins_of(made)]
    assert names == ["UserCommands", "SceneBroadcaster", "Physics"]


def test_things_that_repeat_take_lists() -> None:
    options = "wheel-link-name=[a,b] wheel-slip-compliance-lateral=[0.1,0.2] wheel-wheel-radius=1"
    model = '<sdf version="1.11"><model name="r"><link name="a"/><link name="b"/></model></sdf>'
    [(plugin, _)] = plugins_of(run(f"add-plugin{{system=wheel-slip {options}}}", twinform.loads(model))[0])
    assert [each.get("link_name") for each in plugin.content] == ["a", "b"]
    lateral = [each.find("slip_compliance_lateral") for each in plugin.content]
    assert [each.text for each in lateral if each] == ["0.1", "0.2"]
    assert all(each.find("wheel_radius") for each in plugin.content)


def test_elements_of_any_content_are_xml() -> None:
    text = "add-plugin{system=performer-detector geometry-box-size=[1,2,3]}"
    [(plugin, _)] = plugins_of(run(text, twinform.loads('<robot name="r"><link name="a"/></robot>'))[0])
    box = plugin.content[0].children[0]
    assert (box.name, box.children[0].text) == ("box", "1 2 3")


@pytest.mark.parametrize(
    ("text", "scope", "holder"),
    [
        ("add-plugin{system=imu}", "world", "w"),
        ("add-plugin{system=joint-state-publisher model=b}", "model", "b"),
        ("add-plugin{system=pose-publisher model=a::inner}", "model", "inner"),
        ("add-plugin{system=camera-video-recorder on=eye}", "sensor", "eye"),
        ("add-plugin{system=thermal on=skin temperature=300}", "visual", "skin"),
        ("add-plugin{system=label on=base label=3 model=a}", "visual", "skin"),
    ],
)
def test_a_system_goes_where_it_belongs(text: str, scope: str, holder: str) -> None:
    text = text.replace("on=skin", "on=skin model=a")
    made, found = run(text, twinform.loads(WORLD))
    assert not found
    new = [(site.scope, site.holder) for plugin, site in plugins_of(made) if plugin.filename != "mine"]
    assert new == [(scope, holder)]
    assert run(f"{text},{text}", twinform.loads(WORLD))[0] == made


@pytest.mark.parametrize(
    ("text", "model", "rule", "help_"),
    [
        ("add-plugin{system=imu}", '<robot name="r"><link name="a"/></robot>', "nothing-to-add-to", ""),
        ("add-plugin{system=joint-state-publisher}", WORLD, "nothing-to-add-to", ""),
        ("add-plugin{system=joint-state-publisher model=inner}", WORLD, "nothing-to-add-to", "did you mean a::inner?"),
        ("add-plugin{system=imu world=v}", WORLD, "nothing-to-add-to", "there are w"),
        ("add-plugin{system=thermal on=nose model=b}", WORLD, "nothing-to-add-to", "did you mean base?"),
        ("add-plugin{system=camera-video-recorder on=eyes}", WORLD, "nothing-to-add-to", "did you mean eye?"),
        ("add-plugin{system=hydrodynamics link-name=bas model=b}", WORLD, "plugin-reference", "did you mean base?"),
    ],
)
def test_what_cannot_be_added_is_an_error_and_changes_nothing(text: str, model: str, rule: str, help_: str) -> None:
    document, sink = twinform.loads(model), DiagnosticSink()
    assert parse_pipeline(text).run(document, sink) is document
    assert [(each.rule.name, each.is_error) for each in sink.diagnostics] == [(rule, True)]
    if rule == "plugin-reference":
        assert (sink.diagnostics[0].found, sink.diagnostics[0].help) == ("bas", help_)
    assert help_ in (sink.diagnostics[0].help or "") or help_ in {"did you mean base?", "did you mean a::inner?"}


def test_wheels_without_a_radius_are_an_error() -> None:
    text = """<robot name="r"><link name="base"/>{}</robot>""".format(
        "".join(
            f'<link name="{side}"/><joint name="{side}_joint" type="continuous"><parent link="base"/>'
            f'<child link="{side}"/><origin xyz="0 {y} 0"/><axis xyz="0 1 0"/></joint>'
            for side, y in (("left", 1), ("right", -1))
        )
    )
    made, found = run(
        "add-plugin{system=diff-drive left-joint=left_joint right-joint=right_joint}", twinform.loads(text)
    )
    assert {rule for rule, _ in found} == {"measured-wheels", "wheels-not-measured"}
    assert not plugins_of(made)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("add-plugin{system=difdrive}", "did you mean diff-drive"),
        ("add-plugin{system=diff-drive lef-joint=a}", "did you mean left-joint"),
        ("add-plugin{system=diff-drive left-joint=a}", "needs the option right-joint"),
        ("add-plugin{left-joint=a}", "needs the option system"),
        ("add-plugin{system=diff-drive left-joint=a right-joint=b wheel-radius=big}", "option wheel-radius"),
        ('add-plugin{system=diff-drive left-joint=a right-joint=b topic="a b"}', "has to be a topic"),
        ("add-plugin{system=drive-to-pose-controller}", "not in harmonic"),
        ("add-plugin{system=lift-drag link-name=a reversible=true}", "does not read reversible in harmonic"),
        ("add-plugin{system=odometry-publisher dimensions=4}", "has to be one of 2, 3"),
        ("add-plugin{system=tracked-vehicle left-track-velocity-topic=a}", "needs the option"),
        ("add-plugin{system=touch-plugin target=a time=1 release=garden}", "needs the option namespace in garden"),
        ('add-plugin{system=breadcrumbs breadcrumb="<a>"}', "XML"),
    ],
)
def test_a_wrong_option_is_reported_at_its_place(text: str, complaint: str) -> None:
    with pytest.raises(PipelineError, match=complaint):
        parse_pipeline(text)


@pytest.mark.parametrize(
    "text", [f"add-plugin{{system=diff-drive {WHEELS} wheel-radius=0.25}}", "add-plugin{system=imu}"]
)
def test_a_pass_is_written_and_sent_as_it_was(text: str) -> None:
    [made] = parse_pipeline(text)
    assert [*parse_pipeline(str(parse_pipeline(text)))] == [made]
    assert pickle.loads(pickle.dumps(made)) == made


def test_python_may_call_it_with_the_options_of_the_system() -> None:
    made = AddPlugin.model_validate({"system": "diff-drive", "left-joint": "a", "right-joint": ["b"]})
    assert made == AddPlugin(system="diff-drive", **{"left-joint": ["a"], "right-joint": ["b"]})  # pyright: ignore[reportArgumentType] - options of the system


def test_options_of_all_systems_have_names_of_their_own() -> None:
    own = {option_name(name, field) for name, field in AddPlugin.model_fields.items()}
    for kind in systems().values():
        leaves = {path for path, row in kind.walk() if row.type != "element" or row.free}
        either = {path for path in leaves if (*path[:-1], path[-1].lstrip("@")) in leaves - {path}}
        assert len(options_of(kind)) >= len(leaves - either)
        assert not own & set(options_of(kind))
    assert len(options_of(system("hydrodynamics"))) > 500


@pytest.mark.parametrize("release", ["harmonic", "jetty"])
def test_a_touch_needs_no_namespace_since_harmonic(release: str) -> None:
    [made] = parse_pipeline(f"add-plugin{{system=touch-plugin target=a time=1 release={release}}}")
    assert isinstance(made, AddPlugin)


def test_a_system_gets_the_one_of_the_world_that_it_needs() -> None:
    text = "add-plugin{system=hydrodynamics model=a link-name=base}"
    made, found = run(text, twinform.loads(WORLD))
    assert [rule for rule, _ in found] == ["added-world-system"]
    [buoyancy] = [each for each in made.worlds[0].plugins if each.filename == system("buoyancy").file]
    assert [each.name for each in buoyancy.content] == ["graded_buoyancy"]  # one density everywhere lifts everything
    assert made.worlds[0].models[0].plugins
    again, found = run(text, made)
    assert (again, found) == (made, [])


def test_a_system_reports_what_a_world_has_to_have_where_there_is_none() -> None:
    _, found = run(
        "add-plugin{system=comms-endpoint address=a topic=b}",
        twinform.loads('<sdf version="1.11"><model name="m"><link name="l"/></model></sdf>'),
    )
    assert [rule for rule, _ in found] == ["world-system-needed"]
    assert "gz-sim-perfect-comms-system" in found[0][1]
