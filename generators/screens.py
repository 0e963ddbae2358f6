"""Screens to look at, in `out/screens`: README, site, view and a report, at three widths, light and dark."""

import shutil
import subprocess
import sys
from collections.abc import Generator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, Literal

import markdown

from generators.pictures import longer_arm_report, shown_subjects
from testbed.browser import chromium, missing
from testbed.corpus.files import ROOT
from twinform.view import new_viewer

if TYPE_CHECKING:
    from playwright.sync_api import Browser

FOLDER = ROOT / "out" / "screens"
_WIDTHS = (390, 820, 1280)
_HEIGHT = 900
_SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
_VIEW = "view"
_MILLISECONDS = 3000
"""Until all is drawn, in a renderer without a graphics card."""
_SITE = {
    "site": "",
    "site_rule": "reference/rules/missing-limit.html",
    "site_matrix": "reference/who_reads_what/index.html",
    "site_element": "reference/urdf/joint.html",
}
_README = """<!doctype html><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>:root {{ color-scheme: light dark }} body {{ font: 16px/1.5 sans-serif; max-width: 60rem; margin: auto;
padding: 1rem }} img {{ max-width: 100% }} pre {{ overflow: auto }} table {{ display: block; overflow: auto }}</style>{}
"""


def main() -> int:
    """Make every screen, and say which page wrote an error to its console.

    Returns:
        0; 1 where a page wrote an error; 2 where there is no browser.
    """
    if why := missing():
        print(why, file=sys.stderr)
        return 2
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    errors: list[str] = []
    with _site() as site, _view() as view, longer_arm_report() as report, chromium() as browser:
        pages = {"readme": _readme().as_uri(), **{name: site + path for name, path in _SITE.items()}}
        for name, address in {**pages, _VIEW: view, "report": report.as_uri()}.items():
            errors += _take(browser, name, address)
    print(f"{len(list(FOLDER.glob('*.png')))} screens in {FOLDER.relative_to(ROOT)}")
    for error in errors:
        print(error, file=sys.stderr)
    return 1 if errors else 0


def _take(browser: "Browser", name: str, address: str) -> list[str]:
    """Write the screens of a page, and return the errors of its console."""
    errors: list[str] = []
    for scheme in _SCHEMES:
        for width in _WIDTHS:
            page = browser.new_page(viewport={"width": width, "height": _HEIGHT}, color_scheme=scheme)
            page.on("console", lambda said: errors.append(f"{name}: {said.text}") if said.type == "error" else None)
            page.on("pageerror", lambda error: errors.append(f"{name}: {error}"))
            page.goto(address)
            page.wait_for_timeout(_MILLISECONDS)
            if name == _VIEW and scheme == "dark":  # a switch among the settings, whatever the browser prefers
                page.get_by_label("Dark Mode").dispatch_event("click")
                page.wait_for_timeout(_MILLISECONDS)
            page.screenshot(path=FOLDER / f"{name}_{width}_{scheme}.png")
            page.close()
    return errors


def _readme() -> Path:
    """Write the README as a page."""
    text = (ROOT / "README.md").read_text(encoding="utf-8").replace("docs/images/", "../../docs/images/")
    path = FOLDER / "readme.html"
    path.write_text(_README.format(markdown.markdown(text, extensions=["extra"])), encoding="utf-8")
    return path


@contextmanager
def _site() -> Generator[str]:
    """Build the site and serve it until the end of the block, at the address that is returned."""
    subprocess.run(["make", "--no-print-directory", "site"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(ROOT / "out" / "site")))
    Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/"
    finally:
        server.shutdown()


class _Quiet(SimpleHTTPRequestHandler):
    """Serves files and logs nothing."""

    def log_message(self, format: str, *args: object) -> None:
        """Log nothing."""


@contextmanager
def _view() -> Generator[str]:
    """Show a robot until the end of the block, at the address that is returned."""
    viewer = new_viewer()
    try:
        file = "examples/rover.urdf"
        viewer.show(shown_subjects([(ROOT / file).read_text(encoding="utf-8")], [file]), None)
        yield viewer.address
    finally:
        viewer.stop()


if __name__ == "__main__":
    sys.exit(main())
