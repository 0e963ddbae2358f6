"""What notebooks show, by themselves and in a notebook that is run."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from nbclient import NotebookClient
from nbformat import NotebookNode

import twinform
from twinform.report import show

from .models import EVIL, EXAMPLES, PAGE, WRONG, hostile


def _shown(value: object) -> str:
    """What IPython asks a value for."""
    text = value._repr_html_()  # type: ignore[attr-defined]
    assert isinstance(text, str)
    return text


def test_a_document_shows_what_it_is() -> None:
    text = _shown(twinform.load(EXAMPLES / "gripper.urdf"))
    assert "<b>gripper</b>: URDF, 3 links, 2 joints, 1 mimic" in text
    assert "0 errors" in text
    assert "data:image/svg+xml;base64," in text
    assert len(text) < 20_000


def test_a_document_with_findings_lists_them() -> None:
    text = _shown(twinform.check(WRONG.encode()).document)
    assert "1 error, 0 warnings" in text
    assert "&#x27;bse&#x27;, but there is no such link" in text


def test_a_conversion_shows_what_became_of_the_parts() -> None:
    text = _shown(twinform.convert(EXAMPLES / "rover.urdf", to="sdf"))
    assert "478 expressed, 40 carried, 1 approximated, 0 dropped" in text
    assert "and 9 more" in text
    assert len(text) < 20_000


def test_hostile_names_are_text() -> None:
    document = twinform.loads(hostile().encode())
    for text in (_shown(document), _shown(twinform.convert(document, to="sdf"))):
        assert "<script" not in text
        assert EVIL.split("'")[0] not in text


def test_a_large_model_is_a_line() -> None:
    links = "".join(f'<link name="l{i}"/>' for i in range(500))
    text = _shown(twinform.check(f'<robot name="r">{links}</robot>'.encode()).document)
    assert "500 links" in text
    assert len(text) < 10_000


def _page(*_: object, dark: bool) -> str:
    return "" if dark else PAGE


def test_the_view_is_shown_on_request_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("twinform.view.standalone_page", _page)
    document = twinform.load(EXAMPLES / "gripper.urdf")
    text = _shown(show(document, height=300))
    assert 'sandbox="allow-scripts"' in text
    assert 'height="300"' in text
    assert "&lt;script&gt;" in text
    assert "iframe" not in _shown(document)
    assert "document.title" not in repr(show(document))


def test_importing_the_package_costs_nothing_more() -> None:
    """Neither reports nor the view are imported before something is shown."""
    program = "import sys, twinform; twinform.load(sys.argv[1]); print([*sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", program, str(EXAMPLES / "arm.urdf")], capture_output=True, text=True, check=True
    )
    assert "twinform.compiler" in done.stdout
    assert not any(
        name in done.stdout for name in ("twinform.report", "twinform.view", "twinform.compiler.graph", "viser")
    )


def _cell(source: str) -> NotebookNode:
    return NotebookNode(cell_type="code", metadata={}, outputs=[], execution_count=None, source=source)


@pytest.mark.slow
def test_a_notebook_shows_documents_and_conversions() -> None:
    cells = (
        "import twinform\nfrom twinform.report import show",
        f"document = twinform.load({str(EXAMPLES / 'gripper.urdf')!r})\ndocument",
        "twinform.convert(document, to='sdf')",
    )
    notebook = NotebookNode(cells=[_cell(cell) for cell in cells], metadata={}, nbformat=4, nbformat_minor=4)
    NotebookClient(notebook, timeout=60, kernel_name="python3").execute()
    shown = ["".join(output["data"]["text/html"]) for cell in notebook.cells for output in cell.outputs]
    assert ["gripper" in shown[0], "expressed" in shown[1]] == [True, True]


_TUTORIAL = EXAMPLES.parent / "docs/tutorial/notebook.ipynb"


@pytest.mark.slow
def test_the_tutorial_runs_and_shows_what_it_says(tmp_path: Path) -> None:
    (tmp_path / "examples").symlink_to(EXAMPLES)
    cells: list[dict[str, Any]] = json.loads(_TUTORIAL.read_text("utf-8"))["cells"]
    assert not any(each.get("outputs") for each in cells)
    code = [_cell(each["source"]) for each in cells if each["cell_type"] == "code"]
    notebook = NotebookNode(cells=code, metadata={}, nbformat=4, nbformat_minor=4)
    resources = {"metadata": {"path": str(tmp_path)}}
    NotebookClient(notebook, timeout=60, kernel_name="python3", resources=resources).execute()
    outputs = [output for cell in notebook.cells for output in cell.outputs]
    assert {output["output_type"] for output in outputs} == {"execute_result"}
    shown = "\n".join(text for output in outputs for text in output["data"].values())
    for each in ("<b>rover</b>", "'continuous'", "did you mean 'value'", "478 expressed", "inertial/mass", "True"):
        assert each in shown
    assert (tmp_path / "out/heavier.urdf").is_file()
