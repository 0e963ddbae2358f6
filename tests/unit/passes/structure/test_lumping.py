"""What lumping leaves alone, and what it cannot follow."""

from pathlib import Path

import pytest

import twinform
from tests.unit.passes.reported import entries, findings
from twinform.ir import Axis, Dynamics, Format, Limit
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import Solid
from twinform.passes.shared.link_shapes import body_of

SDF = "/sdf/model[@name='r']"
URDF = "/robot[@name='r']"


def sdf(links: str, *joints: tuple[str, str, str, str]) -> bytes:
    """A model with one joint a line, from the second on."""
    lines = ["<sdf version='1.9'><model name='r'>" + "".join(f"<link name='{name}'/>" for name in links.split())]
    for name, kind, parent, child in joints:
        axis = "" if kind == "fixed" else "<axis><xyz>0 0 1</xyz></axis>"
        ends = f"<parent>{parent}</parent><child>{child}</child>"
        lines.append(f"<joint name='{name}' type='{kind}'>{ends}{axis}</joint>")
    return "\n".join([*lines, "</model></sdf>"]).encode()


def lumped(text: bytes, options: str = "") -> twinform.Conversion:
    return twinform.convert(
        text, to="sdf" if b"<sdf" in text else "urdf", sdf_version="1.9", passes=f"lump-fixed-joints{options}"
    )


def links(made: twinform.Conversion) -> list[str]:
    return [link.name for link in made.document.models[0].links]


def not_lumped(made: twinform.Conversion) -> list[tuple[str, int, str, str, str | None]]:
    return [each for each in findings(made) if each[0] == "link-not-lumped"]


def finding(line: int, joint: str, child: str, parent: str, why: str) -> tuple[str, int, str, str, str | None]:
    message = f"link {child!r} is not lumped into {parent!r}: {why}"
    return ("link-not-lumped", line, f"{SDF}/joint[@name='{joint}']", message, child)


LOOP = "joint 'loop' would connect one link with itself"


@pytest.mark.parametrize(
    ("loop", "expected"),
    [
        (("revolute", "d", "a"), [(4, "c_d", "d", "c"), (3, "b_c", "c", "b"), (2, "a_b", "b", "a")]),
        (("gearbox", "a", "d"), [(4, "c_d", "d", "c"), (3, "b_c", "c", "b"), (2, "a_b", "b", "a")]),
        (("gearbox", "c", "b"), [(2, "a_b", "b", "a"), (3, "b_c", "c", "b")]),
    ],
)
def test_a_whole_chain_stays_that_a_joint_closes(
    loop: tuple[str, str, str], expected: list[tuple[int, str, str, str]]
) -> None:
    chain = [("a_b", "fixed", "a", "b"), ("b_c", "fixed", "b", "c"), ("c_d", "fixed", "c", "d")]
    made = lumped(sdf("a b c d", *chain, ("loop", *loop)))
    assert not_lumped(made) == [finding(*each, LOOP) for each in expected]
    assert links(made) == ["a", *sorted(each[2] for each in expected)]


def test_both_branches_stay_that_a_joint_connects_and_no_other() -> None:
    tree = [
        ("a_b", "fixed", "a", "b"),
        ("b_c", "fixed", "b", "c"),
        ("a_d", "fixed", "a", "d"),
        ("a_e", "fixed", "a", "e"),
    ]
    made = lumped(sdf("a b c d e", *tree, ("loop", "gearbox", "c", "d")))
    assert not_lumped(made) == [
        finding(4, "a_d", "d", "a", LOOP),
        finding(3, "b_c", "c", "b", LOOP),
        finding(2, "a_b", "b", "a", LOOP),
    ]
    assert links(made) == ["a", "b", "c", "d"]


def test_a_link_stays_in_a_circle_below_one_or_under_two_joints() -> None:
    circle = lumped(sdf("a b c", ("a_b", "fixed", "a", "b"), ("b_a", "fixed", "b", "a"), ("b_c", "fixed", "b", "c")))
    why = "fixed joints go round in a circle there"
    assert not_lumped(circle) == [
        finding(2, "a_b", "b", "a", why),
        finding(3, "b_a", "a", "b", why),
        finding(4, "b_c", "c", "b", why),
    ]
    assert links(circle) == ["a", "b", "c"]
    twice = lumped(
        sdf("a b c", ("a_c", "fixed", "a", "c"), ("a_b", "revolute", "a", "b"), ("b_c", "revolute", "b", "c"))
    )
    assert not_lumped(twice) == [finding(2, "a_c", "c", "a", "it is the child of several joints")]
    assert links(twice) == ["a", "b", "c"]


@pytest.mark.parametrize(("keep", "left"), [("[c]", ["a", "c"]), ("[a_*]", ["a", "b"]), ("[x]", ["a"])])
def test_a_link_stays_that_is_kept_by_its_name_or_its_joints(keep: str, left: list[str]) -> None:
    made = lumped(sdf("a b c", ("a_b", "fixed", "a", "b"), ("b_c", "fixed", "b", "c")), f"{{keep={keep}}}")
    assert links(made) == left
    assert not_lumped(made) == []


def test_a_joint_between_frames_is_one_between_their_links() -> None:
    frames = "<frame name='f' attached_to='b'/><frame name='g' attached_to='c'/>"
    text = sdf("a b c", ("a_b", "revolute", "a", "b"), ("f_g", "fixed", "f", "g"))
    shape = b"<visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual>"
    text = text.replace(b"<link name='c'/>", b"<link name='c'>" + shape + b"</link>")
    made = lumped(text.replace(b"</model>", f"{frames}</model>".encode()))
    assert [(link.name, len(link.visuals)) for link in made.document.models[0].links] == [("a", 0), ("b", 1)]
    assert not_lumped(made) == []
    inner = sdf("a", ("hold", "fixed", "n::x", "a")).replace(
        b"</model>", b"<model name='n'><link name='x'/></model></model>"
    )
    why = "'n::x', which it is fixed to, is in another model"
    assert not_lumped(lumped(inner)) == [finding(2, "hold", "a", "n::x", why)]


NAMED = b"""<robot name="r"><link name="base"/>
<link name="box"/>
<link name="lid"/>
<joint name="hold" type="fixed"><parent link="base"/><child link="box"/></joint>
<joint name="hinge" type="fixed"><parent link="box"/><child link="lid"/></joint>
<gazebo><plugin name="p" filename="libp.so"><jointName>hold</jointName></plugin></gazebo>
<gazebo reference="base"><sensor name="s" type="contact">
<plugin name="q" filename="libq.so"><linkName>lid</linkName></plugin></sensor></gazebo>
</robot>"""


def test_names_that_libsdformat_leaves_dangling_are_reported_where_they_were_defined() -> None:
    made = lumped(NAMED, "{compat=libsdformat}")
    assert findings(made) == [
        (
            "lumped-away",
            3,
            f"{URDF}/link[@name='lid']",
            "plugin 'q' names link 'lid', which is a part of 'base' now",
            "lid",
        ),
        ("lumped-away", 4, f"{URDF}/joint[@name='hold']", "plugin 'p' names joint 'hold', which was removed", "hold"),
    ]
    assert links(made) == ["base"]


LOST = b"""<robot name="r"><link name="base"/>
<link name="box"><mine/></link>
<joint name="hold" type="fixed"><parent link="base"/><child link="box"/></joint>
<gazebo reference="hold"><sensor name="s" type="force_torque"/><implicitSpringDamper>1</implicitSpringDamper></gazebo>
</robot>"""


def test_what_goes_with_a_link_or_a_joint_is_reported_and_counted() -> None:
    made = lumped(LOST, "{compat=libsdformat}")
    link, block = f"{URDF}/link[@name='box']", f"{URDF}/gazebo[1]"
    gone = "<mine> of link 'box' is lost when the link is lumped"
    words = "<sensor>, <implicitSpringDamper> of joint 'hold' is lost with the joint"
    assert [each for each in findings(made) if each[0] == "lumped-away"] == [
        ("lumped-away", 2, link, gone, None),
        ("lumped-away", 4, block, words, None),
    ]
    assert entries(made) == [("lumped-away", 2, link, gone, 1), ("lumped-away", 4, block, words, 6)]


WEIGHTS = """<mass value="2"/><inertia ixx="1" ixy="0.1" ixz="0.2" iyy="2" iyz="0.3" izz="2.5"/>"""


@pytest.mark.parametrize(
    ("origin", "center"),
    [("", (0, 0, 0)), ('<origin xyz="1 2 3"/>', (1, 2, 3))],
)
def test_a_body_is_what_its_link_has(origin: str, center: tuple[float, float, float]) -> None:
    model = twinform.loads(
        f'<robot name="r"><link name="a"><inertial>{origin}{WEIGHTS}</inertial></link></robot>'
    ).models[0]
    body = body_of(model.links[0], FrameGraph(model), Format.URDF)
    assert body == Solid(2, center, (1, 2, 2.5, 0.1, 0.2, 0.3))


KEPT = """<robot name="r"><link name="a"/><link name="b"/>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
<gazebo reference="j"><disableFixedJointLumping>true</disableFixedJointLumping></gazebo></robot>"""


def test_a_fixed_joint_that_is_not_lumped_turns_by_nothing_as_libsdformat_has_it() -> None:
    made = lumped(KEPT.encode(), "{compat=libsdformat}").document.models[0].joints
    limit = Limit(lower=0, upper=0, effort=1e16, velocity=1e16)
    axis = Axis(xyz=(0, 0, 1), limit=limit, dynamics=Dynamics(damping=0, friction=0))
    before = twinform.loads(KEPT).models[0].joints[0]
    assert made == (before.copy(type="revolute", axis=axis),)


CORNER = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
"""A corner of a cube, a sixth of it."""


def test_an_inertia_is_computed_from_the_mesh_that_it_is_left_to(tmp_path: Path) -> None:
    (tmp_path / "corner.obj").write_text(CORNER)
    auto = '<inertial auto="true"><density>600</density></inertial>'
    shape = '<collision name="c"><geometry><mesh><uri>corner.obj</uri></mesh></geometry></collision>'
    joint = '<joint name="j" type="fixed"><parent>a</parent><child>b</child></joint>'
    heavy = '<link name="a"><inertial><mass>2</mass></inertial></link>'
    text = f'<sdf version="1.11"><model name="m">{heavy}<link name="b">{auto}{shape}</link>{joint}</model></sdf>'
    file = tmp_path / "m.sdf"
    file.write_text(text)
    made = twinform.convert(file, to="sdf", passes="lump-fixed-joints")
    (link,) = made.document.models[0].links
    assert link.inertial
    assert link.inertial.mass == pytest.approx(102)
    alone = twinform.convert(text.encode(), to="sdf", passes="lump-fixed-joints")
    assert len(alone.document.models[0].links) == 2
    assert "link-not-lumped" in [each.rule.name for each in alone.diagnostics]
