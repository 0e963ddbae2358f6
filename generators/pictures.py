"""Pictures of `twinform view` and `twinform report` on the examples: what is shown, and what was clicked before."""

import contextlib
import io
import shutil
import sys
import tempfile
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from PIL import Image

import twinform
from generators.before_after import before_after_pages
from testbed.browser import chromium, missing
from testbed.corpus.files import ROOT
from twinform import report
from twinform.compiler import LoadOptions
from twinform.view import ViewSubject, new_viewer, read_subject

if TYPE_CHECKING:
    from playwright.sync_api import Page

    from twinform.view.viewer import Viewer

FOLDER = ROOT / "docs" / "images"
_WIDTH, _HEIGHT = 1200, 720
_REPORT_WIDTH, _REPORT_HEIGHT = 1000, 1220
_COLORS = 192
_MILLISECONDS = 2500
"""Until all is drawn, in a renderer without a graphics card."""


@dataclass(frozen=True, slots=True)
class Picture:
    """The name of a picture, the one or two files on it, where joints are, and what is clicked."""

    name: str
    files: tuple[str, ...]
    clicks: tuple[str, ...] = ()
    joints: tuple[tuple[str, float], ...] = ()
    edit: tuple[str, str] = ("", "")
    """What is another text in the second file."""


_LONGER = ('<origin xyz="0 0 0.27"', '<origin xyz="0 0 0.34"')
PICTURES = (
    Picture("view", ("examples/rover.urdf",), ("Show", "Joint axes", "Sensors")),
    Picture(
        "differences",
        ("examples/arm.urdf", "examples/arm.urdf"),
        ("Differences",),
        (("joint_2", 0.5), ("joint_3", 0.8), ("joint_5", 0.7)),
        _LONGER,
    ),
)


def main() -> int:
    """Make every picture.

    Returns:
        0, or 2 where there is no browser.
    """
    if why := missing():
        print(why, file=sys.stderr)
        return 2
    FOLDER.mkdir(parents=True, exist_ok=True)
    with chromium() as browser:
        for picture in PICTURES:
            viewer, page = new_viewer(), browser.new_page(viewport={"width": _WIDTH, "height": _HEIGHT})
            try:
                _write(FOLDER / f"{picture.name}.png", _taken(picture, viewer, page))
            finally:
                page.close()
                viewer.stop()
            print(f"docs/images/{picture.name}.png")
        for name, text in before_after_pages():
            page = browser.new_page(viewport={"width": _WIDTH, "height": _HEIGHT})
            page.set_content(text)
            _write(FOLDER / f"before_after_{name}.png", page.screenshot(full_page=True))
            print(f"docs/images/before_after_{name}.png")
        page = browser.new_page(viewport={"width": _REPORT_WIDTH, "height": _REPORT_HEIGHT})
        _write(FOLDER / "report.png", _report(page))
        print("docs/images/report.png")
    return 0


def _taken(picture: Picture, viewer: "Viewer", page: "Page") -> bytes:
    texts = [(ROOT / file).read_text(encoding="utf-8") for file in picture.files]
    if any(picture.edit):
        texts[-1] = texts[-1].replace(*picture.edit)
    comparison = twinform.diff(*(text.encode() for text in texts)) if len(texts) > 1 else None
    viewer.show(shown_subjects(texts, picture.files), comparison)
    page.goto(viewer.address)
    page.get_by_text("Joints", exact=True).wait_for()
    for text in picture.clicks:
        page.get_by_text(text, exact=True).first.click()
    viewer.move({(name, 0): value for name, value in picture.joints})
    page.wait_for_timeout(_MILLISECONDS)
    for notice in page.locator("button.mantine-Notification-closeButton").all():
        notice.click()
    page.wait_for_timeout(_MILLISECONDS)
    return page.screenshot()


@contextlib.contextmanager
def longer_arm_report() -> Generator[Path]:
    """A report on two files, until the end of the block."""
    first, second = Path("arm.urdf"), Path("longer_arm.urdf")
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        shutil.copytree(ROOT / "examples", ".", dirs_exist_ok=True)
        second.write_text(first.read_text(encoding="utf-8").replace(*_LONGER), encoding="utf-8")
        path = Path("report.html").resolve()
        path.write_text(report.html(report.build_report(first, second)), encoding="utf-8")
        yield path


def _report(page: "Page") -> bytes:
    """The first screen of a report on two files."""
    with longer_arm_report() as path:
        page.goto(path.as_uri())
        frame = page.frame_locator("iframe")
        frame.locator("canvas").first.wait_for()
        page.wait_for_timeout(2 * _MILLISECONDS)
        for notice in frame.locator("button.mantine-Notification-closeButton").all():
            notice.click()
        page.wait_for_timeout(_MILLISECONDS)
        return page.screenshot()


def shown_subjects(texts: Sequence[str], files: Sequence[str]) -> list[ViewSubject]:
    """Read the texts of files as what a viewer shows."""
    options = LoadOptions()
    named = zip(texts, files, strict=True)
    found = (read_subject(text.encode(), options, name=str(ROOT / file))[0] for text, file in named)
    return [subject for subject in found if subject is not None]


def _write(path: Path, picture: bytes) -> None:
    Image.open(io.BytesIO(picture)).convert("RGB").quantize(_COLORS).save(path, optimize=True)


if __name__ == "__main__":
    sys.exit(main())
