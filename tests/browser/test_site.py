"""The documentation site: it builds without a warning, links lead somewhere, and nobody else is asked for anything."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache, partial
from html.parser import HTMLParser
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING
from urllib.parse import unquote, urlsplit

import pytest

from .watched import Watched, violations

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

_ROOT = Path(__file__).parents[2]
_LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src"}
_QUESTIONS = 10


class _Links(HTMLParser):
    """The links, anchors and loaded files of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.loaded: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what a tag leads to."""
        found = {name: value for name, value in attrs if value is not None}
        self.anchors |= {found[name] for name in ("id", "name") if name in found}
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
        if tag == "link" and found.get("rel") in {"stylesheet", "icon"}:
            self.loaded.append(found["href"])
        if tag in _LOADED and _LOADED[tag] in found:
            self.loaded.append(found[_LOADED[tag]])


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site, built in a process of its own."""
    pytest.importorskip("mkdocs", reason="mkdocs is not installed")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)]
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    done = subprocess.run(command, cwd=_ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "WARNING" not in done.stderr
    return folder


@cache
def _links(page: Path) -> _Links:
    return _Links(page.read_text(encoding="utf-8"))


def _pages(site: Path) -> Iterator[Path]:
    return (page for page in site.rglob("*.html") if page.name != "404.html")


def _target(page: Path, link: str) -> tuple[Path, str]:
    parts = urlsplit(link)
    return (page.parent / unquote(parts.path)).resolve() if parts.path else page, unquote(parts.fragment)


def test_every_link_leads_somewhere(site: Path) -> None:
    pages = list(_pages(site))
    assert len(pages) > 80
    wrong: list[str] = []
    for page in pages:
        for link in _links(page).links:
            if re.match(r"(https?|mailto):", link):
                continue
            target, anchor = _target(page, link)
            if target.is_dir():
                target /= "index.html"
            is_there = target.exists() and (not anchor or target.suffix != ".html" or anchor in _links(target).anchors)
            wrong += [] if is_there else [f"{page.relative_to(site)}: {link}"]
    assert wrong == []


def test_nothing_is_loaded_from_elsewhere(site: Path) -> None:
    loaded = {each for page in _pages(site) for each in _links(page).loaded}
    assert loaded
    assert [each for each in loaded if re.match(r"(https?:)?//", each)] == []


def test_ten_questions_are_answered_within_two_clicks(site: Path) -> None:
    """The first click leads to a page with a short answer to each, the second to pages that say more."""
    start = site / "index.html"
    first = {_target(start, link)[0] for link in _links(start).links}
    questions = site / "start" / "questions.html"
    assert questions in first
    text = (_ROOT / "docs/start/questions.md").read_text(encoding="utf-8")
    _, *answers = re.split(r"^## ", text, flags=re.MULTILINE)
    assert [answer.split(".")[0] for answer in answers] == [str(number) for number in range(1, _QUESTIONS + 1)]
    second = {_target(questions, link)[0] for link in _links(questions).links}
    for answer in answers:
        question, _, said = answer.partition("\n")
        assert question.endswith("?")
        assert "```" in said, question
        further = re.findall(r"\[[^\]]+\]\(([^)]+)\.md\)", said)
        assert further, question
        assert [page for page in further if (questions.parent / f"{page}.html").resolve() not in second] == []


@pytest.fixture(params=["disk", "server"])
def address(request: pytest.FixtureRequest, site: Path) -> Iterator[str]:
    """Where the site is: on the disk, where browsers allow no workers, or on a server of this machine."""
    if request.param == "disk":
        yield site.as_uri()
        return
    handler = partial(_Silent, directory=str(site))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


class _Silent(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: object) -> None:
        """Say nothing."""


_ANSWERS = {
    "mimic": "reference/rules/mimic-cycle.html",
    "unknown-element": "reference/rules/unknown-element.html",
    "KinematicTree": "reference/api.html",
    "--ledger": "how-to/see-what-was-lost.html",
    "gz::sim::systems::Imu": "reference/plugins.html",
    "convert xacro": "how-to/xacro.html",
    "exit code": "reference/exit-codes.html",
}
"""What people look for, and a page that the search has to find for it."""


_FOUND = """answer => [...document.querySelectorAll('.md-search-result__link')]
  .some(link => link.href.replace(/\\?h=[^#]*/, '').startsWith(answer))"""


def test_the_search_finds_what_people_look_for(address: str, page: "Page") -> None:
    page.goto(f"{address}/index.html")
    page.keyboard.press("/")
    for query, answer in _ANSWERS.items():
        page.keyboard.press("Control+a")
        page.keyboard.type(query)
        page.wait_for_function(_FOUND, arg=f"{address}/{answer}")


_LOOKED_AT = (
    "index",
    "start/install",
    "how-to/xacro",
    "tutorial/standard-robot",
    "reference/commands",
    "reference/urdf/joint",
    "reference/rules/dangling-link",
    "reference/profiles/drake",
    "reference/who_reads_what/index",
    "evidence/speed",
)
"""A page of each kind."""


_WIDTHS = (390, 820, 1280)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pages_can_be_read_by_everybody(site: Path, watched: Watched, scheme: str) -> None:
    watched.page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    watched.page.set_viewport_size({"width": _WIDTHS[-1], "height": 900})
    for name in _LOOKED_AT:
        page = watched.open(site / f"{name}.html")
        page.locator("h1").wait_for()
        assert violations(page) == [], name
        assert page.locator("th:visible:empty").count() == 0, name
        for width in _WIDTHS:  # the widest is the last: what moves as it grows, moves before the next page
            page.set_viewport_size({"width": width, "height": 900})
            page.wait_for_function("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    assert watched.complaints == []


@pytest.fixture
def matrix(site: Path, page: "Page") -> "Page":
    """The matrix of features, from the disk."""
    page.goto(f"{site.as_uri()}/reference/who_reads_what/index.html")
    return page


_ROWS = "() => [...document.querySelectorAll('#matrix tbody tr')].filter(row => row.checkVisibility()).length"


def test_the_matrix_is_filtered_by_words_format_verdict_and_program(matrix: "Page") -> None:
    every = matrix.evaluate(_ROWS)
    assert every > 100
    matrix.get_by_label("Words").fill("mimic")
    assert 0 < matrix.evaluate(_ROWS) < every
    assert matrix.get_by_role("status").inner_text() == f"{matrix.evaluate(_ROWS)} of {every} features"
    matrix.get_by_label("Format").select_option("SDF")
    assert matrix.evaluate(_ROWS) == 1
    matrix.get_by_label("Words").fill("")
    matrix.get_by_label("Some program").select_option("refuses")
    refused = matrix.evaluate(_ROWS)
    matrix.get_by_text("Programs", exact=True).click()
    matrix.get_by_role("button", name="None").click()
    assert matrix.evaluate(_ROWS) == 0
    matrix.get_by_role("checkbox", name="Drake").first.check()
    assert 0 < matrix.evaluate(_ROWS) <= refused
    again = matrix.evaluate(_ROWS)
    matrix.reload()
    assert matrix.evaluate(_ROWS) == again, "the choice stands in the address"


def test_a_feature_of_the_matrix_leads_to_its_file(matrix: "Page") -> None:
    matrix.get_by_role("link", name="A joint that follows another", exact=True).click()
    assert matrix.url.endswith("/joints.html#mimic")
    assert matrix.locator("#mimic ~ .highlight code").first.inner_text().startswith("<robot")


def test_the_matrix_is_whole_without_its_script(site: Path, browser: "Browser") -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(f"{site.as_uri()}/reference/who_reads_what/index.html")
    assert page.locator("#matrix tbody tr").count() > 100
    assert page.locator("#matrix-filter").count() == 0
    context.close()
