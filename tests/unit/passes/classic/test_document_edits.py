"""Material scripts are the business of the pass `materials`."""

from typing import ClassVar

import pytest

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format
from twinform.passes import Pass
from twinform.passes.classic import document_edits


class Recolored(Pass):
    name: ClassVar[str] = "materials"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        del sink
        return document.copy(version="recolored")


DOCUMENT = Document(format=Format.URDF)


def test_the_pass_materials_runs_where_it_is_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(document_edits, "registered_passes", lambda: {"materials": None})
    monkeypatch.setattr(document_edits, "find_pass", {"materials": Recolored}.__getitem__)
    assert document_edits.convert_material_scripts(DOCUMENT, DiagnosticSink()).version == "recolored"


def test_without_it_materials_stay(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(document_edits, "registered_passes", dict)
    assert document_edits.convert_material_scripts(DOCUMENT, DiagnosticSink()) is DOCUMENT
