"""What is published says the same everywhere: versions, dependencies, Pythons, and no address that is not ours."""

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import yaml

from testbed.corpus.files import ROOT
from twinform.diagnostics.catalog import HOME

_PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
_ADDRESS = re.compile(r"""https?://(?!example\.org)[^\s"'`<>)]*twinform[^\s"'`<>)]*""")


def _load_yaml(path: str) -> Any:
    return yaml.safe_load((ROOT / path).read_text(encoding="utf-8"))


def _extension() -> dict[str, Any]:
    return json.loads((ROOT / "editors/vscode/package.json").read_text(encoding="utf-8"))


def _recipe() -> dict[str, Any]:
    return _load_yaml("packaging/conda/recipe.yaml")


def test_there_is_one_version() -> None:
    versions = {_PROJECT["version"], _extension()["version"], str(_load_yaml("CITATION.cff")["version"])}
    assert {*versions, _recipe()["context"]["version"]} == {_PROJECT["version"]}
    assert f"\n## {_PROJECT['version']}\n" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


def test_the_recipe_asks_for_what_the_package_asks_for() -> None:
    python = f"python{_PROJECT['requires-python']}"
    assert [each.replace(" ", "") for each in _recipe()["requirements"]["run"]] == [python, *_PROJECT["dependencies"]]
    assert _recipe()["about"]["summary"] == _PROJECT["description"]


def test_the_pythons_of_the_metadata_are_tested_for_every_change() -> None:
    named = re.findall(r"Python :: (3\.\d+)$", "\n".join(_PROJECT["classifiers"]), re.MULTILINE)
    assert named
    assert {*named} <= {*_load_yaml(".github/workflows/test.yml")["jobs"]["unit"]["strategy"]["matrix"]["python"]}


def _addresses(path: Path) -> set[str]:
    try:
        return {*_ADDRESS.findall(path.read_text(encoding="utf-8"))}
    except UnicodeDecodeError:
        return set()


def test_every_address_of_the_project_is_made_of_the_one_that_it_owns() -> None:
    folders = ("twinform", "docs", "editors", "reports", "generators", "packaging", ".github")
    files = [*ROOT.glob("*.*"), *(path for name in folders for path in (ROOT / name).rglob("*.*"))]
    found = {each for path in files if path.is_file() and "node_modules" not in path.parts for each in _addresses(path)}
    assert {each for each in found if not HOME or not each.startswith(HOME)} == set()
    links = [*_PROJECT.get("urls", {}).values(), _extension().get("repository", {}).get("url")]
    assert all(link and link.startswith(HOME) for link in links) if HOME else links == [None]
