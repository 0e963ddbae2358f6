"""A browser for all tests of a file, and pages in which nothing may go wrong."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from reports.harness.browser import chromium, missing

from .watched import Watched

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

_OWN = ("http://127.0.0.1:", "ws://127.0.0.1:", "file:", "data:", "blob:", "about:")


@pytest.fixture(scope="module")
def browser() -> "Iterator[Browser]":
    """Chromium, where it is installed, for the tests of a file: where it runs, no other test may have an event loop."""
    if why := missing():
        pytest.skip(why)
    with chromium() as found:
        yield found


@pytest.fixture
def page(browser: "Browser") -> "Iterator[Page]":
    """An empty page; what goes wrong in it, and what it asks other machines for, fails the test."""
    context = browser.new_context(viewport={"width": 640, "height": 400})
    opened, faults = context.new_page(), list[str]()
    opened.on("console", lambda message: faults.append(message.text) if message.type == "error" else None)
    opened.on("pageerror", lambda error: faults.append(str(error)))
    opened.on("request", lambda request: faults.append(request.url) if not request.url.startswith(_OWN) else None)
    yield opened
    context.close()
    assert not faults


@pytest.fixture
def watched(browser: "Browser") -> "Iterator[Watched]":
    """A new page without a network, which keeps what goes wrong in it for the test to look at."""
    context = browser.new_context(offline=True)
    yield Watched(context.new_page())
    context.close()
