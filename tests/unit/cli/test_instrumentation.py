"""Looking over the shoulder of passes, and making their faults come again."""

import json
from pathlib import Path
from typing import ClassVar

import pytest

from tests.distributions import Install
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes import Pass
from twinform.passes.legalise.unwritten_masses import UrdfBodies

from .conftest import GOOD, Run


class Raising(Pass):
    """Raises where a model has a name."""

    name: ClassVar[str] = "raising"
    model: str = "one"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        if document.models[0].name == self.model:
            raise ZeroDivisionError("no parts")
        return document


class Breaking(Pass):
    """Takes all links away from a model with joints."""

    name: ClassVar[str] = "breaking"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        model = document.models[0]
        links = (*model.links, *model.links)
        return document.copy(models=(model.copy(links=links),))


class Homesick(Pass):
    """Raises only where the document knows its file."""

    name: ClassVar[str] = "homesick"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        if document.models[0].source:
            raise ValueError("line 1")
        return document


@pytest.fixture(autouse=True, scope="module")
def _installed(install: Install) -> None:
    kinds = (Raising, Breaking, Homesick)
    install("stranger", {each.name: f"{__name__}:{each.__name__}" for each in kinds})


def test_each_pass_has_a_line_in_the_table(run: Run, here: Path) -> None:
    done = run("convert", "good.urdf", "--passes", "check-inertia", "--time-passes", "-o", "good.sdf")
    lines = done.stderr.splitlines()
    assert lines[1].split() == ["ms", "%", "changed", "added", "removed", "findings", "ledger", "pass"]
    names = [line.split()[-1] for line in lines[2:]]
    assert names[0] == "check-inertia"
    assert "retarget-sdf" in names
    assert lines[-3].endswith("all passes")


def test_statistics_without_times_are_the_same_each_time(run: Run, here: Path) -> None:
    lines = [run("convert", "good.urdf", "--pass-statistics", "-o", f"{name}.sdf").stderr for name in "ab"]
    assert lines[0] == lines[1]
    assert "\n      2      0        0         0       0  retarget-sdf\n" in lines[0]


def test_changes_are_printed_and_nothing_for_what_did_not_change(run: Run, here: Path) -> None:
    done = run("convert", "good.urdf", "--to", "urdf", "--passes", "check-inertia", "--print-changes")
    assert "check-inertia" not in done.stderr
    done = run("convert", "good.urdf", "--print-changes", "-o", "good.sdf")
    assert '\n  ~ /version: not set -> "1.11"\n' in done.stderr


def test_a_pass_that_raises_leaves_a_file_that_raises_again(run: Run, here: Path) -> None:
    done = run("convert", "good.urdf", "--passes", "check-inertia,raising", "--time-passes", "-o", "good.sdf")
    assert done.exit_code == 1
    assert "raising (failed)" in done.stderr
    assert "good.urdf: the pass raising failed: ZeroDivisionError: no parts" in done.stderr
    assert "to see it again: twinform reproduce twinform-raising-good.json" in done.stderr
    assert not Path("good.sdf").exists()
    again = run("reproduce", "twinform-raising-good.json")
    assert again.exit_code == 1
    assert "Traceback" in again.stderr
    assert "ZeroDivisionError: no parts" in again.stderr


def test_a_pass_that_breaks_the_document_leaves_a_file(run: Run, here: Path) -> None:
    done = run("convert", "good.urdf", "--passes", "breaking", "--dump-ir-after", "breaking")
    assert "// good.urdf after breaking" in done.stderr
    assert "the pass breaking made an invalid document" in done.stderr
    again = run("reproduce", "twinform-breaking-good.json")
    assert again.exit_code == 1
    assert "the pass breaking made an invalid document" in again.stderr


def test_it_is_reported_where_the_document_alone_is_not_enough(run: Run, here: Path) -> None:
    assert run("convert", "good.urdf", "--passes", "homesick").exit_code == 1
    again = run("reproduce", "twinform-homesick-good.json")
    assert again.exit_code == 0
    assert "it needs the source, lines and all" in again.stderr


def test_a_fault_that_is_fixed_is_gone(run: Run, here: Path) -> None:
    run("convert", "good.urdf", "--passes", "raising")
    path = Path("twinform-raising-good.json")
    path.write_text(path.read_text().replace('"pipeline": "raising"', '"pipeline": "raising{model=two}"'))
    again = run("reproduce", path)
    assert (again.exit_code, again.stderr.splitlines()[-1]) == (0, "it does not fail")


def test_no_reproducer_is_ever_overwritten(run: Run, here: Path) -> None:
    for _ in range(3):
        run("convert", "good.urdf", "--passes", "raising", "--reproducers", "faults")
    assert sorted(path.name for path in Path("faults").iterdir()) == [
        "twinform-raising-good-2.json",
        "twinform-raising-good-3.json",
        "twinform-raising-good.json",
    ]


def test_a_folder_that_cannot_be_written_is_no_second_fault(
    run: Run, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("file").write_text("")
    done = run("convert", "good.urdf", "--passes", "raising", "--reproducers", "file/folder")
    assert done.exit_code == 1
    assert "nothing could be written that makes it come again" in done.stderr


def test_the_folder_for_temporary_files_stands_in(
    run: Run, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    gone, temporary = tmp_path / "gone", tmp_path / "temporary"
    gone.mkdir()
    temporary.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    done = run("convert", folder / "good.urdf", "--passes", "raising")
    assert f"twinform reproduce {temporary / 'twinform-raising-good.json'}" in done.stderr


def test_a_fault_of_standard_input_has_a_name_too(run: Run, here: Path) -> None:
    run("convert", "-", "--to", "sdf", "--passes", "raising", text=GOOD)
    assert Path("twinform-raising-stdin.json").exists()


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "is no reproducer"),
        ("{}", "is no reproducer"),
        ("[" * 100_000, "is no reproducer"),
        ("\udcff", "is no reproducer"),
    ],
)
def test_what_is_no_reproducer_is_wrong_usage(run: Run, here: Path, text: str, complaint: str) -> None:
    Path("file.json").write_bytes(text.encode(errors="surrogateescape"))
    done = run("reproduce", "file.json")
    assert (done.exit_code, complaint in done.stderr) == (2, True)
    assert run("reproduce", "missing.json").exit_code == 2


def test_a_reproducer_of_a_pass_that_is_not_installed_is_wrong_usage(run: Run, here: Path) -> None:
    run("convert", "good.urdf", "--passes", "raising")
    path = Path("twinform-raising-good.json")
    found = json.loads(path.read_text())
    path.write_text(json.dumps(found | {"pipeline": "gone"}))
    done = run("reproduce", path)
    assert (done.exit_code, "no pass is called gone" in done.stderr) == (2, True)


def test_a_fault_that_no_command_expects_is_named_too(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*_: object) -> Document:
        raise ZeroDivisionError("no parts")

    monkeypatch.setattr(UrdfBodies, "run", stop)
    done = run("diff", "good.urdf", "good.urdf")
    assert done.exit_code == 2
    assert "the pass urdf-bodies failed: ZeroDivisionError: no parts" in done.stderr
    assert Path("twinform-urdf-bodies-twinform_diff.json").exists()
