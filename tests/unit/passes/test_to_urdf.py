"""SDF models on their way to URDF: what is written, what is carried, and what is in the ledger."""

from pathlib import Path

import pytest
from lxml import etree

import twinform
from tests.oracles import urdfdom
from twinform.diagnostics import Fate, Notes
from twinform.ir import Document, Opaque
from twinform.passes import Pipeline
from twinform.passes.legalise.carrier import NAMESPACE, is_carrier, unpack
from twinform.passes.legalise.to_urdf import to_urdf
from twinform.schemas import Context, XmlElement, libxml2_errors, parse_version, reader, writer

LINK = "<link name='a'/>"
TF = {"tf": NAMESPACE}


def read(text: str, version: str = "1.11", around: str = "<model name='m'>{}</model>") -> Document:
    root = etree.fromstring(f"<sdf version='{version}'>{around.format(text)}</sdf>")
    notes = Notes()
    data = reader("sdf", parse_version(version)).read(root, Context(notes, "", "sdf", parse_version(version)))
    assert [str(each.message) for each in notes.diagnostics if each.is_error] == []
    return Document.model_validate({"format": "sdf", **data})


def lower(document: Document, *, model: str | None = None, carriers: bool = True) -> tuple[XmlElement, Notes]:
    notes = Notes()
    made = Pipeline(to_urdf(model=model, carriers=carriers)).run(document, notes)
    if notes.has_errors:
        return etree.Element("none"), notes
    assert made.format == "urdf"
    version = parse_version(made.version or "1.0")
    root = etree.Element("robot", nsmap=dict(made.namespaces))
    writer("urdf", version).write(made.models[0], root)
    assert libxml2_errors(root, "urdf", version) == []
    return root, notes


def convert(text: str, version: str = "1.11") -> XmlElement:
    root, notes = lower(read(text, version))
    assert [each.message for each in notes.diagnostics if each.is_error] == []
    return root


def said(root: XmlElement, path: str) -> list[str]:
    found = root.xpath(path, namespaces=TF)
    assert isinstance(found, list)
    return [str(each) for each in found]  # pyright: ignore[reportUnknownArgumentType, reportUnknownVariableType] - texts


def joint(kind: str, inside: str = "", name: str = "j", parent: str = "a", child: str = "b") -> str:
    return f"<joint name='{name}' type='{kind}'><parent>{parent}</parent><child>{child}</child>{inside}</joint>"


def arm(kind: str, inside: str = "") -> str:
    return LINK + "<link name='b'/>" + joint(kind, inside)


def link(inside: str, name: str = "a") -> str:
    return f"<link name='{name}'>{inside}</link>"


def visual(inside: str, name: str = "v") -> str:
    return f"<visual name='{name}'>{inside}</visual>"


BOX = "<geometry><box><size>1 2 3</size></box></geometry>"
COLLISION = f"<collision name='{{}}'>{BOX}{{}}</collision>"


@pytest.mark.parametrize(
    ("text", "path", "expected"),
    [
        # inertials: SDF's defaults are written
        (LINK, "//mass/@value | //inertia/@*", ["1", "1", "0", "0", "1", "0", "1"]),
        (LINK, "//inertial/@tf:made", ["."]),
        (
            link("<inertial><mass>2</mass><inertia><ixx>3</ixx></inertia></inertial>"),
            "//mass/@value | //inertia/@*",
            ["2", "3", "0", "0", "1", "0", "1"],
        ),
        # joints
        (
            arm("revolute", "<axis><limit><lower>0</lower><upper>1</upper></limit></axis>"),
            "//joint/@type",
            ["revolute"],
        ),
        (arm("revolute", "<axis><limit><lower>0</lower><upper>1</upper></limit></axis>"), "//limit/@effort", ["1e+16"]),
        (arm("revolute", "<axis><limit><upper>1</upper></limit></axis>"), "//limit/@lower", ["-1e+16"]),
        (arm("revolute", "<axis><limit><stiffness>350</stiffness></limit></axis>"), "//joint/limit", []),
        (arm("revolute"), "//joint/@type", ["continuous"]),
        (arm("revolute"), "//joint/axis/@xyz", ["0 0 1"]),
        (arm("revolute"), "//limit", []),
        (
            arm("revolute", "<axis><limit><lower>-1e16</lower><upper>inf</upper></limit></axis>"),
            "//joint/@type",
            ["continuous"],
        ),
        (arm("revolute", "<axis><limit><effort>3</effort></limit></axis>"), "//limit/@*", ["3", "1e+16"]),
        (arm("prismatic"), "//limit/@*", ["-1e+16", "1e+16", "1e+16", "1e+16"]),
        (arm("fixed", "<axis><xyz>1 0 0</xyz></axis>"), "//joint/axis", []),
        (
            arm(
                "revolute",
                "<axis><mimic joint='j'><multiplier>2</multiplier><offset>1</offset><reference>3</reference>"
                "</mimic></axis>",
            ),
            "//mimic/@*",
            ["j", "2", "-5"],
        ),
        # axes in other frames; z of the model is x of a joint that is turned by 90 degrees about y
        (
            LINK
            + "<link name='b'><pose degrees='true'>0 0 0 0 90 0</pose></link>"
            + joint("revolute", "<axis><xyz expressed_in='a'>0 0 -2</xyz></axis>"),
            "//joint/axis/@xyz",
            ["2 0 -1.2246467991473532e-16"],
        ),
        # poses
        (link("<pose>1 2 3 0 0 0</pose>"), "//gazebo/pose/text()", ["1 2 3 0 0 0"]),
        (
            LINK + link("<pose>0.1 0.2 0.3 0 0 0.4</pose>", "b") + joint("fixed"),
            "//joint/origin/@*",
            ["0.1 0.2 0.3", "0 0 0.4"],
        ),
        (
            LINK
            + link("<pose>1 0 0 0 0 0</pose>" + visual("<pose>0 0 5 0 0 0</pose>" + BOX), "b")
            + joint("fixed", "<pose>0 0 1 0 0 0</pose>"),
            "//joint/origin/@xyz | //visual/origin/@xyz",
            ["0 0 4", "1 0 1"],
        ),
        (link(visual("<pose degrees='true'>0 0 0 180 0 0</pose>" + BOX)), "//origin/@rpy", ["3.141592653589793 0 0"]),
        # frames
        (LINK + "<frame name='f' attached_to='a'><pose>1 0 0 0 0 0</pose></frame>", "//joint/origin/@xyz", ["1 0 0"]),
        (LINK + "<frame name='f'/>", "//joint/@name | //link[@name='f']/*[not(self::tf:sdf)]", ["f_joint"]),
        (
            LINK + "<frame name='f'/><joint name='f_joint' type='fixed'><parent>world</parent><child>a</child></joint>",
            "//joint/@name",
            ["f_joint", "f_joint_1"],
        ),
        # worlds and roots
        (LINK + joint("fixed", parent="world", child="a"), "//link/@name", ["world", "a"]),
        (
            LINK + "<link name='b'/>",
            "//joint/@type | //joint/parent/@link | //joint/child/@link",
            ["floating", "a", "b"],
        ),
        (
            "<static>1</static><link name='a'><pose>1 0 0 0 0 0</pose></link>",
            "//joint/@type | //parent/@link | //joint/origin/@xyz",
            ["fixed", "world", "1 0 0"],
        ),
        # geometry
        (
            link(
                visual("<geometry><cylinder/></geometry>")
                + visual("<geometry><sphere><radius>2</radius></sphere></geometry>", "w")
            ),
            "//sphere/@radius",
            ["2"],
        ),
        (link(visual("<geometry><box><size>1 2 3</size></box></geometry>")), "//box/@size", ["1 2 3"]),
        (
            link(visual("<geometry><mesh><uri>model://m/a.dae</uri></mesh></geometry>")),
            "//mesh/@filename",
            ["package://m/a.dae"],
        ),
        (link(visual("<geometry><plane/></geometry>")), "//visual[not(ancestor::tf:sdf)]/@name", []),
        (
            link(visual("<geometry><plane><normal>0 0 1</normal></plane></geometry>")),
            "/robot/link/tf:sdf/visual/geometry/plane/normal/text()",
            ["0 0 1"],
        ),
        (
            link(visual("<geometry><mesh><uri>x</uri><submesh><name>s</name></submesh></mesh></geometry>")),
            "//tf:sdf//submesh/name/text()",
            ["s"],
        ),
        # materials
        (
            link(visual(BOX + "<material><diffuse>1 0 0 1</diffuse><ambient>1 0 0 1</ambient></material>")),
            "//color/@rgba",
            ["1 0 0 1"],
        ),
        (
            link(visual(BOX + "<material><diffuse>1 0 0 1</diffuse><ambient>1 0 0 1</ambient></material>")),
            "//visual/tf:sdf",
            [],
        ),
        (
            link(visual(BOX + "<material><diffuse>1 0 0</diffuse></material>")),
            "//color/@rgba | //tf:sdf/diffuse/text()",
            ["1 0 0 1", "1 0 0"],
        ),
        (
            link(visual(BOX + "<material><specular>1 0 0 1</specular></material>")),
            "//visual/tf:sdf//specular/text()",
            ["1 0 0 1"],
        ),
        (link(visual(BOX + "<material><diffuse>1 0 0 1</diffuse></material>")), "//material/@name", ["a_v_material"]),
        (
            link(visual(BOX + "<material><pbr><metal><albedo_map>model://t.png</albedo_map></metal></pbr></material>")),
            "//texture/@filename",
            ["package://t.png"],
        ),
        (
            link(visual(BOX + "<material><script><uri>u</uri><name>Gazebo/Red</name></script></material>")),
            "//gazebo/material/text()",
            ["Gazebo/Red"],
        ),
        # surfaces
        (
            link(COLLISION.format("c", "<surface><friction><ode><mu>2</mu></ode></friction></surface>")),
            "//gazebo[@reference='a']/mu1/text()",
            ["2"],
        ),
        (
            link(COLLISION.format("c", "<surface><friction><ode><slip1>2</slip1></ode></friction></surface>")),
            "//gazebo/collision/surface//slip1/text()",
            ["2"],
        ),
        (
            link(COLLISION.format("c", "<max_contacts>3</max_contacts>") + COLLISION.format("d", "")),
            "//gazebo | //collision[@name='c']/tf:sdf/max_contacts/text()",
            ["3"],
        ),
        # what Gazebo reads
        (link("<gravity>false</gravity>"), "//gazebo[@reference='a']/gravity/text()", ["false"]),
        (
            link("<velocity_decay><linear>1</linear></velocity_decay>"),
            "//gazebo[@reference='a']/velocity_decay/linear/text()",
            ["1"],
        ),
        (
            LINK + "<plugin name='p' filename='f'><x>1</x></plugin>",
            "/robot/gazebo[not(@reference)]/plugin/x/text()",
            ["1"],
        ),
        ("<self_collide>true</self_collide>" + LINK, "/robot/gazebo/self_collide/text()", ["true"]),
        (
            arm("revolute", "<physics><ode><limit><cfm>1</cfm></limit><bounce>2</bounce></ode></physics>"),
            "//gazebo/stopCfm/text() | //joint/tf:sdf//bounce/text()",
            ["2", "1"],
        ),
        (
            arm("revolute", "<axis><dynamics><spring_stiffness>4</spring_stiffness></dynamics></axis>"),
            "//gazebo[@reference='j']/springStiffness/text()",
            ["4"],
        ),
        (arm("revolute", "<sensor name='s' type='force_torque'/>"), "//gazebo[@reference='j']/sensor/@name", ["s"]),
        (
            LINK
            + link(
                "<pose>1 0 0 0 0 0</pose><sensor name='s' type='imu'><pose relative_to='a'>0 0 1 0 0 0</pose></sensor>",
                "b",
            )
            + joint("fixed"),
            "//sensor/pose[not(ancestor::tf:sdf)]/text() | //sensor/tf:sdf/pose/@relative_to",
            ["-1 0 1 0 0 0", "a"],
        ),
        (
            LINK
            + link(
                "<pose>1 0 0 0 0 0</pose><sensor name='s' type='camera'>"
                "<camera><pose relative_to='a'>0 0 1 0 0 0</pose></camera></sensor>",
                "b",
            )
            + joint("fixed"),
            "//sensor/camera/pose/text() | //sensor/camera/tf:sdf/pose/text()",
            ["-1 0 1 0 0 0", "0 0 1 0 0 0"],
        ),
        (
            LINK
            + link("<projector name='p'><texture>t</texture></projector>", "b")
            + joint("fixed", "<pose>0 0 1 0 0 0</pose>"),
            "//projector/pose/text()",
            ["0 0 -1 0 0 0"],
        ),
        # carriers
        (
            arm("revolute", "<axis><limit><dissipation>3</dissipation></limit></axis>"),
            "//joint/tf:sdf[@at='axis/limit' or not(@at)]//dissipation/text()",
            ["3"],
        ),
        (link(visual(BOX + "<transparency>0.5</transparency>")), "//visual/tf:sdf/transparency/text()", ["0.5"]),
        (link("<pose>1 2 3 0 0 0</pose>"), "//link/tf:sdf/pose/text()", ["1 2 3 0 0 0"]),
        (LINK, "/robot/tf:sdf[@at='/sdf']/@value", ["1.11"]),
    ],
)
def test_a_part_of_sdf_is_said_in_urdf(text: str, path: str, expected: list[str]) -> None:
    assert said(convert(text), path) == expected


@pytest.mark.parametrize(
    ("version", "axis", "expected"),
    [
        ("1.4", "", "-1 0 0"),
        ("1.5", "", "0 0 1"),
        ("1.6", "<use_parent_model_frame>true</use_parent_model_frame>", "-1 0 0"),
        ("1.6", "<use_parent_model_frame>false</use_parent_model_frame>", "0 0 1"),
    ],
)
def test_an_axis_means_what_its_version_says(version: str, axis: str, expected: str) -> None:
    turned = "<link name='b'><pose>0 0 0 0 1.5707963267948966 0</pose></link>"
    root = convert(LINK + turned + joint("revolute", f"<axis><xyz>0 0 1</xyz>{axis}</axis>"), version)
    numbers = [round(float(number), 12) + 0.0 for number in said(root, "//joint/axis/@xyz")[0].split()]
    assert numbers == [float(number) + 0.0 for number in expected.split()]


def test_the_frame_of_an_older_pose_is_honoured_and_carried_as_it_was() -> None:
    text = link("<pose>1 0 0 0 0 0</pose>") + link("<pose frame='a'>1 0 0 0 0 0</pose>", "b") + joint("fixed")
    root = convert(text, "1.6")
    assert said(root, "//joint/origin/@xyz | //link[@name='b']/tf:sdf/pose/@*") == ["a", "1 0 0"]


INNER = """<model name='inner'><pose>0 0 1 0 0 0</pose><static>false</static><link name='l'/><link name='k'/>
  <frame name='f' attached_to='k'><pose>0 0 1 0 0 0</pose></frame>
  <joint name='j' type='revolute'><parent>l</parent><child>k</child>
  <axis><xyz expressed_in='__model__'>0 1 0</xyz></axis></joint>
  </model>"""


def test_nested_models_come_up_with_scoped_names() -> None:
    root = convert(LINK + INNER + "<joint name='o' type='fixed'><parent>a</parent><child>inner::l</child></joint>")
    assert said(root, "/robot/link/@name") == ["a", "inner::l", "inner::k", "inner", "inner::f"]
    assert said(root, "/robot/joint[@name='inner::j']/*/@link") == ["inner::l", "inner::k"]
    assert said(root, "/robot/joint[@name='o']/origin/@xyz") == ["0 0 1"]
    assert said(root, "/robot/joint[child/@link='inner::f']/parent/@link") == ["inner::k"]
    assert said(root, "//tf:sdf/model/static/text()") == ["false"]


def test_joints_between_frames_connect_their_links() -> None:
    frames = "<frame name='f' attached_to='a'/><frame name='g' attached_to='b'><pose>0 0 1 0 0 0</pose></frame>"
    text = LINK + "<link name='b'/>" + frames + joint("fixed", parent="f", child="g")
    root = convert(text)
    assert said(root, "/robot/joint[@name='j']/*/@link") == ["a", "b"]
    assert said(root, "/robot/joint[@name='j']/origin/@xyz") == ["0 0 1"]
    assert said(root, "/robot/joint[@name='j']/tf:sdf/*/text()") == ["f", "g"]


def test_a_link_that_is_posed_by_the_joint_that_is_cut_stays_where_it_is() -> None:
    text = (
        "<sdf version='1.11'><model name='m'><link name='a'/><link name='b'><pose relative_to='cut'/></link>"
        "<joint name='kept' type='revolute'><parent>a</parent><child>b</child></joint>"
        "<joint name='cut' type='fixed'><pose relative_to='a'>1 0 0 0 0 0</pose><parent>a</parent><child>b</child>"
        "</joint></model></sdf>"
    )
    joint = next(each for each in twinform.convert(text.encode(), to="urdf").document.models[0].joints)
    assert joint.name == "kept"
    assert joint.pose
    assert joint.pose.xyz == (1.0, 0.0, 0.0)


def test_a_loop_is_cut_and_closed_again_for_gazebo() -> None:
    closing = joint("revolute", "<pose relative_to='a'>0 0 1 0 0 0</pose><axis><xyz>1 0 0</xyz></axis>", "k", "a", "c")
    text = (
        LINK + "<link name='b'/><link name='c'/>" + joint("revolute") + joint("revolute", "", "i", "b", "c") + closing
    )
    root, notes = lower(read(text))
    assert said(root, "/robot/joint/@name") == ["j", "i"]
    assert said(root, "/robot/gazebo/joint/*[self::parent or self::child or self::pose]/text()") == [
        "0 0 1 0 0 0",
        "a",
        "c",
    ]
    assert [each.rule.name for each in notes.diagnostics] == ["cut-loop"]


WORLD = "<world name='w'><gravity>0 0 -1</gravity><model name='m'>{}</model><model name='n'>{}</model></world>"


def test_a_carried_shape_is_where_the_link_has_moved_to() -> None:
    shape = visual("<geometry><ellipsoid/></geometry>")
    text = LINK + link(shape, "b") + joint("fixed", "<pose>0 0 0.5 0 0 0</pose>")
    assert said(convert(text), "//tf:sdf/visual/pose/text()") == ["0 0 -0.5 0 0 0"]


def test_a_model_is_taken_out_of_a_world_by_name() -> None:
    document = read(LINK, around=WORLD.replace("{}", LINK))
    root, notes = lower(document, model="n")
    assert root.get("name") == "n"
    lost = [entry.message for entry in notes.entries if entry.rule.name == "outside-model"]
    assert len(lost) == 3
    assert all(entry.fate is Fate.DROPPED for entry in notes.entries if entry.rule.name == "outside-model")


@pytest.mark.parametrize(
    ("text", "around", "rule", "message"),
    [
        (LINK, WORLD.replace("{}", LINK), "model-not-chosen", "w::m, w::n"),
        (LINK, "<include><uri>model://x</uri></include>", "include-not-expanded", "model://x"),
        (
            LINK + "<include><uri>model://x</uri></include>",
            "<model name='m'>{}</model>",
            "include-not-expanded",
            "model://x",
        ),
        (
            arm("screw", "<thread_pitch>0</thread_pitch>"),
            "<model name='m'>{}</model>",
            "joint-type-unsupported",
            "screw",
        ),
        (link("<inertial auto='true'/>"), "<model name='m'>{}</model>", "automatic-inertia", "'a'"),
        (link("<pose relative_to='x'>0 0 0 0 0 0</pose>"), "<model name='m'>{}</model>", "dangling-frame", "'x'"),
        (arm("revolute", "<axis><xyz>0 0 0</xyz></axis>"), "<model name='m'>{}</model>", "zero-axis", "'j'"),
        (link("<inertial><mass>nan</mass></inertial>"), "<model name='m'>{}</model>", "unsayable-number", "nan"),
        (
            LINK + "<frame name='f' attached_to='a'/>" + joint("fixed", child="f"),
            "<model name='m'>{}</model>",
            "self-joint",
            "'a'",
        ),
    ],
)
def test_what_urdf_cannot_say_at_all_is_an_error(text: str, around: str, rule: str, message: str) -> None:
    _, notes = lower(read(text, around=around))
    found = [each for each in notes.diagnostics if each.is_error]
    assert [each.rule.name for each in found] == [rule]
    assert message in found[0].message
    assert found[0].location.path


EVERYTHING = (
    LINK
    + link(
        "<pose degrees='true'>1 0 0 90 0 0</pose><gravity>0</gravity>"
        + visual("<geometry><plane/></geometry>", "p")
        + visual(BOX + "<transparency>0.5</transparency><material><emissive>1 1 1 1</emissive></material>")
        + "<sensor name='s' type='imu'><pose relative_to='a'>0 0 0 0 0 0</pose></sensor>",
        "b",
    )
    + joint("revolute", "<axis><limit><dissipation>2</dissipation></limit></axis>")
    + "<frame name='f'/>"
    + INNER
)


def test_without_carriers_nothing_of_ours_is_left_and_the_ledger_says_dropped() -> None:
    root, notes = lower(read(EVERYTHING), carriers=False)
    assert NAMESPACE not in etree.tostring(root).decode()
    assert {entry.fate for entry in notes.entries} <= {Fate.DROPPED, Fate.APPROXIMATED}
    _, carried = lower(read(EVERYTHING))
    assert [entry.message for entry in carried.entries] == [entry.message for entry in notes.entries]
    assert {entry.fate for entry in carried.entries} <= {Fate.CARRIED, Fate.APPROXIMATED}


def test_carriers_unpack_to_the_pieces_as_they_were() -> None:
    document, notes = read(link(visual(BOX + "<transparency>0.5</transparency><foo:bar xmlns:foo='urn:f'/>"))), Notes()
    made = Pipeline(to_urdf()).run(document, notes).models[0].links[0].visuals[0]
    pieces = [piece for part in made.opaque if is_carrier(part, "sdf") for piece in unpack(part)]
    assert [piece.name for piece in pieces] == ["<transparency>"]
    assert [part.name for part in made.opaque if isinstance(part, Opaque) and not is_carrier(part, "sdf")] == [
        "<{urn:f}bar>"
    ]


def test_a_model_that_needs_nothing_but_urdf_has_no_carriers_but_the_version() -> None:
    root = convert(
        link(
            "<inertial><mass>1</mass><inertia><ixx>1</ixx><ixy>0</ixy><ixz>0</ixz>"
            "<iyy>1</iyy><iyz>0</iyz><izz>1</izz></inertia></inertial>"
        )
        + link("<pose relative_to='j'/>" + visual(BOX), "b")
        + joint(
            "revolute",
            "<pose relative_to='a'>0 0 1 0 0 0</pose><axis><xyz>1 0 0</xyz><limit><lower>0</lower>"
            "<upper>1</upper><effort>1</effort><velocity>1</velocity></limit></axis>",
        )
    )
    assert said(root, "//tf:sdf/@at") == ["/sdf"]
    assert said(root, "/robot/joint/@tf:made | /robot/link/@tf:made") == []


@pytest.mark.skipif(not urdfdom.available(), reason=urdfdom.MISSING)
@pytest.mark.parametrize("text", [LINK, EVERYTHING, arm("prismatic"), LINK + "<link name='b'/>"])
def test_urdfdom_reads_what_is_written(text: str, tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_bytes(etree.tostring(convert(text)))
    assert urdfdom.complaints(file) == ()


def test_a_capsule_is_carried_in_urdf_1_0_and_said_in_1_1() -> None:
    capsule = "<geometry><capsule><radius>1</radius></capsule></geometry>"
    document, notes = read(link(visual(capsule))), Notes()
    old = Pipeline(to_urdf()).run(document, notes)
    assert (old.version, old.models[0].links[0].visuals) == (None, ())
    new = Pipeline(to_urdf(urdf_version="1.1")).run(document, notes)
    assert new.version == "1.1"
    assert len(new.models[0].links[0].visuals) == 1


def test_the_pipeline_has_every_pass_once() -> None:
    names = [each.name for each in to_urdf()]
    assert len(set(names)) == len(names)


def values(root: XmlElement) -> set[str]:
    """Every word of every attribute and text."""
    texts = [text for each in root.iter() for text in (*map(str, each.attrib.values()), each.text or "")]
    return {word for text in texts for word in text.replace("::", " ").split()}


def test_no_value_vanishes() -> None:
    source = etree.fromstring(f"<sdf version='1.11'><model name='m'>{EVERYTHING}</model></sdf>")
    # without limits revolute is continuous, and the frame of a nested model is called as the model is
    assert values(source) - values(convert(EVERYTHING)) == {"revolute", "__model__"}
