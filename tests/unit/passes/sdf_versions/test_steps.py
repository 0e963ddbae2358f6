"""SDF in other versions: each step by itself, the reverse steps, and carriers that nobody can trust any more."""

import pytest
from lxml import etree

import twinform
from testbed.corpus.versions import first_difference
from twinform.diagnostics import Fate
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.sdf_versions.put_back import comparable

TF = {"tf": NAMESPACE}
LINKS = "<link name='a'/><link name='b'><pose>1 0 0 0 0 0</pose></link>"
BOX = "<geometry><box><size>1 1 1</size></box></geometry>"


def model(inside: str) -> str:
    return f"<model name='m'>{inside}</model>"


def world(inside: str) -> str:
    return f"<world name='w'>{inside}</world>"


def joint(kind: str, inside: str = "", *, name: str = "j", parent: str = "a", child: str = "b") -> str:
    return f"<joint name='{name}' type='{kind}'><parent>{parent}</parent><child>{child}</child>{inside}</joint>"


def arm(kind: str, inside: str = "") -> str:
    return model(LINKS + joint(kind, inside))


def physics(inside: str, kind: str = "ode") -> str:
    return world(f"<physics type='{kind}'>{inside}</physics>")


def imu(inside: str) -> str:
    return model(f"<link name='a'><sensor name='s' type='imu'><imu>{inside}</imu></sensor></link>")


def sdf(version: str, inside: str) -> bytes:
    return f"<sdf version='{version}'>{inside}</sdf>".encode()


def rewrite(text: bytes | str, version: str, *, carriers: bool = True) -> twinform.Conversion:
    data = text.encode() if isinstance(text, str) else text
    return twinform.convert(data, to="sdf", sdf_version=version, name="x.sdf", carriers=carriers)


def values_at(text: str, path: str) -> list[str]:
    found = etree.fromstring(text.encode()).xpath(path, namespaces=TF)
    assert isinstance(found, list)
    return [str(each) for each in found]  # pyright: ignore[reportUnknownArgumentType, reportUnknownVariableType] - texts


AXIS = "<axis><xyz>0 0 1</xyz>{}</axis>"
UP: list[tuple[str, str, str, list[str]]] = [
    # 1.4: time steps
    ("1.3", physics("<update_rate>50</update_rate>"), "//physics/real_time_update_rate/text()", ["50"]),
    ("1.3", physics("<ode><solver><dt>0.1</dt></solver></ode>"), "//physics/max_step_size/text()", ["0.1"]),
    ("1.3", physics("<bullet><dt>0.2</dt></bullet>", "bullet"), "//physics/max_step_size/text()", ["0.2"]),
    # 1.5 and 1.7: axes
    ("1.4", arm("revolute", "<axis><xyz>1 0 0</xyz></axis>"), "//xyz/@expressed_in", ["__model__"]),
    ("1.5", arm("revolute", "<axis><xyz>1 0 0</xyz></axis>"), "//xyz/@expressed_in", []),
    (
        "1.6",
        arm("revolute", "<axis><xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>"),
        "//xyz/@expressed_in",
        ["__model__"],
    ),
    (
        "1.6",
        arm("revolute", "<axis><xyz>1 0 0</xyz><use_parent_model_frame>0</use_parent_model_frame></axis>"),
        "//xyz/@expressed_in | //tf:version/@until",
        ["1.6"],
    ),
    # 1.6: gravity, magnetic field, noise, names of lights
    ("1.5", physics("<gravity>0 0 -1</gravity>"), "/sdf/world/gravity/text()", ["0 0 -1"]),
    ("1.5", physics("<magnetic_field>1 2 3</magnetic_field>"), "/sdf/world/magnetic_field/text()", ["1 2 3"]),
    (
        "1.4",
        imu("<noise><rate><mean>1</mean></rate><accel><stddev>2</stddev></accel></noise>"),
        "//angular_velocity/*/noise/mean/text() | //linear_acceleration/*/noise/stddev/text()",
        ["1", "1", "1", "2", "2", "2"],
    ),
    (
        "1.4",
        imu("<noise><rate><mean>1</mean></rate></noise>"),
        "//angular_velocity/x/noise/@type",
        ["gaussian"],
    ),
    ("1.5", world("<light type='point'/>"), "//light/@name", ["light"]),
    # 1.7: frames and names
    (
        "1.6",
        model("<link name='a'/><link name='b'><pose frame='a'>1 0 0 0 0 0</pose></link>"),
        "//pose/@relative_to",
        ["a"],
    ),
    ("1.6", model("<link name='a'><pose frame=''>1 0 0 0 0 0</pose></link>"), "//pose/@relative_to", []),
    ("1.6", model(LINKS + joint("revolute", name="a")), "//joint/@name", ["a_joint"]),
    ("1.6", model(LINKS + "<frame name='b'/>"), "/sdf/model/frame/@name", ["b_frame"]),
    (
        "1.6",
        model(
            "<link name='__r__'/>" + LINKS + joint("revolute", name="r", parent="__r__", child="a")
            + joint("gearbox", "<gearbox_reference_body>__r__</gearbox_reference_body>")
        ),
        "//gearbox_reference_body/text() | //joint[@name='r']/parent/text()",
        ["r_link", "r_link"],
    ),
    (
        "1.6",
        model(
            LINKS + "<link name='c'/>" + joint("revolute", AXIS.format(""), name="a")
            + joint("revolute", AXIS.format("<mimic joint='a'/>"), child="c")
        ),
        "//mimic/@joint",
        ["a_joint"],
    ),
    (
        "1.6",
        model("<link name='__r__'/><model name='n'><pose frame='__r__'>1 0 0 0 0 0</pose><link name='a'/></model>"),
        "/sdf/model/model/pose/@relative_to",
        ["r_link"],
    ),
    # 1.8: nested models, inertials
    (
        "1.7",
        model("<link name='n::a'><pose>1 0 0 0 0 0</pose></link><link name='b'/>"),
        "/sdf/model/model/@name | /sdf/model/model/link/@name | /sdf/model/link/@name",
        ["b", "n", "a"],
    ),
    (
        "1.7",
        model("<link name='n::a'/><link name='n::b'/>" + joint("fixed", name="n::j", parent="n::a", child="n::b")),
        "/sdf/model/model/joint/*/text()",
        ["a", "b"],
    ),
    (
        "1.7",
        model(
            "<frame name='n::__model__'><pose>0 2 0 0 0 0</pose></frame>"
            "<link name='n::a'><pose>1 2 0 0 0 0</pose></link><link name='b'/>"
        ),
        "/sdf/model/model/pose/text() | /sdf/model/model/link/pose/text()",
        ["0 2 0 0 0 0", "1 0 0 0 0 0"],
    ),
    (
        "1.7",
        model(
            "<frame name='n::__model__' attached_to='n::a'><pose relative_to='b'>0 2 0 0 0 0</pose></frame>"
            "<link name='n::a'><pose relative_to='n::__model__'/></link><link name='b'/>"
        ),
        "/sdf/model/model/pose/@relative_to | /sdf/model/model/pose/text()",
        ["b", "0 2 0 0 0 0"],
    ),
    (
        "1.7",
        model(LINKS.replace("<link name='a'/>", "<link name='a'><inertial><pose relative_to='b'>1 0 0 0 0 0</pose>")
        .replace("</pose><link", "</pose></inertial></link><link")),
        "//inertial/pose/text()",
        ["2 0 0 0 0 0"],
    ),
    # 1.10: a screw's pitch
    ("1.9", arm("screw"), "//thread_pitch/text()", ["1"]),
    ("1.9", arm("screw", "<thread_pitch>3</thread_pitch>"), "//thread_pitch/text()", ["3"]),
    # 1.12: states
    (
        "1.11",
        world("<state world_name='w'><model name='m'><link name='a'/><joint name='j'><angle axis='0'>1</angle>"
              "<angle axis='1'>2</angle></joint></model></state>"),
        "//model_state/@name | //link_state/@name | //joint_state/angle/text() | //axis2_state/position/text()",
        ["m", "a", "1", "2"],
    ),
    # what is gone is carried
    ("1.6", arm("revolute", "<axis><initial_position>1</initial_position></axis>"), "//tf:version/@until", ["1.8"]),
    ("1.6", model("<link name='a'><frame name='f'/></link>"), "//link/tf:version/frame/@name", ["f"]),
]  # fmt: skip


@pytest.mark.parametrize(("version", "inside", "path", "expected"), UP)
def test_an_older_file_is_written_in_the_newest_syntax(version: str, inside: str, path: str, expected: list[str]):
    made = rewrite(sdf(version, inside), "1.12").text
    assert sorted(values_at(made, path)) == sorted(expected)
    assert twinform.check(made.encode()).accepted


FRAMED = model(
    "<frame name='f'><pose>0 1 0 0 0 0</pose></frame><link name='a'><pose relative_to='f'>1 0 0 0 0 0</pose>"
    f"<visual name='v'><pose relative_to='__model__'>0 0 0 0 0 0</pose>{BOX}</visual></link>"
)
HELD = (
    "<model name='m'><link name='a'/><frame name='f' attached_to='a'><pose>1 0 0 0 0 0</pose></frame></model>"
    "<model name='n'><link name='c'/></model><frame name='h' attached_to='m::f'/>"
    + joint("fixed", parent="world", child="m::f")
    + joint("fixed", name="k", parent="h", child="n")
)
QUARTER = "0 0 1.5707963267948966"
OLDER: list[tuple[str, str, str, list[str]]] = [
    # 1.11 and before
    ("1.10", arm("revolute", "<axis><xyz>1 0 0</xyz><mimic joint='k'/></axis>").replace(
        "</model>", joint("revolute", "<axis/>", name="k") + "</model>"), "//axis/mimic", []),
    ("1.10", model(f"<link name='a'><inertial auto='true'><density>2</density></inertial>"
                   f"<collision name='c'><pose>0 0 1 0 0 0</pose>{BOX}</collision></link>"),
     "//mass/text() | //inertial/pose/text() | //inertial/@auto", ["2", "0 0 1 0 0 0"]),
    ("1.10", model("<link name='a'><inertial auto='true'/></link>"), "//mass | //inertial/@auto", []),
    ("1.9", arm("revolute", "<axis><limit><lower>-inf</lower><upper>inf</upper><effort>inf</effort></limit></axis>"),
     "//limit[not(ancestor::tf:version)]/*/text()", ["-1e+16", "1e+16", "-1"]),
    ("1.9", arm("screw", "<screw_thread_pitch>2</screw_thread_pitch>"), "//joint/thread_pitch/text()",
     ["-3.141592653589793"]),
    ("1.9", arm("screw"), "//joint/thread_pitch/text()", ["-6.283185307179586"]),
    ("1.9", model("<link name='a'/><plugin filename='libwheels.so'/>"), "//plugin/@name", ["wheels"]),
    ("1.8", model("<link name='a'><pose degrees='true'>0 0 0 0 0 90</pose></link>"), "/sdf/model/link/pose/text()",
     [f"0 0 0 {QUARTER}"]),
    ("1.8", world("<actor name='a'><pose degrees='true'>1 2 3 0 0 90</pose></actor>"),
     "//actor/pose/text() | //actor/pose/@*", [f"1 2 3 {QUARTER}"]),
    ("1.8", world("<frame name='f'/><actor name='a'><pose degrees='true' relative_to='f'>1 2 3 0 0 90</pose></actor>"),
     "//actor/pose/text() | //actor/pose/@*", [f"1 2 3 {QUARTER}", "f"]),
    # 1.7: shapes, ends of joints, placement
    ("1.7", model("<link name='a'><visual name='v'><geometry><capsule/></geometry></visual></link>"),
     "//link/visual/@name", ["v", "v_end", "v_end_1"]),
    ("1.7", model(LINKS + "<frame name='f' attached_to='a'/>" + joint("fixed", parent="f")), "//joint/parent/text()",
     ["a"]),
    ("1.7", world(HELD), "//joint/parent/text() | //joint/child/text()", ["world", "m::a", "m::a", "n::c"]),
    ("1.7", world("<model name='m' placement_frame='f'><pose>5 0 0 0 0 0</pose><link name='a'/>"
                  "<frame name='f'><pose>1 0 0 0 0 0</pose></frame></model>"), "//world/model/pose/text()",
     ["4 0 0 0 0 0"]),
    # 1.6: frames
    ("1.6", FRAMED, "/sdf/model/frame", []),
    ("1.6", FRAMED, "/sdf/model/link/pose/text() | /sdf/model/link/visual/pose/text()",
     ["1 1 0 0 0 0", "-1 -1 0 0 0 0"]),
    ("1.6", arm("revolute", "<axis><xyz expressed_in='__model__'>1 0 0</xyz></axis>"),
     "//axis/use_parent_model_frame/text()", ["true"]),
    ("1.6", arm("revolute", f"<pose>0 0 0 {QUARTER}</pose><axis><xyz expressed_in='a'>0 1 0</xyz></axis>"),
     "//joint/axis/xyz/text()", ["1 6.123233995736766e-17 0"]),
    # 1.5 and before
    ("1.5", arm("continuous", "<axis><limit><lower>-1</lower><upper>1</upper></limit></axis>"),
     "//joint/@type | //joint/axis/limit/*", ["revolute"]),
    ("1.5", world("<gravity>0 0 -1</gravity>"), "//physics/gravity/text()", ["0 0 -1"]),
    ("1.4", arm("fixed"), "//joint/@type | //joint/axis/limit/*/text()", ["revolute", "0", "0"]),
    ("1.4", arm("revolute", f"<pose>0 0 0 {QUARTER}</pose><axis><xyz>0 0 1</xyz></axis>"), "//joint/axis/xyz/text()",
     ["0 0 1"]),
    ("1.4", model("<link name='b'/><model name='n'><pose>1 0 0 0 0 0</pose><link name='a'/></model>"),
     "/sdf/model/link/@name | /sdf/model/link/pose/text()", ["b", "n::a", "1 0 0 0 0 0"]),
    ("1.11", world("<state world_name='w'><model_state name='m'><joint_state name='j'><axis2_state><position>2"
                   "</position></axis2_state></joint_state></model_state></state>"),
     "//state/model/joint/angle[@axis='1']/text()", ["2"]),
]  # fmt: skip


@pytest.mark.parametrize(("version", "inside", "path", "expected"), OLDER)
def test_a_file_of_the_newest_version_is_written_in_older_syntax(
    version: str, inside: str, path: str, expected: list[str]
):
    made = rewrite(sdf("1.12", inside), version).text
    assert sorted(values_at(made, path)) == sorted(expected)
    found = twinform.check(made.encode())
    assert [
        each.message for each in found.diagnostics if each.rule.name in ("outside-version", "unknown-element")
    ] == []


@pytest.mark.parametrize(("version", "inside"), [row[:2] for row in OLDER])
def test_what_an_older_version_cannot_express_comes_back(version: str, inside: str):
    source = sdf("1.12", inside)
    older = rewrite(source, version)
    again = rewrite(older.text, "1.12")
    difference = first_difference(comparable(twinform.loads(source)), comparable(again.document))
    made_up = [entry.message for entry in older.ledger.entries if entry.fate is Fate.APPROXIMATED]
    assert difference is None or made_up
    assert older.ledger.entries or older.document.version == version


def test_noise_of_three_axes_that_only_an_older_version_could_gather_comes_back():
    numbers = "<mean>0</mean><stddev>1</stddev><dynamic_bias_stddev>2</dynamic_bias_stddev>"
    axes = "".join(f"<{axis}><noise type='gaussian'>{numbers}</noise></{axis}>" for axis in "xyz")
    measured = (f"<{name}>{axes}</{name}>" for name in ("angular_velocity", "linear_acceleration"))
    source = sdf("1.12", imu("".join(measured)))
    again = rewrite(rewrite(source, "1.5").text, "1.12")
    assert [each.rule.name for each in again.diagnostics if each.rule.name == "stale-carrier"] == []
    assert first_difference(comparable(twinform.loads(source)), comparable(twinform.loads(again.text))) is None


@pytest.mark.parametrize(("version", "inside"), [row[:2] for row in OLDER])
def test_without_carriers_the_ledger_has_what_is_dropped(version: str, inside: str):
    made = rewrite(sdf("1.12", inside), version, carriers=False)
    assert NAMESPACE not in made.text
    assert {entry.fate for entry in made.ledger.entries} <= {Fate.DROPPED, Fate.APPROXIMATED}


def test_a_carrier_is_not_trusted_where_the_file_was_edited():
    older = rewrite(sdf("1.12", FRAMED), "1.6").text.replace("<pose>1 1 0 0 0 0</pose>", "<pose>7 1 0 0 0 0</pose>")
    made = rewrite(older, "1.12")
    assert [each.rule.name for each in made.diagnostics] == ["stale-carrier"]
    assert values_at(made.text, "/sdf/model/link/pose/text()") == ["7 1 0 0 0 0"]


def test_an_edit_elsewhere_does_not_cost_the_frames():
    older = rewrite(sdf("1.12", FRAMED), "1.6").text.replace("<size>1 1 1</size>", "<size>2 2 2</size>")
    made = rewrite(older, "1.12").text
    assert values_at(made, "/sdf/model/frame/@name | //size/text() | /sdf/model/link/pose/@relative_to") == [
        "f", "f", "2 2 2",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "carrier",
    [
        "<tf:version since='1.7' index='0'><frame/></tf:version>",
        "<tf:version since='1.7'><pose>one</pose></tf:version>",
    ],
)
def test_a_carrier_with_nonsense_is_reported_and_kept(carrier: str):
    text = f"<sdf version='1.6' xmlns:tf='{NAMESPACE}'><model name='m'><link name='a'/>{carrier}</model></sdf>"
    made = rewrite(text, "1.12")
    assert [each.rule.name for each in made.diagnostics] == ["stale-carrier"]
    assert len(values_at(made.text, "//tf:version")) == 1


@pytest.mark.parametrize(
    ("source", "version", "kind"), [("1.4", "1.5", "piston"), ("1.12", "1.4", "screw"), ("1.12", "1.3", "gearbox")]
)
def test_a_joint_that_the_version_cannot_express_is_an_error(source: str, version: str, kind: str):
    with pytest.raises(twinform.CompileError) as caught:
        rewrite(sdf(source, arm(kind)), version)
    assert "joint-type-unsupported" in {each.rule.name for each in caught.value.diagnostics}


def test_sdf_1_2_is_read_by_its_own_root():
    made = rewrite("<gazebo version='1.2'><model name='m'><link name='a'/></model></gazebo>", "1.12")
    assert made.document.models[0].links[0].name == "a"
    assert "old-root" in {each.rule.name for each in made.diagnostics}


def test_a_mimic_survives_the_way_over_an_older_sdf_and_urdf():
    urdf = (
        "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
        "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>"
        "<joint name='k' type='continuous'><parent link='a'/><child link='c'/><mimic joint='j'/></joint></robot>"
    )
    older = twinform.convert(urdf.encode(), to="sdf", sdf_version="1.6").text
    back = twinform.convert(older.encode(), to="urdf").document
    assert [joint.axis.mimic.joint for joint in back.models[0].joints if joint.axis and joint.axis.mimic] == ["j"]
