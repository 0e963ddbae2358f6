"""What `install_command` makes of the ways to install twinform."""

import json
import sys
import sysconfig
from importlib.metadata import Distribution
from pathlib import Path

import pytest

from twinform import installation
from twinform.installation import install_command


class _Installed:
    def __init__(self, origin: object) -> None:
        self.origin = origin

    def read_text(self, name: str) -> str | None:
        assert name == "direct_url.json"
        return None if self.origin is None else json.dumps(self.origin)


@pytest.fixture(autouse=True)
def environment(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """An empty virtual environment on the PATH, with the package from PyPI."""
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    monkeypatch.setenv("PATH", sysconfig.get_path("scripts"))
    _come_from(monkeypatch, None)
    return tmp_path


def _come_from(monkeypatch: pytest.MonkeyPatch, origin: object) -> None:
    def find(name: str) -> _Installed:
        assert name == "twinform"
        return _Installed(origin)

    monkeypatch.setattr(installation, "distribution", find)


def test_pip_of_an_environment_that_is_on_the_path() -> None:
    assert install_command("view") == "pip install 'twinform[view]'"
    assert install_command() == "pip install twinform"


def test_pip_of_an_environment_that_is_not_on_the_path_is_called_by_its_python(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    assert install_command("view") == f"{sys.executable} -P -m pip install 'twinform[view]'"


def test_pipx(environment: Path) -> None:
    (environment / "pipx_metadata.json").touch()
    assert install_command("view") == "pipx inject twinform 'twinform[view]'"


def test_uv_forgets_the_extras_that_are_not_named_again(environment: Path) -> None:
    requirement = '{ name = "twinform", extras = ["watch", "lsp"] }, { name = "numpy", extras = ["x"] }'
    (environment / "uv-receipt.toml").write_text(f"[tool]\nrequirements = [{requirement}]\n")
    assert install_command("view") == "uv tool install 'twinform[lsp,view,watch]'"
    assert install_command("lsp") == "uv tool install 'twinform[lsp,watch]'"


def test_the_python_of_the_system_is_left_alone(environment: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "base_prefix", str(environment))
    monkeypatch.setattr(sysconfig, "get_path", {"stdlib": str(environment), "scripts": "/nowhere"}.get)
    (environment / "EXTERNALLY-MANAGED").touch()
    assert install_command("view") == "pipx install 'twinform[view]'"


@pytest.mark.parametrize(
    ("origin", "command"),
    [
        ({"url": "file:///a%20b", "dir_info": {}}, "pip install '/a b[view]'"),
        ({"url": "file:///a", "dir_info": {"editable": True}}, "pip install --editable '/a[view]'"),
        ({"url": "file:///twinform.whl", "archive_info": {}}, "pip install '/twinform.whl[view]'"),
        (
            {"url": "https://x.example/t.whl", "archive_info": {}},
            "pip install 'twinform[view] @ https://x.example/t.whl'",
        ),
        (
            {"url": "https://x.example/t", "vcs_info": {"vcs": "git", "commit_id": "12"}},
            "pip install 'twinform[view] @ git+https://x.example/t@12'",
        ),
    ],
    ids=["checkout", "editable", "wheel", "address", "git"],
)
def test_a_package_from_elsewhere_is_asked_for_there(
    origin: object, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    _come_from(monkeypatch, origin)
    assert install_command("view") == command


@pytest.mark.parametrize("record", [None, "", "{"], ids=["none", "empty", "broken"])
def test_without_a_record_of_its_origin_the_name_is_asked_for(
    record: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    def read_text(self: _Installed, name: str) -> str | None:
        del self, name
        return record

    monkeypatch.setattr(_Installed, "read_text", read_text)
    assert install_command("view") == "pip install 'twinform[view]'"


def test_every_extra_that_users_have_is_declared() -> None:
    declared = Distribution.from_name("twinform").metadata.get_all("Provides-Extra") or []
    assert {"all", "dask", "lsp", "meshes", "thumbnails", "view", "watch", "xacro"} <= set(declared)
