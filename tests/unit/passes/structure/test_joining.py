"""One model attached to another: all that comes out, and what is reported where it cannot be."""

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes.structure.attach import Attach

ARM = """<robot name="arm"><material name="grey"><color rgba="1 1 1 1"/></material><link name="tool"/></robot>"""
HAND = """<robot name="hand">
<material name="grey"><color rgba="0 0 0 1"/></material>
<material name="red"><color rgba="1 0 0 1"/></material>
{}<link name="palm"><visual name="v"><geometry><sphere radius="1"/></geometry><material name="grey"/></visual>
<visual name="w"><geometry><sphere radius="1"/></geometry><material name="red"/></visual></link>
<link name="finger"/>
<joint name="slide" type="fixed"><parent link="palm"/><child link="finger"/><origin xyz="0 1 0"/></joint>
</robot>"""
HELD = """<link name="world"/>
<joint name="{}" type="{}"><parent link="world"/><child link="{}"/>{}</joint>"""
AXIS = '<axis xyz="1 0 0"/><limit effort="1" velocity="1"/>'


def attached(text: str, other: str, **options: object) -> tuple[Document, list[tuple[str, int, str, str, str | None]]]:
    def read(path: str, around: Document, sink: DiagnosticSink) -> Document:
        del path, around, sink
        return twinform.loads(other)

    sink = DiagnosticSink()
    made = Attach.model_validate({"file": "hand", "to": "tool", **options}).run_with(twinform.loads(text), sink, read)
    return made, [
        (each.rule.name, each.location.line, each.location.path, each.message, each.found) for each in sink.diagnostics
    ]


def joined(text: str, guest: str) -> str:
    """A robot with the parts of another one behind its own."""
    return text.replace("</robot>", f"{guest}</robot>")


MOUNT = '<joint name="palm_mount" type="fixed"><parent link="tool"/><child link="palm"/>{}</joint>'
PARTS = """<material name="hand_grey"><color rgba="0 0 0 1"/></material>
<material name="red"><color rgba="1 0 0 1"/></material>
<link name="palm"><visual name="v"><geometry><sphere radius="1"/></geometry><material name="hand_grey"/></visual>
<visual name="w"><geometry><sphere radius="1"/></geometry><material name="red"/></visual></link>
<link name="finger"/>"""
SLIDE = """<joint name="slide" type="fixed"><parent link="palm"/><child link="finger"/><origin xyz="0 1 0"/></joint>"""


@pytest.mark.parametrize(
    ("options", "origin"),
    [
        ({}, ""),
        ({"xyz": (0, 0, 2)}, '<origin xyz="0 0 2"/>'),
        ({"rpy": (0, 0, 2)}, '<origin rpy="0 0 2"/>'),
        ({"xyz": (1, 2, 3), "rpy": (4, 5, 6)}, '<origin xyz="1 2 3" rpy="4 5 6"/>'),
    ],
)
@pytest.mark.parametrize("held", ["", HELD.format("fix", "fixed", "palm", "")])
def test_a_robot_gets_the_parts_of_another(options: dict[str, object], origin: str, held: str) -> None:
    made, reported = attached(ARM, HAND.format(held), **options)
    assert made == twinform.loads(joined(ARM, PARTS + MOUNT.format(origin) + SLIDE))
    assert reported == []


@pytest.mark.parametrize(
    "held",
    [
        HELD.format("fix", "revolute", "palm", AXIS),
        HELD.format("fix", "fixed", "palm", "") + HELD.format("too", "fixed", "box", "")[21:] + '<link name="box"/>',
    ],
)
def test_what_the_world_holds_by_more_than_one_fixed_joint_stays_there(held: str) -> None:
    made, reported = attached(ARM, HAND.format(held), link="palm")
    assert made == twinform.loads(ARM)
    message = "link 'palm' of the attached robot hangs from another one; `reroot` makes it the root"
    assert reported == [("unknown-name", 1, "/robot[@name='hand']", message, "palm")]


@pytest.mark.parametrize(
    ("options", "message", "found"),
    [
        ({"link": "plam"}, "'hand' has no link 'plam'", "plam"),
        ({}, "'hand' has no root link that could be held", None),
    ],
)
def test_what_cannot_be_held_is_reported(options: dict[str, object], message: str, found: str | None) -> None:
    arm = '<sdf version="1.11"><model name="arm"><link name="tool"/></model></sdf>'
    loose = '<sdf version="1.11">\n<model name="hand"><link name="a"/><link name="b"/></model></sdf>'
    made, reported = attached(arm, loose, **options)
    assert made == twinform.loads(arm)
    assert reported == [("unknown-name", 2, "/sdf/model[@name='hand']", message, found)]


def test_one_model_is_attached_and_not_several() -> None:
    models = "".join(f'<model name="{name}"><link name="l"/></model>' for name in "ab")
    two = f'<sdf version="1.9"><world name="w">{models}</world></sdf>'
    made, reported = attached(ARM, two)
    assert [link.name for link in made.models[0].links] == ["tool"]
    assert reported == [
        ("unread-document", 1, "/robot[@name='arm']", "'hand' has 2 models, and one is attached", "hand")
    ]
