"""A browser for all tests of a file, and pages in which nothing may go wrong."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from testbed.browser import chromium, missing

from .watched import Watched, strict_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page


@pytest.fixture(scope="module")
def browser() -> "Iterator[Browser]":
    """Chromium, where it is installed, for the tests of a file: where it runs, no other test may have an event loop."""
    if why := missing():
        pytest.skip(why)
    with chromium() as found:
        yield found


@pytest.fixture
def page(browser: "Browser") -> "Iterator[Page]":
    """An empty page in which nothing may go wrong."""
    with strict_page(browser) as (opened, faults):
        yield opened
    assert not faults


@pytest.fixture
def watched(browser: "Browser") -> "Iterator[Watched]":
    """A new page without a network, which keeps what goes wrong in it for the test to look at."""
    context = browser.new_context(offline=True)
    yield Watched(context.new_page())
    context.close()
