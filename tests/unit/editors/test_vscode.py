"""The extension for Visual Studio Code, run by Node with stand-ins for the editor and the client."""

import json
import os
import shutil
import subprocess
from typing import Any

import pytest

from testbed.corpus.files import ROOT
from twinform.server.editor_options import EditorOptions

NODE = shutil.which("node")
pytestmark = [pytest.mark.slow, pytest.mark.skipif(NODE is None, reason="Node is not installed")]

_RANGE = {"start": {"line": 2, "character": 11}, "end": {"line": 2, "character": 11}}


def run(typed: str, edits: list[dict[str, Any]], settings: dict[str, Any] | None = None, view: str = "") -> Any:
    assert NODE is not None
    script, extension = ROOT / "testbed" / "editor" / "vscode.js", ROOT / "editors" / "vscode" / "extension.js"
    command = [NODE, str(script), str(extension), json.dumps(edits), typed, json.dumps(settings or {})]
    environment = {**os.environ, **({"VIEW": view} if view else {})}
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True, env=environment)
    return json.loads(done.stdout)


@pytest.mark.parametrize(("typed", "new", "snippet"), [(">", "</a$b>", "$0</a\\$b>"), ("/", "link>", "link>")])
def test_a_tag_is_closed_with_the_cursor_where_one_types_on(typed: str, new: str, snippet: str) -> None:
    did = run(typed, [{"newText": new, "range": _RANGE}])
    assert did["requests"] == [["textDocument/onTypeFormatting", {"line": 2, "character": 11}, typed]]
    assert did["snippets"] == [[snippet, _RANGE]]


def test_nothing_is_asked_for_other_characters_or_where_it_is_off() -> None:
    edits = [{"newText": "</a>", "range": _RANGE}]
    assert run("x", edits)["requests"] == []
    assert run(">", edits, {"autoCloseTags": False})["requests"] == []
    assert run(">", [])["snippets"] == []


def test_the_server_is_told_the_settings_that_it_knows() -> None:
    options = run("x", [], {"codeLens": False})["options"]
    assert EditorOptions.of(options["initializationOptions"]) == EditorOptions(code_lens=False, check_workspace=True)


def test_the_model_is_shown_beside_its_file() -> None:
    said = run("x", [], view="console.log(`showing ${process.argv} at http://localhost:8080; Ctrl-C ends`)")
    assert said["browsers"] == [["simpleBrowser.show", "http://localhost:8080"]]
    assert said["messages"] == []


def test_why_no_model_is_shown_is_said() -> None:
    said = run("x", [], view="console.error('it has no links'); process.exitCode = 2")
    assert said["browsers"] == []
    assert "it has no links" in said["messages"][0]
