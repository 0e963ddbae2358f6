from pathlib import Path

import pytest

import twinform
from testbed.corpus.files import ROOT
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format, Link, Model
from twinform.passes import NO_ASSETS, DocumentReader, Pipeline, PipelineError, parse_pipeline
from twinform.passes.structure.attach import Attach
from twinform.passes.structure.reference_words import kind_of_word
from twinform.passes.structure.tag_shapes import shape_name

GRIPPER = ROOT / "examples/gripper.urdf"


def robot(*names: str) -> Document:
    model = Model(name="robot", links=tuple(Link(name=name) for name in names))
    return Document(format=Format.URDF, models=(model,))


def errors(found: DiagnosticSink) -> list[str]:
    return [each.rule.name for each in found.diagnostics]


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ("names=a", "not OLD:NEW"),
        ("names=a:", "not OLD:NEW"),
        ("names=a*:b", "on one side only"),
        ("names=a*b*:c*d*", "several"),
        ("", "needs the option names"),
    ],
)
def test_rename_wants_pairs(options: str, complaint: str) -> None:
    with pytest.raises(PipelineError, match=complaint):
        parse_pipeline(f"rename{{{options}}}")


@pytest.mark.parametrize(
    "text",
    [
        "attach{file=gripper.urdf to=tool0 prefix=left_ xyz=[0.0,0.0,0.01]}",
        "flatten-models{separator=__}",
        "lump-fixed-joints{keep=[tool0,*_optical_frame]}",
        "lump-fixed-joints{compat=libsdformat}",
        "rename{names=[base_link:base,left_*:l_*]}",
        "weld-to-world{xyz=[0.0,0.0,0.5]}",
    ],
)
def test_a_pipeline_is_printed_as_it_was_read(text: str) -> None:
    assert str(parse_pipeline(text)) == text


def test_a_pass_that_needs_files_reports_where_nobody_reads_them() -> None:
    sink, document = DiagnosticSink(), robot("tool0")
    assert Pipeline((Attach(file="gripper.urdf", to="tool0"),)).run(document, sink) is document
    assert errors(sink) == ["unread-document"]


def test_a_pipeline_lends_its_reader() -> None:
    def read(path: str, around: Document, sink: DiagnosticSink) -> Document | None:
        del around, sink
        return robot("palm") if path == "palm" else None

    reader: DocumentReader = read
    sink = DiagnosticSink()
    pipeline = Pipeline((Attach(file="palm", to="tool0"),)).with_files(NO_ASSETS, reader)
    made = pipeline.run(robot("tool0"), sink)
    assert [link.name for link in made.models[0].links] == ["tool0", "palm"]
    assert [(joint.name, joint.parent, joint.child) for joint in made.models[0].joints] == [
        ("palm_mount", "tool0", "palm")
    ]


@pytest.mark.parametrize("content", [b"", b"\0\xff", b"<robot name='r'/>", b"<sdf version='1.9'/>", b"<?xml"])
def test_a_file_that_is_no_model_is_not_attached(content: bytes, tmp_path: Path) -> None:
    other = tmp_path / "other.urdf"
    other.write_bytes(content)
    with pytest.raises(twinform.CompileError):
        twinform.convert(GRIPPER, to="urdf", passes=[Attach(file=str(other), to="palm")])
    with pytest.raises(twinform.CompileError):
        twinform.convert(GRIPPER, to="urdf", passes=[Attach(file=str(tmp_path), to="palm")])


def test_a_gripper_can_be_attached_to_itself_by_another_name() -> None:
    made = twinform.convert(GRIPPER, to="sdf", passes=[Attach(file=str(GRIPPER), to="left_finger", prefix="g_")])
    assert sorted(link.name for link in made.document.models[0].links)[:3] == [
        "g_left_finger",
        "g_palm",
        "g_right_finger",
    ]


@pytest.mark.parametrize(
    ("link", "name", "number", "made"),
    [
        ("base", "foo", 0, "base_fixed_joint_lump__foo_visual"),
        ("base", None, 1, "base_visual_1"),
        ("a", "a_visual", 0, "a_visual_visual"),
        ("base", "base_tool", 0, "base_tool_visual"),
        ("base", "named", 2, "base_fixed_joint_lump__named_visual_2"),
    ],
)
def test_shapes_are_called_as_libsdformat_calls_them(link: str, name: str | None, number: int, made: str) -> None:
    assert shape_name(link, name, "visual", number) == made


@pytest.mark.parametrize(
    ("word", "kind"),
    [
        ("jointName", "joint"), ("left_joint", "joint"), ("bodyName", "link"), ("link_name", "link"),
        ("robotBaseFrame", "frame"), ("{http://drake.mit.edu}member", None), ("topic", None), ("updateRate", None),
        ("frameRate", None), ("parent", "link"),
    ],
)  # fmt: skip
def test_parameter_names_show_what_they_name(word: str, kind: str | None) -> None:
    assert kind_of_word(word) == kind
