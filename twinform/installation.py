"""How twinform was installed here, and the command that adds an extra to that installation."""

import json
import os
import shlex
import sys
import sysconfig
import tomllib
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit
from urllib.request import url2pathname

from twinform.child_python import python_command

_NAME = "twinform"
_UV_RECEIPT = "uv-receipt.toml"


def install_command(extra: str = "") -> str:
    """Return the shell command that installs what an extra needs, or without one what every command needs.

    The command is for the tool that made this installation, and names the checkout or the address it came from.
    """
    command, extras = _installer(extra)
    names = f"[{','.join(extras)}]" if extras else ""
    return shlex.join([*command, *_requirement(names)])


def _installer(extra: str) -> tuple[list[str], list[str]]:
    """The start of the command, and all extras that it has to name."""
    extras = [extra] if extra else []
    prefix = Path(sys.prefix)
    if (prefix / _UV_RECEIPT).is_file():
        # uv removes the extras that are not named again
        return ["uv", "tool", "install"], sorted({*extras, *_extras_of_uv(prefix / _UV_RECEIPT)})
    if (prefix / "pipx_metadata.json").is_file():
        return ["pipx", "inject", _NAME], extras
    if sys.prefix == sys.base_prefix and (Path(sysconfig.get_path("stdlib")) / "EXTERNALLY-MANAGED").is_file():
        return ["pipx", "install"], extras  # pip does not change a Python that belongs to the system (PEP 668)
    on_path = sysconfig.get_path("scripts") in os.get_exec_path()
    return ["pip", "install"] if on_path else python_command("-m", "pip", "install"), extras


def _extras_of_uv(receipt: Path) -> list[str]:
    requirements = tomllib.loads(receipt.read_text(encoding="utf-8")).get("tool", {}).get("requirements", [])
    return [extra for each in requirements if each.get("name") == _NAME for extra in each.get("extras", [])]


def _requirement(extras: str) -> list[str]:
    """The arguments that name this package with its extras, by the record of where it came from (PEP 610)."""
    try:
        record: dict[str, Any] = json.loads(distribution(_NAME).read_text("direct_url.json") or "{}")
    except (PackageNotFoundError, ValueError):
        record = {}
    address = str(record.get("url", ""))
    if address.startswith("file:"):
        editable = ["--editable"] if record.get("dir_info", {}).get("editable") else []
        return [*editable, url2pathname(urlsplit(address).path) + extras]
    if "vcs_info" in record:
        address = f"{record['vcs_info']['vcs']}+{address}@{record['vcs_info']['commit_id']}"
    return [f"{_NAME}{extras} @ {address}" if address else f"{_NAME}{extras}"]
