"""What the verifier reports where it finds several things, or has to keep quiet."""

from twinform.compiler import check
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Pose
from twinform.ir.verify import verify


def _findings(text: str, kind: str = "sdf") -> list[tuple[str, int]]:
    found = check(text.encode(), name=f"r.{kind}").diagnostics
    return [(each.rule.name, each.location.line) for each in found]


def test_the_roots_of_a_robot_are_named_up_to_the_fifth() -> None:
    links = "".join(f'\n<link name="l{number}"/>' for number in range(7))
    (found,) = check(f'<robot name="r">{links}</robot>'.encode(), name="r.urdf").diagnostics
    assert found.message == "robot 'r' has 7 root links: 'l0', 'l1', 'l2', 'l3', 'l4', ..."
    assert found.location.line == 3
    assert [each.line for each in found.related] == [4, 5, 6]


_CIRCLE = """
<frame name="f" attached_to="g"/>
<frame name="g" attached_to="f"/>"""
_ON_ONE_LINK = """<link name="a"/><frame name="on" attached_to="a"/>
<joint name="j" type="fixed"><parent>a</parent><child>on</child></joint>"""


def test_a_circle_of_frames_is_found_in_a_model_after_one_with_an_error() -> None:
    wrong = '<model name="one"><link name="x"/><link name="x"/></model>'
    circle = f'<model name="two"><link name="y"/>{_CIRCLE}</model>'
    world = f'<sdf version="1.9"><world name="w">\n{wrong}{circle}</world></sdf>'
    assert _findings(world) == [("duplicate-name", 2), ("frame-cycle", 3)]


def test_ends_of_joints_are_looked_at_once_the_frames_lead_somewhere() -> None:
    assert _findings(f'<sdf version="1.9"><model name="m">{_ON_ONE_LINK}</model></sdf>') == [("self-joint", 2)]
    assert _findings(f'<sdf version="1.9"><model name="m">{_ON_ONE_LINK}{_CIRCLE}</model></sdf>') == [
        ("frame-cycle", 3)
    ]


def test_a_pose_that_a_pass_made_is_where_its_link_is() -> None:
    document = check(b'<sdf version="1.9"><model name="m">\n<link name="a"/></model></sdf>').document
    assert document is not None
    (link,) = document.models[0].links
    link = link.copy(pose=Pose(relative_to="nowhere"))
    model = document.models[0].copy(links=(link,))
    sink = DiagnosticSink()
    verify(document.copy(models=(model,)), sink)
    (found,) = sink.diagnostics
    assert found.location.line == 2
    assert found.location.path == "/sdf/model[@name='m']/link[@name='a']/pose/@relative_to"
