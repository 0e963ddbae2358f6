"""Reports in a browser: they open from disk without a network, keys reach everything, and names do nothing."""

import io
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from PIL import Image

from tests.unit.report.models import EVIL, EXAMPLES, hostile, stand_in
from twinform.report import build_report, html
from twinform.report.content import View, make_page

from .watched import Watched, violations

if TYPE_CHECKING:
    from playwright.sync_api import Page

_ENOUGH = 300
_CASES = Path(__file__).parents[1] / "cases/check"
_FOCUSED = """async () => { await new Promise(done => setTimeout(done, 50));
  const e = document.activeElement, s = getComputedStyle(e);
  return [e.tagName, e.textContent.slice(0, 40), s.outlineStyle] }"""
"""The focus a moment after a key: into a frame, which is a process of its own, it does not go at once."""


def _open(watched: Watched, folder: Path, *inputs: Path | bytes, view: View | None = stand_in) -> "Page":
    text = html(build_report(inputs[0], inputs[1] if len(inputs) > 1 else None, view=view))
    (folder / "report.html").write_text(text, encoding="utf-8")
    return watched.open(folder / "report.html")


def test_the_view_runs_in_its_frame_under_the_policy_of_the_report(watched: Watched, tmp_path: Path) -> None:
    watched.page.set_viewport_size({"width": 500, "height": 500})
    page = _open(watched, tmp_path, EXAMPLES / "rover.urdf", view=make_page)
    frame = page.locator("iframe").element_handle().content_frame()
    assert frame is not None
    frame.wait_for_selector("canvas", timeout=20_000)
    deadline, orange = time.monotonic() + 20, 0
    while orange < _ENOUGH and time.monotonic() < deadline:
        page.wait_for_timeout(200)
        orange = _orange(page.locator("iframe").screenshot())
    assert orange >= _ENOUGH
    assert (watched.complaints, watched.outside) == ([], [])


def _orange(picture: bytes) -> int:
    """How many pixels of the middle have the color of the rover's chassis; a message has it too, at the left."""
    pixels = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"), dtype=int)[:, 100:]
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return int(((red > green + 40) & (green > blue + 20)).sum())


def test_hostile_names_do_nothing(watched: Watched, tmp_path: Path) -> None:
    page = _open(watched, tmp_path, hostile().encode(), hostile(mass=2).encode())
    for button in page.locator("thead button").all():
        button.click()
    assert (watched.complaints, watched.outside) == ([], [])
    assert page.title() == f"{EVIL} (A) compared with {EVIL} (B): report"
    assert page.locator("script").count() == 1


def test_a_script_that_a_name_would_be_is_refused_by_the_policy(watched: Watched, tmp_path: Path) -> None:
    """The second line: if escaping failed."""
    text = html(build_report(EXAMPLES / "gripper.urdf", view=stand_in))
    bad = "<script>alert(1)</script><img src=x onerror=alert(2)><img src=http://example.org/x>"
    (tmp_path / "report.html").write_text(text.replace("<main", f"{bad}<main", 1), encoding="utf-8")
    watched.open(tmp_path / "report.html")
    assert not [each for each in watched.complaints if each.startswith("dialog")]
    assert len([each for each in watched.complaints if "Content Security Policy" in each]) >= 3


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing(watched: Watched, tmp_path: Path, scheme: str) -> None:
    watched.page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    page = _open(watched, tmp_path, _CASES / "all_at_once.urdf", EXAMPLES / "arm.urdf", view=None)
    page.evaluate("() => document.querySelectorAll('details').forEach(each => each.open = true)")
    assert violations(page) == []
    page = _open(watched, tmp_path, EXAMPLES / "rover.urdf", EXAMPLES / "sensor_base.urdf", view=None)
    assert violations(page) == []


def test_the_keyboard_reaches_everything_and_shows_where_it_is(watched: Watched, tmp_path: Path) -> None:
    page = _open(watched, tmp_path, EXAMPLES / "rover.urdf")
    wanted = page.locator("a, button, summary, [tabindex='0'], iframe").count()
    seen: list[list[str]] = []
    for _ in range(wanted + 5):
        page.keyboard.press("Tab")
        seen.append(page.evaluate(_FOCUSED))
    tags = [tag for tag, _, _ in seen]
    assert seen[0][1] == "Skip to the content"
    assert tags.count("BUTTON") == page.locator("thead button").count()
    assert tags.count("SUMMARY") == page.locator("summary:visible").count()
    assert "IFRAME" in tags
    assert all(outline != "none" for tag, _, outline in seen if tag in {"A", "BUTTON", "SUMMARY"})


def test_enter_folds_the_tree_and_sorts_tables(watched: Watched, tmp_path: Path) -> None:
    page = _open(watched, tmp_path, EXAMPLES / "rover.urdf", view=None)
    leaf = page.locator(".tree li", has_text="imu_link").last
    assert leaf.is_visible()
    page.locator(".tree summary").first.focus()
    page.keyboard.press("Enter")
    assert not leaf.is_visible()
    button = page.locator("#masses thead button", has_text="Mass (kg)")
    names = "() => [...document.querySelectorAll('#masses tbody tr')].map(row => row.cells[0].textContent)"
    button.focus()
    page.keyboard.press("Enter")
    falling = page.evaluate(names)
    assert falling[0] == "base_link"
    assert page.locator("#masses [aria-sort='descending']").count() == 1
    page.keyboard.press("Enter")
    rising = page.evaluate(names)
    assert rising[0] == "imu_link"
    assert set(rising[-2:]) == set(falling[-2:]) == {"base_footprint", "camera_optical_frame"}, "without a number: last"


def test_nothing_is_wider_than_a_narrow_screen(watched: Watched, tmp_path: Path) -> None:
    watched.page.set_viewport_size({"width": 360, "height": 700})
    page = _open(watched, tmp_path, _CASES / "all_at_once.urdf", EXAMPLES / "rover.urdf")
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360


def test_tables_scroll_on_a_narrow_screen_and_break_no_words(watched: Watched, tmp_path: Path) -> None:
    watched.page.set_viewport_size({"width": 390, "height": 700})
    page = _open(watched, tmp_path, EXAMPLES / "arm.urdf", EXAMPLES / "rover.urdf", view=None)
    table = page.locator("#differences .scroller").first
    assert table.evaluate("each => each.scrollWidth > each.clientWidth")
    highest = table.evaluate("each => Math.max(...[...each.querySelectorAll('tr')].map(row => row.offsetHeight))")
    assert highest < 150, "a sentence takes a few lines, and not one for each syllable"


def test_names_are_readable_on_a_narrow_screen(watched: Watched, tmp_path: Path) -> None:
    watched.page.set_viewport_size({"width": 360, "height": 700})
    page = _open(watched, tmp_path, EXAMPLES / "rover.urdf")
    lines = page.evaluate(
        "() => [...document.querySelectorAll('#masses tbody th, #reach tbody th')]"
        ".map(each => { const range = document.createRange(); range.selectNodeContents(each);"
        " return new Set([...range.getClientRects()].map(box => box.top)).size })"
    )
    assert lines
    assert max(lines) <= 2
    page.locator("#masses .scroller").evaluate("each => each.scrollLeft = 400")
    box = page.locator("#masses tbody th").first.bounding_box()
    assert box
    assert box["x"] >= 0, "the names stay where the numbers scroll"


def test_a_badge_in_the_tree_leads_to_its_finding_though_it_is_folded(watched: Watched, tmp_path: Path) -> None:
    page = _open(watched, tmp_path, EXAMPLES / "four_wheels.urdf", view=None)
    finding = page.locator("#note-a0")
    assert not finding.is_visible()
    page.locator(".tree a.badge").first.click()
    assert finding.is_visible()


def test_it_can_be_printed(watched: Watched, tmp_path: Path) -> None:
    page = _open(watched, tmp_path, EXAMPLES / "rover.urdf")
    page.emulate_media(media="print")
    assert page.locator("iframe").is_hidden()
    assert page.locator("#masses table").is_visible()
