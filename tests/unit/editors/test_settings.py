"""What the editors' folder says is consistent: with itself, with the command, and with the files that are there."""

import json
import re
import tomllib
from typing import Any

from testbed.corpus.files import ROOT
from twinform import __version__
from twinform.cli import COMMANDS
from twinform.server.includes import ENDINGS

FOLDER = ROOT / "editors" / "vscode"
PACKAGE: dict[str, Any] = json.loads((FOLDER / "package.json").read_text(encoding="utf-8"))
SCRIPTS = sorted(FOLDER.glob("*.js"))
SCRIPT = "".join(each.read_text(encoding="utf-8") for each in SCRIPTS)


def test_the_extension_has_the_version_of_the_package() -> None:
    assert PACKAGE["version"] == __version__


def test_every_language_starts_the_server_and_has_its_files() -> None:
    languages = {each["id"]: each for each in PACKAGE["contributes"]["languages"]}
    assert json.loads(re.findall(r"LANGUAGES = (\[.*\]);", SCRIPT)[0]) == list(languages)
    assert PACKAGE["activationEvents"] == [f"onLanguage:{each}" for each in languages]
    assert {each["language"] for each in PACKAGE["contributes"]["grammars"]} == set(languages)
    for each in (*languages.values(), *PACKAGE["contributes"]["grammars"]):
        path = FOLDER / each.get("configuration", each.get("path"))
        assert json.loads(path.read_text(encoding="utf-8"))
        assert path.relative_to(FOLDER).parts[0] in PACKAGE["files"]
    assert {each.name for each in SCRIPTS} <= set(PACKAGE["files"])
    participants = {
        each["languageId"]: each["autoInsert"] for each in PACKAGE["contributes"]["xmlLanguageParticipants"]
    }
    assert participants == dict.fromkeys(languages, False)  # LemMinX works there, and we close tags
    assert {ending for each in languages.values() for ending in each["extensions"]} <= set(ENDINGS)


def test_the_commands_and_settings_that_the_script_uses_are_declared() -> None:
    declared = {each["command"] for each in PACKAGE["contributes"]["commands"]}
    assert set(re.findall(r'registerCommand\("([^"]+)"', SCRIPT)) == declared
    settings = PACKAGE["contributes"]["configuration"]["properties"]
    assert {f"twinform.{name}" for name in re.findall(r'(?:\bget|\boption)\("([^"]+)"\)', SCRIPT)} == set(settings)
    program, command = settings["twinform.command"]["default"]
    assert program == "twinform"
    assert command in COMMANDS


def test_settings_of_other_editors_are_well_formed_and_start_the_server() -> None:
    text = (ROOT / "editors" / "README.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```(\w+)\n(.*?)```", text, re.DOTALL)
    kinds = [kind for kind, _ in blocks]
    assert kinds == ["json", "lua", "toml", "elisp", "json"]
    for kind, block in blocks:
        assert re.search(r"\blsp\b", block)
        if kind == "toml":
            assert tomllib.loads(block)["language-server"]["twinform"]["args"] == ["lsp"]
        if kind == "json":
            assert json.loads(block if block.startswith("{") else f"{{{block}}}")
