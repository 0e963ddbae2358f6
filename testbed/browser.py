"""A real browser: Chromium without a window, driven by playwright, with a renderer that needs no graphics card."""

import shutil
from collections.abc import Generator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Browser

_NAMES = ("chromium", "chromium-browser", "google-chrome")
_ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")


def missing() -> str:
    """Why there is no browser here; empty where there is one."""
    if not any(map(shutil.which, _NAMES)):
        return "there is no Chromium here: apt-get install chromium"
    try:
        import playwright  # noqa: F401, PLC0415 # pyright: ignore[reportUnusedImport] - a tool of developers
        import viser  # noqa: F401, PLC0415 # pyright: ignore[reportUnusedImport] - an extra
    except ImportError as error:
        return f"{error.name} is not installed: make sync"
    return ""


@contextmanager
def chromium() -> "Generator[Browser]":
    """The browser, until the end of the block."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - see above

    program = next(filter(None, map(shutil.which, _NAMES)))
    with sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=program, args=[*_ARGUMENTS])
        try:
            yield found
        finally:
            found.close()
