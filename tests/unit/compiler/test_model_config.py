"""Which SDF file a model.config chooses."""

from pathlib import Path

import pytest

from twinform.compiler.model_config import model_file
from twinform.diagnostics import DiagnosticSink

SEVERAL = "<sdf version='1.4'>old.sdf</sdf><sdf version='1.9'>new.sdf</sdf><sdf>any.sdf</sdf>"
CHOICES = [
    (SEVERAL, (1, 4), "old.sdf"),
    (SEVERAL, (1, 8), "old.sdf"),
    (SEVERAL, (1, 12), "new.sdf"),
    (SEVERAL, (1, 2), "old.sdf"),
    (SEVERAL, None, "new.sdf"),
    ("<sdf version='1.9'>new.sdf</sdf>", (1, 4), "new.sdf"),
    ("<sdf version='1.8'>old.sdf</sdf><sdf version='1.9'>new.sdf</sdf>", (1, 4), "old.sdf"),
    ("<sdf version='1.6'>old.sdf</sdf><sdf version='1.6.1'>new.sdf</sdf>", (1, 9), "new.sdf"),
    ("<sdf>any.sdf</sdf><sdf version='1'>new.sdf</sdf>", (1, 9), "new.sdf"),
    ("<sdf version=''>any.sdf</sdf>", (1, 9), "any.sdf"),
    ("<sdf version='1.6'> \n old.sdf </sdf>", (1, 9), "old.sdf"),
]
BROKEN = [
    ("<model>\n<name>a</name>\n</model>", 1, "broken-model-config", "names no SDF file"),
    ("<model>\n<sdf version='1.9'>none.sdf</sdf>\n</model>", 2, "broken-model-config", "not there"),
    ("<model>\n<sdf version='1.9'>../new.sdf</sdf>\n</model>", 2, "uri-leaves-folder", "not in its folder"),
    (
        "<model>\n<sdf version='1.5'>new.sdf</sdf>\n<sdf version='1.6'/></model>",
        3,
        "broken-model-config",
        "names no SDF",
    ),
    ("<model>\n<sdf version='x'>new.sdf</sdf></model>", 2, "broken-model-config", "'x' is no version"),
    ("<robot>\n<sdf version='1.6'>new.sdf</sdf></robot>", 1, "broken-model-config", "expected <model>"),
    ("<model>\n<sdf>", 2, "not-well-formed", "not well-formed"),
]


@pytest.mark.parametrize(("entries", "asked", "name"), CHOICES)
def test_the_newest_that_is_not_newer_than_asked_is_chosen_or_the_first(
    tmp_path: Path, entries: str, asked: tuple[int, int] | None, name: str
) -> None:
    for each in ("old.sdf", "new.sdf", "any.sdf"):
        (tmp_path / each).touch()
    config = tmp_path / "model.config"
    config.write_text(f"<model>{entries}</model>")
    sink = DiagnosticSink()
    assert model_file(config, asked, sink) == tmp_path / name
    assert sink.diagnostics == []


@pytest.mark.parametrize(("text", "line", "rule", "message"), BROKEN)
def test_a_broken_one_is_an_error_with_its_line(tmp_path: Path, text: str, line: int, rule: str, message: str) -> None:
    folder = tmp_path / "crate"
    folder.mkdir()
    (tmp_path / "new.sdf").touch()
    config = folder / "model.config"
    config.write_text(text)
    sink = DiagnosticSink(file="world.sdf")
    assert model_file(config, (1, 9), sink) is None
    found = sink.diagnostics[0]
    assert (found.location.file, found.location.line, found.rule.name) == (str(config), line, rule)
    assert message in found.message
