"""A browser without a screen for all tests here: Chromium, as Debian has it."""

import shutil
from collections.abc import Generator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

_NAMES = ("chromium", "chromium-browser", "google-chrome")
_ARGUMENTS = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox")
"""A renderer in software; the sandbox of Chromium does not start for root."""


@pytest.fixture(scope="session")
def browser() -> Generator[Browser]:
    """The browser; tests that need it are skipped where there is none."""
    program = next(filter(None, map(shutil.which, _NAMES)), None)
    if program is None:
        pytest.skip("there is no Chromium: apt-get install chromium")
    with sync_playwright() as play, play.chromium.launch(executable_path=program, args=_ARGUMENTS) as found:
        yield found


class Watched:
    """A page with what went wrong in it, and what it asked for."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.complaints: list[str] = []
        self.requests: list[str] = []
        page.on("console", lambda message: self.complaints.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("dialog", lambda dialog: self.complaints.append(f"dialog: {dialog.message}"))
        page.on("request", lambda request: self.requests.append(request.url))

    def open(self, path: Path) -> Page:
        """Open a file, and wait until all of it is there."""
        self.page.goto(path.as_uri())
        return self.page

    @property
    def outside(self) -> list[str]:
        """What was asked for besides the file itself and what is in it."""
        inside = ("data:", "blob:", "about:srcdoc")
        return [url for url in self.requests if url != self.page.url and not url.startswith(inside)]


@pytest.fixture
def watched(browser: Browser) -> Generator[Watched]:
    """A new page without a network."""
    context = browser.new_context(offline=True)
    yield Watched(context.new_page())
    context.close()
