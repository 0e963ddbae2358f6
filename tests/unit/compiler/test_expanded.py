"""A text that a file was expanded to is read as any other; findings are where their parts were written."""

from pathlib import Path

import pytest

from twinform.compiler import LoadResult, check
from twinform.compiler.input import expand_xacro
from twinform.compiler.input.expand_xacro import Expansion
from twinform.diagnostics import LineOrigins, Location

TEXT = b"""<robot name="r"><link name="a"/>
<link name="b"><nonsense/></link>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>"""


def read(monkeypatch: pytest.MonkeyPatch, *, strict: bool, text: bytes = TEXT) -> LoadResult:
    origins = LineOrigins.of([(1, Location("/arm.xacro", 10)), (2, Location("/parts.xacro", 20))])

    def expand(path: Path, *_: object) -> Expansion:
        assert path == Path("arm.xacro")
        return Expansion(text, origins, {}, {})

    monkeypatch.setattr(expand_xacro, "expand", expand)
    return check(Path("arm.xacro"), strict=strict)


@pytest.mark.parametrize(("strict", "severity"), [(False, "warning"), (True, "error")])
def test_it_is_read_as_strictly(monkeypatch: pytest.MonkeyPatch, *, strict: bool, severity: str) -> None:
    loaded = read(monkeypatch, strict=strict)
    path = "/robot[@name='r']/link[@name='b']/nonsense"
    assert [(each.rule.name, str(each.severity), each.location) for each in loaded.diagnostics] == [
        ("unknown-element", severity, Location("/parts.xacro", 20, path))
    ]
    assert loaded.diagnostics[0].related == (Location("arm.xacro (expanded)", 2, path),)
    assert loaded.accepted is not strict
    assert not loaded.unreadable
    assert loaded.path == "arm.xacro"
    assert list(loaded.origins) == ["arm.xacro (expanded)"]


def test_the_document_knows_its_lines_in_the_expanded_text(monkeypatch: pytest.MonkeyPatch) -> None:
    document = read(monkeypatch, strict=False).document
    assert document
    assert [(link.name, link.location.file, link.location.line) for link in document.models[0].links] == [
        ("a", "arm.xacro (expanded)", 1),
        ("b", "arm.xacro (expanded)", 2),
    ]


def test_what_is_expanded_may_be_no_model_at_all(monkeypatch: pytest.MonkeyPatch) -> None:
    loaded = read(monkeypatch, strict=False, text=b"<scene/>")
    assert [(each.rule.name, each.location.file) for each in loaded.diagnostics] == [("unknown-root", "/arm.xacro")]
    assert loaded.document is None
    assert loaded.unreadable


def test_where_it_is_refused_nothing_is_expanded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expand_xacro, "expand", None)
    loaded = check(Path("arm.xacro"), xacro=False)
    assert [(each.rule.name, each.location, each.message) for each in loaded.diagnostics] == [
        ("xacro-refused", Location("arm.xacro", 1), "this is a xacro file, and xacro is refused here")
    ]
    assert loaded.unreadable
