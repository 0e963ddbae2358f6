"""What `check` sees beyond the document: files that it names, and what read-only passes find."""

from pathlib import Path
from typing import ClassVar

import pytest

import twinform
from tests.snippets import INERTIAL
from twinform.compiler import ReadOnlyPassError
from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.diagnostics.rules import EMPTY_RANGE
from twinform.ir import Document
from twinform.passes import Pass, Pipeline, PipelineError, parse_pipeline


def missing(path: Path, *uris: str, name: str = "robot.urdf") -> list[tuple[str, str | None]]:
    """What is found about the meshes of a robot in a folder."""
    meshes = "".join(f'<visual><geometry><mesh filename="{uri}"/></geometry></visual>\n' for uri in uris)
    file = path / name
    file.write_text(f'<robot name="r"><link name="a">{meshes}</link></robot>')
    return [(each.message, each.help) for each in twinform.check(file).diagnostics if each.rule.name == "missing-file"]


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package beside another one whose folder is called otherwise, in a repository."""
    for folder, called in (("arm", "arm"), ("hand-2.1", "hand")):
        (tmp_path / folder / "meshes").mkdir(parents=True)
        (tmp_path / folder / "package.xml").write_text(f"<package><name>{called}</name></package>")
        (tmp_path / folder / "meshes" / "part.stl").write_text("solid s\nendsolid s")
    (tmp_path / ".git").mkdir()
    return tmp_path / "arm"


def test_files_that_are_there_are_nothing_to_say(package: Path) -> None:
    there = ("package://arm/meshes/part.stl", "package://hand/meshes/part.stl", "meshes/part.stl", "model://arm/meshes")
    assert missing(package, *there, f"file://{package}/meshes/part.stl", str(package / "meshes/part.stl")) == []


def test_what_is_not_on_this_machine_may_be_elsewhere(package: Path) -> None:
    elsewhere = ("package://leg/a.stl", "model://sun", "https://fuel.example.org/a", "file://media/x.material")
    assert missing(package, *elsewhere, "package://$(arg pkg)/a.stl", "ftp://a/b") == []


@pytest.mark.parametrize(
    ("uri", "near"),
    [
        ("package://arm/meshes/prat.stl", "part.stl"),
        ("package://arm/mesh/part.stl", "meshes"),
        ("package://hnad/meshes/part.stl", "hand"),
        ("packge://arm/meshes/part.stl", "package://"),
        ("meshes/Part.STL", "part.stl"),
        ("package:/arm/meshes/part.stl", "package://"),
        ("package://arm/meshes/part.dae", "part.stl"),
        ("meshes/part.OBJ", "part.stl"),
        ("meshes/part.png", None),
        ("../hand-2.1/meshes/part.stlx", None),
        ("package://arm/meshes/quite_another.stl", None),
    ],
)
def test_a_slip_reports_what_was_meant(package: Path, uri: str, near: str | None) -> None:
    ((message, hint),) = missing(package, uri)
    assert message == f"the mesh {uri!r} is not there"
    assert hint is not None
    assert hint.startswith(f"did you mean {near!r}?" if near else "looked in ")


def test_of_a_folder_of_which_nothing_is_there_one_thing_is_reported(package: Path) -> None:
    gone = [f"gone/{number}.stl" for number in range(9)]
    ((message, _),) = missing(package, *gone)
    assert message == "the mesh 'gone/0.stl' is not there, nor is anything else of what is named by a path: 8 more"
    ((message, _),) = missing(package, *gone, "meshes/part.stl")
    assert message == "the mesh 'gone/0.stl' is not there, nor are 8 more files of what is named by a path"
    assert len(missing(package, *gone[:4], "meshes/part.stl")) == 4


@pytest.mark.parametrize("uri", ["x" * 10_000, "model://" + "x" * 10_000, "package://arm/" + "x/" * 5000, "a&#10;b"])
def test_a_name_that_no_file_can_have_is_a_finding_or_none(package: Path, uri: str) -> None:
    assert len(missing(package, uri)) == (0 if uri.startswith("model") else 1)


def test_names_outside_of_the_folders_are_not_revealed(package: Path) -> None:
    (package.parent.parent / "secrets").mkdir(exist_ok=True)
    assert [hint for _, hint in missing(package, "../../secretz/a.stl") if "secrets" in (hint or "")] == []


def test_a_text_that_lies_nowhere_names_no_files() -> None:
    text = '<robot name="r"><link name="a"><visual><geometry><mesh filename="{}"/></geometry></visual></link></robot>'
    assert twinform.check(text.format("a.stl").encode()).diagnostics == ()
    (found,) = twinform.check(text.format("a\\b.stl").encode()).diagnostics
    assert (found.rule.name, found.help) == ("backslash-in-path", "write 'a/b.stl'")


def test_a_json_document_is_looked_at_as_well(package: Path) -> None:
    file = package / "robot.json"
    file.write_text(
        '{"format": "urdf", "models": [{"name": "r", "links": [{"name": "a", "visuals": '
        '[{"geometry": {"shape": {"kind": "mesh", "uri": "none.stl"}}}]}]}]}'
    )
    assert [each.rule.name for each in twinform.check(file).diagnostics] == ["missing-file"]


MOVING = f"""<robot name="r"><link name="a">{INERTIAL}</link>
<link name="b"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="-20" upper="21" effort="1" velocity="1"/></joint></robot>"""


def rules(diagnostics: tuple[Diagnostic, ...]) -> list[tuple[str, int]]:
    return [(each.rule.name, each.location.line) for each in diagnostics]


def test_read_only_passes_report_what_they_find_once() -> None:
    plain = rules(twinform.check(MOVING.encode()).diagnostics)
    assert plain == [("missing-inertial", 2)]
    looked = rules(twinform.check(MOVING.encode(), passes="check-limits,check-inertia").diagnostics)
    assert looked == [("missing-inertial", 2), ("range-in-degrees", 4)]


def test_passes_do_not_look_at_what_has_errors() -> None:
    wrong = MOVING.replace('<child link="b"/>', "")
    assert "range-in-degrees" not in dict(rules(twinform.check(wrong.encode(), passes="check-limits").diagnostics))


@pytest.mark.parametrize(
    ("passes", "why"),
    [
        ("fill-inertia{density=1000 mass=1}", None),
        ("fill-limits{damping=1}", "fill-limits changes the model"),
        ("check-limits,bridge-config{file=b.yaml}", "bridge-config writes a file"),
    ],
)
def test_passes_that_do_more_are_refused(passes: str, why: str | None) -> None:
    if why is None:  # wrong options are what they are everywhere
        with pytest.raises(PipelineError):
            twinform.check(MOVING.encode(), passes=passes)
        return
    with pytest.raises(ReadOnlyPassError, match=why):
        twinform.check(MOVING.encode(), passes=passes)


def test_a_read_only_pass_of_somebody_else_runs_as_well() -> None:
    class CheckNames(Pass):
        name: ClassVar[str] = "check-names"

        def run(self, document: Document, sink: DiagnosticSink) -> Document:
            for joint in document.models[0].joints:
                sink.report(EMPTY_RANGE, f"{joint.name} is short", joint.location.at("child"))
            return document.model_copy()

    found = twinform.check(MOVING.encode(), passes=Pipeline((CheckNames(), *parse_pipeline("check-limits"))))
    assert rules(found.diagnostics) == [("missing-inertial", 2), ("empty-range", 3), ("range-in-degrees", 4)]
