"""Pages with what went wrong in them, and what they asked for."""

from collections.abc import Generator
from contextlib import contextmanager
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Browser, ConsoleMessage, Dialog, Page

_OWN = ("http://127.0.0.1:", "ws://127.0.0.1:", "file:", "data:", "blob:", "about:")
_QUIET = frozenset({"log", "info", "debug"})
_KNOWN = ("THREE.Clock: This module has been deprecated.", "GPU stall due to ReadPixels")
"""Warnings of viser's client, and of renderers in software."""
_INTERVENTION = "Unable to preventDefault inside passive event listener"
"""What Chromium says of viser's client when a part is dragged."""

_AXE = {"preload": False, "runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"]}


class Watched:
    """A page; `complaints` are warnings, errors and dialogs, in frames too."""

    def __init__(self, page: "Page") -> None:
        self.page = page
        self.complaints: list[str] = []
        self.requests: list[str] = []
        page.on("console", self._listen)
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("dialog", self._refuse)
        page.on("request", lambda request: self.requests.append(request.url))

    def open(self, path: Path) -> "Page":
        """Open a file, and wait until all of it is there."""
        self.page.goto(path.as_uri())
        return self.page

    @property
    def outside(self) -> list[str]:
        """What was asked for besides the file itself and what is in it."""
        inside = ("data:", "blob:", "about:srcdoc")
        return [url for url in self.requests if url.partition("#")[0] != self._own and not url.startswith(inside)]

    @property
    def _own(self) -> str:
        return self.page.url.partition("#")[0]

    def _listen(self, message: "ConsoleMessage") -> None:
        if message.type not in _QUIET and not any(known in message.text for known in _KNOWN):
            self.complaints.append(f"{message.type}: {message.text}")

    def _refuse(self, dialog: "Dialog") -> None:
        self.complaints.append(f"dialog: {dialog.message}")
        dialog.dismiss()


def violations(page: "Page") -> list[str]:
    """What axe-core says against a page: a rule, and the elements."""
    page.evaluate((files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8"))
    return page.evaluate(
        "async options => (await axe.run(document, options)).violations"
        ".map(each => each.id + ': ' + each.nodes.map(node => node.html).join(' '))",
        _AXE,
    )


@contextmanager
def strict_page(browser: "Browser") -> "Generator[tuple[Page, list[str]]]":
    """An empty page, with what goes wrong in it and what it asks other machines for."""
    context = browser.new_context(viewport={"width": 640, "height": 400})
    opened, faults = context.new_page(), list[str]()
    opened.set_default_timeout(90_000)  # a renderer in software, beside other tests
    opened.on("console", lambda message: faults.append(message.text) if _is_fault(message) else None)
    opened.on("pageerror", lambda error: faults.append(str(error)))
    opened.on("request", lambda request: faults.append(request.url) if not request.url.startswith(_OWN) else None)
    yield opened, faults
    context.close()


def _is_fault(message: "ConsoleMessage") -> bool:
    return message.type == "error" and _INTERVENTION not in message.text
