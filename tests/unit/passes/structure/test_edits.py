"""New names, other roots and welds: all that comes out of them, and where what they say belongs."""

from math import cos, sin

import pytest

import twinform
from tests.unit.passes.reported import findings
from twinform.diagnostics import DiagnosticSink, LineOrigins, Location
from twinform.passes import parse_pipeline
from twinform.passes.structure.model_edit import edit_in_modern_sdf

ROBOT = "/robot[@name='r']"


def edited(text: str, passes: str) -> twinform.Conversion:
    version = text.partition('<sdf version="')[2].partition('"')[0]
    return twinform.convert(text.encode(), to="sdf" if version else "urdf", sdf_version=version or None, passes=passes)


SHARED = """<robot name="r"><link name="base"/><link name="x"/>
<joint name="x" type="fixed"><parent link="base"/><child link="x"/></joint>
<gazebo reference="x"><gravity>false</gravity></gazebo>
<gazebo reference="base"><gravity>false</gravity></gazebo>
</robot>"""


@pytest.mark.parametrize(
    ("options", "names", "link"),
    [
        ("names=[x:y] kinds=[link]", ("y", "x", "y"), "y"),
        ("names=[x:y] kinds=[joint]", ("x", "y", "x"), "x"),
        ("names=[x:y]", ("y", "y", "y"), None),
    ],
)
def test_a_block_for_two_parts_follows_the_link(options: str, names: tuple[str, str, str], link: str | None) -> None:
    made = edited(SHARED, f"rename{{{options}}}")
    model = made.document.models[0]
    joint = model.joints[0]
    assert (model.links[1].name, joint.name, joint.child) == names
    assert [each.reference for each in model.extensions] == [names[0], "base"]
    message = f"<gazebo> for 'x', a link and a joint, follows the link to {link!r}"
    expected = [("unfollowed-name", 3, f"{ROBOT}/gazebo[1]/@reference", message, "x")]
    assert findings(made) == (expected if link else [])


def chain(*joints: tuple[str, str, str, str, str]) -> str:
    """A robot of joints that stand in a row; the order of links is that of the chain."""
    links = "".join(f'<link name="{name}"/>' for name in ("base", "arm", "hand", "tip"))
    return f'<robot name="r">{links}{"".join(map(_joint, joints))}</robot>'


def _joint(words: tuple[str, str, str, str, str]) -> str:
    name, kind, parent, child, xyz = words
    axis = "" if kind == "fixed" else '<axis xyz="0 0 1"/><limit lower="-1" upper="2" effort="1" velocity="1"/>'
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}<origin xyz="{xyz}"/>{axis}</joint>'


FIX = ("fix", "fixed", "base", "arm", "0 0 1")
TURN = ("turn", "revolute", "arm", "hand", "1 0 0")
BEND = ("bend", "revolute", "hand", "tip", "0 1 0")


@pytest.mark.parametrize("joints", [(FIX, TURN, BEND), (TURN, FIX, BEND), (BEND, TURN, FIX)])
def test_there_and_back_no_helper_is_left_wherever_its_joint_stands(
    joints: tuple[tuple[str, str, str, str, str], ...],
) -> None:
    text = chain(*joints)
    there = edited(text, "reroot{link=tip}").document.models[0]
    assert {link.name for link in there.links} == {"base", "arm", "hand", "tip", "turn_reversed", "bend_reversed"}
    ends = {joint.name: (joint.type, joint.parent, joint.child) for joint in there.joints}
    assert ends == {
        "fix": ("fixed", "arm", "base"),
        "turn": ("revolute", "hand", "turn_reversed"),
        "turn_reversed_joint": ("fixed", "turn_reversed", "arm"),
        "bend": ("revolute", "tip", "bend_reversed"),
        "bend_reversed_joint": ("fixed", "bend_reversed", "hand"),
    }
    assert edited(text, "reroot{link=tip},reroot{link=base}").document == twinform.loads(text)


@pytest.mark.parametrize(
    "block",
    ['<gazebo reference="turn_reversed"><gravity>0</gravity></gazebo>', '<gazebo reference="turn_reversed_joint"/>'],
)
def test_a_helper_stays_that_has_settings(block: str) -> None:
    there = edited(chain(FIX, TURN, BEND), "reroot{link=tip}").text.replace("</robot>", f"{block}</robot>")
    back = edited(there, "reroot{link=base}").document.models[0]
    assert "turn_reversed" in [link.name for link in back.links]
    assert "bend_reversed" not in [link.name for link in back.links]


def sdf(links: str, joints: str = "", model: str = "") -> str:
    made = "".join(f"<link name='{name}'/>\n" for name in links.split())
    return f'<sdf version="1.9"><model name="r">{model}\n{made}{joints}</model></sdf>'


def held(name: str, parent: str, child: str, kind: str = "fixed", inside: str = "") -> str:
    return f"<joint name='{name}' type='{kind}'><parent>{parent}</parent><child>{child}</child>{inside}</joint>\n"


GEARS = "<gearbox_reference_body>a</gearbox_reference_body>"


@pytest.mark.parametrize(
    ("joints", "base"),
    [
        ("", "a"),
        (held("j", "a", "b"), "a"),
        (held("j", "b", "a"), "b"),
        (held("j", "b", "a") + held("k", "c", "b"), "c"),
        (held("g", "b", "a", "gearbox", GEARS), "a"),
        (held("g", "b", "a", "gearbox", GEARS) + held("j", "c", "a"), "c"),
        (held("j", "c", "a") + held("k", "b", "a"), "c"),
    ],
)
def test_the_link_that_all_else_hangs_from_is_welded(joints: str, base: str) -> None:
    made = edited(sdf("a b c", joints), "weld-to-world").document.models[0].joints[-1]
    assert (made.name, made.type, made.parent, made.child, made.pose) == ("world_joint", "fixed", "world", base, None)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (sdf("a b", held("j", "world", "a")), "fixed to the world"),
        (sdf("a b", held("j", "b", "a") + held("k", "world", "b")), "fixed to the world"),
        (sdf("a b", model="<static>true</static>"), "static"),
    ],
)
def test_what_is_held_already_is_not_welded(text: str, words: str) -> None:
    made = edited(text, "weld-to-world{xyz=[0,0,1]}")
    assert made.document == twinform.loads(text)
    assert [each for each in findings(made) if each[0] == "already-held"] == [
        ("already-held", 1, "/sdf/model[@name='r']", f"model 'r' is {words} already", "r")
    ]


def test_a_weld_takes_no_name_twice() -> None:
    document = twinform.loads(sdf("a b", held("j", "a", "b")))
    for name, line, path in (("j", 4, "joint[@name='j']"), ("b", 3, "link[@name='b']")):
        sink = DiagnosticSink()
        made = parse_pipeline(f"weld-to-world{{joint={name}}}").run(document, sink)
        assert made is document
        assert [
            (each.rule.name, each.location.line, each.location.path, each.message, each.found)
            for each in sink.diagnostics
        ] == [
            (
                "name-clash",
                line,
                f"/sdf/model[@name='r']/{path}",
                f"{name!r} is the name of another part of model 'r'",
                name,
            )
        ]


@pytest.mark.parametrize(
    ("options", "xyz", "rpy"),
    [
        ("xyz=[1,2,3]", (1, 1, 3), None),
        ("rpy=[0,0,0.5]", (sin(0.5), -cos(0.5), 0), (0, 0, 0.5)),
        ("xyz=[1,2,3] rpy=[0,0,0.5]", (1 + sin(0.5), 2 - cos(0.5), 3), (0, 0, 0.5)),
    ],
)
def test_a_weld_puts_the_base_where_its_options_say(
    options: str, xyz: tuple[float, float, float], rpy: tuple[float, float, float] | None
) -> None:
    base = "<link name='a'><pose>0 1 0 0 0 0</pose></link>"
    text = sdf("b", model=f"<pose>7 7 7 0 0 0</pose>{base}")
    pose = edited(text, f"weld-to-world{{{options}}}").document.models[0].pose
    assert pose
    assert pose.xyz == pytest.approx(xyz)
    assert pose.rpy == (pytest.approx(rpy) if rpy else None)
    assert pose.relative_to is None


TURNS = "<axis><xyz>0 0 1</xyz></axis>"


@pytest.mark.parametrize(
    ("pose", "expected"),
    [
        ("", "<pose relative_to='b'/>"),
        ("<pose>1 2 3 0 0 0</pose>", "<pose relative_to='b'>1 2 3 0 0 0</pose>"),
        ("<pose relative_to='a'/>", ""),
        ("<pose relative_to='a'>1 2 3 0 0 0</pose>", "<pose>1 2 3 0 0 0</pose>"),
        ("<pose relative_to='c'>1 2 3 0 0 0</pose>", "<pose relative_to='c'>1 2 3 0 0 0</pose>"),
    ],
)
def test_the_frame_of_a_reversed_joint_stays_where_it_is(pose: str, expected: str) -> None:
    rest = held("k", "b", "c")
    made = edited(sdf("a b c", held("j", "a", "b", "revolute", pose + TURNS) + rest), "reroot{link=b}")
    turned = TURNS.replace("1<", "-1<")
    assert made.document == twinform.loads(sdf("a b c", held("j", "b", "a", "revolute", expected + turned) + rest))


def block(content: str) -> str:
    return f'<gazebo reference="turn">{content}</gazebo>'


def torque(type_: str, frame: str, direction: str) -> str:
    words = f"<frame>{frame}</frame><measure_direction>{direction}</measure_direction>"
    return f'<sensor name="s" type="{type_}"><update_rate>3</update_rate><force_torque>{words}</force_torque></sensor>'


BARE = '<sensor name="s" type="{}"/>'


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (torque("force_torque", "child", "child_to_parent"), torque("force_torque", "parent", "parent_to_child")),
        (torque("force_torque", "parent", "parent_to_child"), torque("force_torque", "child", "child_to_parent")),
        (torque("imu", "child", "child_to_parent"), torque("imu", "child", "child_to_parent")),
        (BARE.format("imu"), BARE.format("imu")),
        (
            BARE.format("force_torque"),
            torque("force_torque", "parent", "parent_to_child").replace("<update_rate>3</update_rate>", ""),
        ),
    ],
)
def test_a_sensor_of_force_on_a_reversed_joint_measures_the_other_way(before: str, after: str) -> None:
    made = edited(chain(FIX, TURN, BEND).replace("</robot>", block(before) + "</robot>"), "reroot{link=tip}")
    wanted = twinform.loads(f'<robot name="r"><link name="a"/>{block(after)}</robot>'.replace("turn", "a"))
    [found] = made.document.models[0].extensions
    assert found.content == wanted.models[0].extensions[0].content


@pytest.mark.parametrize("names", ["m:new", "l:new", "m:new,l:other"])
def test_the_state_of_a_model_follows_its_parts_and_keeps_what_else_it_has(names: str) -> None:
    world = """<sdf version="1.9"><world name="w"><model name="r"><link name="a"/>
<model name="{m}"><link name="k"/></model><link name="{l}"/></model>
<state world_name="w"><model name="r" about="m"><link name="{l}"><pose>1 0 0 0 0 0</pose></link>
<model name="{m}" about="m"><link name="k"/></model></model></state></world></sdf>"""
    new = dict(pair.split(":") for pair in names.split(","))
    made = edited(world.format(m="m", l="l"), f"rename{{names=[{names}]}}")
    assert made.document == twinform.loads(world.format(**{"m": "m", "l": "l", **new}))


@pytest.mark.parametrize(
    ("text", "expected"),
    [("l", "new"), ("m::l", "m::new"), ("m::x", "m::x"), ("x::l", "x::l"), ("m::inner::k", "m::inner::k")],
)
def test_a_name_may_begin_with_the_model(text: str, expected: str) -> None:
    model = """<sdf version="1.9"><model name="m"><link name="{}"/><model name="inner"><link name="k"/></model>
<plugin filename="f" name="p"><link_name>{}</link_name></plugin></model></sdf>"""
    made = edited(model.format("l", text), "rename{names=[l:new]}")
    assert made.document == twinform.loads(model.format("new", expected))


def test_raising_the_version_is_reported_where_an_expanded_text_was_written() -> None:
    text = sdf(
        "a b",
        held(
            "j", "a", "b", "revolute", "<axis><xyz>1 0 0</xyz><use_parent_model_frame>0</use_parent_model_frame></axis>"
        ),
    )
    document = twinform.loads(text.replace("1.9", "1.6"), "x (expanded)")
    sink = DiagnosticSink("x", origins={"x (expanded)": LineOrigins.of([(1, Location("x.xacro", 30))])})
    made = edit_in_modern_sdf(document, sink, lambda modern: modern.copy(models=modern.models * 1))
    assert made.version == "1.8"
    found = [(each.rule.name, each.location.file, each.location.line, each.found) for each in sink.diagnostics]
    assert found == [("raised-version", "x.xacro", 30, "1.6")]
    assert {(each.location.file, each.location.line) for each in sink.entries} == {("x.xacro", 30)}


WORLD = """<sdf version="1.9"><world name="w"><gui><plugin name="a" filename="A"/><camera name="c"/>{}</gui>
<model name="m"><link name="l"/></model></world></sdf>"""
PLUGIN = '<plugin name="b" filename="B"><plugin name="b"/></plugin>'


@pytest.mark.parametrize("word", ["b", "B", "[bB]"])
def test_what_is_kept_as_it_is_loses_what_is_to_go(word: str) -> None:
    made = edited(WORLD.format(PLUGIN), f'drop{{plugins="{word}"}}')
    assert made.document == twinform.loads(WORLD.format(""))
    kept = edited(WORLD.format(PLUGIN), f'drop{{plugins="{word}" links=l}}')
    assert kept.document == twinform.loads(WORLD.format(PLUGIN))
    assert findings(kept) == [("nothing-matched", 1, "/sdf", f"none of the plugins is called {word}", word)]


NESTED = """<sdf version="1.9"><model name="m"><link name="l"/>
<model name="inner" placement_frame="f"><pose>1 0 0 0 0 0</pose><link name="x"/>
<frame name="f" attached_to="x"/>
<plugin filename="a" name="a"><thing>x</thing></plugin></model>
</model></sdf>"""


def test_the_frame_that_places_a_nested_model_follows() -> None:
    model = edited(NESTED, "prefix-names{prefix=p_}").document.models[0]
    (inner,) = model.models
    assert (model.links[0].name, inner.name, inner.placement_frame) == ("p_l", "p_inner", "f")
    inner = edited(NESTED, "rename{names=[f:g] kinds=[frame]}").document.models[0].models[0]
    assert (inner.placement_frame, [each.name for each in inner.frames]) == ("g", ["g"])
