"""The 3D view in a real browser."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.sax.saxutils import quoteattr

import pytest

import twinform
from reports.silhouettes.projecting import overlap, silhouette
from twinform.compiler import LoadOptions

pytest.importorskip("viser", reason="viser is not installed")

from twinform.view import Subject, read_subject, standalone_page
from twinform.view.viewer import Viewer, camera_for

from .watched import strict_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

    from twinform.compiler.compare.comparison import Comparison

WIDTH, HEIGHT = 480, 360
ARM = """<robot name="arm">
  <link name="base"><visual><geometry><box size="0.4 0.4 0.1"/></geometry></visual></link>
  <link name="upper"><visual><origin xyz="0 0 0.25"/><geometry><cylinder radius="0.05" length="0.5"/></geometry>
  </visual></link>
  <link name="slider"><visual><origin xyz="0.15 0 0"/><geometry><box size="0.3 0.06 0.06"/></geometry></visual></link>
  <link name="follower"><visual><geometry><sphere radius="0.08"/></geometry></visual></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.05"/>
    <axis xyz="0 1 0"/><limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="slider"/><origin xyz="0 0 0.5"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="0.2" effort="1" velocity="1"/></joint>
  <joint name="mimic" type="revolute"><parent link="slider"/><child link="follower"/><origin xyz="0.35 0 0"/>
    <axis xyz="0 1 0"/><limit lower="-1.5" upper="1.5" effort="1" velocity="1"/>
    <mimic joint="shoulder" multiplier="-1"/></joint>
</robot>
"""
NOTHING = '<robot name="nothing"><link name="only"/></robot>'
BALLS = """<sdf version="1.11"><model name="balls">
  <link name="a"><visual name="v"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual></link>
  <link name="b"><pose>0 0 0.5 0 0 0</pose>
    <visual name="v"><geometry><capsule><radius>0.05</radius><length>0.4</length></capsule></geometry></visual></link>
  <link name="c"><pose>0 0 1 0 0 0</pose>
    <visual name="v"><geometry><cone><radius>0.1</radius><length>0.3</length></cone></geometry></visual></link>
  <joint name="ball" type="ball"><parent>a</parent><child>b</child><pose>0 0 -0.25 0 0 0</pose></joint>
  <joint name="two" type="universal"><parent>b</parent><child>c</child><pose>0 0 -0.25 0 0 0</pose>
    <axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>
</model></sdf>
"""
PLANAR = """<robot name="planar">
  <link name="floor"><visual><geometry><box size="0.2 0.2 0.02"/></geometry></visual></link>
  <link name="puck"><visual><geometry><box size="0.3 0.1 0.1"/></geometry></visual></link>
  <joint name="drift" type="planar"><parent link="floor"/><child link="puck"/><origin xyz="0 0 0.1"/>
    <axis xyz="0 0 1"/></joint>
</robot>
"""
_FRAMES_A_SECOND = """() => new Promise(done => {
  let count = 0;
  const start = performance.now();
  const step = () => {
    count += 1;
    const seconds = (performance.now() - start) / 1000;
    seconds > 1 ? done(count / seconds) : requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
})"""
POSITIONS: dict[str, tuple[dict[tuple[str, int], float], ...]] = {
    ARM: ({}, {("shoulder", 0): 1.0, ("slide", 0): 0.1}, {("shoulder", 0): -0.7, ("slide", 0): 0.2}),
    BALLS: ({}, {("ball", 0): 0.5, ("ball", 1): -0.4, ("two", 1): 0.6}, {("ball", 2): 1.0, ("two", 0): -0.8}),
    PLANAR: ({}, {("drift", 0): 0.3, ("drift", 2): 0.8}, {("drift", 1): -0.4}),
}
ZERO = {key: 0.0 for moves in POSITIONS.values() for moved in moves for key in moved}


def _subject(text: str | bytes | Path) -> Subject:
    source = text.encode() if isinstance(text, str) else text
    subject, _ = read_subject(source, LoadOptions())
    assert subject is not None
    return subject


class Stage(NamedTuple):
    """A viewer, the page on which it shows, and what went wrong there."""

    viewer: Viewer
    page: "Page"
    faults: list[str]

    def show(self, *models: str | bytes | Path, comparison: "Comparison | None" = None) -> None:
        """Show models in place of what was shown, with all joints at zero."""
        self.viewer.show([_subject(model) for model in models], comparison)
        self.viewer.move(ZERO)


@pytest.fixture(scope="module")
def theater(browser: "Browser") -> Iterator[Stage]:
    """One page for all tests: what takes time is the first picture of a page."""
    viewer = Viewer()
    viewer.show([_subject(NOTHING)])
    with strict_page(browser) as (page, faults):
        page.goto(viewer.address)
        page.get_by_text("Joints", exact=True).wait_for()
        yield Stage(viewer, page, faults)
    viewer.stop()


@pytest.fixture
def stage(theater: Stage) -> Iterator[Stage]:
    """The page for one test, in which nothing may go wrong."""
    yield theater
    faults = [*theater.faults]
    theater.faults.clear()
    assert not faults


def _until(happened: Callable[[], bool]) -> None:
    end = time.monotonic() + 30
    while not happened():
        assert time.monotonic() < end
        time.sleep(0.05)


@pytest.mark.parametrize("text", POSITIONS, ids=["arm", "balls", "planar"])
def test_pixels_are_where_the_silhouette_is(stage: Stage, text: str) -> None:
    stage.show(text)
    viewer, (figure,) = stage.viewer, stage.viewer.figures
    camera = camera_for([figure])
    positions: dict[tuple[str, int], float] = {}
    for moved in POSITIONS[text]:
        positions |= moved
        viewer.move(moved)
        drawn = viewer.picture(camera, WIDTH, HEIGHT)[:, :, 3] > 0
        expected = silhouette(figure.scene, positions, camera, WIDTH, HEIGHT)
        assert overlap(drawn, expected) > 0.9, positions


def test_a_slider_moves_its_link(stage: Stage) -> None:
    stage.show(ARM)
    viewer, page, _ = stage
    before = dict(viewer.figures[0].poses)
    page.get_by_text("shoulder", exact=True).wait_for()
    field = page.locator("input[type=text], input[inputmode=decimal]").first
    field.fill("1")
    field.press("Enter")
    _until(lambda: viewer.figures[0].poses["upper"] != before["upper"])
    poses = viewer.figures[0].poses
    assert poses["upper"].rpy() == pytest.approx((0, 1, 0), abs=0.01)
    assert poses["follower"].rpy() == pytest.approx((0, 0, 0), abs=0.01)  # it turns back what the shoulder turns
    assert poses["base"] == before["base"]
    expected = silhouette(viewer.figures[0].scene, {("shoulder", 0): 1.0}, camera_for(viewer.figures), WIDTH, HEIGHT)
    drawn = viewer.picture(camera_for(viewer.figures), WIDTH, HEIGHT)[:, :, 3] > 0
    assert overlap(drawn, expected) > 0.9


def test_a_planted_difference_is_red(stage: Stage) -> None:
    other = ARM.replace('radius="0.05" length="0.5"', 'radius="0.09" length="0.5"')
    comparison = twinform.diff(ARM.encode(), other.encode())
    assert not comparison.same
    stage.show(ARM, other, comparison=comparison)
    viewer, page, _ = stage
    page.get_by_text("Differences", exact=True).click()
    page.get_by_text("what differs is red").wait_for()
    picture = viewer.picture(camera_for(viewer.figures), WIDTH, HEIGHT).astype(int)
    red = (picture[:, :, 0] - picture[:, :, 1] > 60) & (picture[:, :, 0] - picture[:, :, 2] > 60)
    only_upper = silhouette(_without(viewer.figures[1].scene, "upper"), {}, camera_for(viewer.figures), WIDTH, HEIGHT)
    assert red.sum() > 200
    assert (red & ~only_upper).sum() < 0.1 * red.sum()


def _without(scene: Any, kept: str) -> Any:
    from dataclasses import replace  # noqa: PLC0415 - a helper of one test

    return replace(scene, links=tuple(link for link in scene.links if link.name == kept))


HOSTILE = {
    "base": "<script>window.hit=1</script>",
    "upper": "<img src=x onerror=window.hit=1>",
    "slider": "a'\"`${}\\</div></table>",
    "follower": "x" * 1_000,
    "shoulder": "\u202e\u00e9\u4e2d/../..",
}


def test_hostile_names_do_nothing(stage: Stage) -> None:
    text = ARM
    for name, hostile in HOSTILE.items():
        text = text.replace(f'"{name}"', quoteattr(hostile))
    stage.show(text)
    viewer, page, _ = stage
    page.get_by_text("Show", exact=True).click()
    for layer in ("Link names", "Joint names", "Skeleton", "Joint axes"):
        page.get_by_text(layer, exact=True).click()
    page.get_by_text("Tree", exact=True).click()
    for name in HOSTILE.values():
        viewer.select(name)
    viewer.select(HOSTILE["base"])
    page.get_by_text("shapes", exact=True).wait_for()
    assert page.evaluate("window.hit") is None


def test_a_thousand_links_are_drawn_smoothly(stage: Stage) -> None:
    links = "".join(
        f'<link name="l{i}"><visual><geometry><box size="0.08 0.08 0.08"/></geometry></visual></link>'
        for i in range(1000)
    )
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="l0"/><child link="l{i}"/>'
        f'<origin xyz="{0.1 * (i % 32):.2f} {0.1 * (i // 32):.2f} 0"/></joint>'
        for i in range(1, 1000)
    )
    stage.show(f'<robot name="many">{links}{joints}</robot>')
    # a renderer without a graphics card takes some seconds before the first frames
    _until(lambda: stage.page.evaluate(_FRAMES_A_SECOND) > 20)


def test_a_page_opens_without_a_server(page: "Page", tmp_path: Path) -> None:
    text = standalone_page(twinform.loads(ARM))
    (tmp_path / "arm.html").write_text(text)
    page.context.set_offline(True)
    page.goto((tmp_path / "arm.html").as_uri())
    page.locator("canvas").first.wait_for()


def test_a_missing_mesh_is_a_box_with_a_finding(stage: Stage) -> None:
    text = ARM.replace('<sphere radius="0.08"/>', '<mesh filename="gone.stl"/>')
    stage.show(text)
    viewer, page, _ = stage
    page.get_by_text("Findings", exact=True).click()
    page.get_by_text("not drawn: visual").wait_for()
    assert [link for link, _, _ in viewer.figures[0].problems()] == ["follower"]


def test_a_saved_file_is_shown_again(page: "Page", tmp_path: Path) -> None:
    pytest.importorskip("watchfiles", reason="watchfiles is not installed")
    robot = tmp_path / "arm.urdf"
    robot.write_text(ARM)
    program = [sys.executable, "-m", "twinform", "view", str(robot), "--watch", "--no-open"]
    with subprocess.Popen(program, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as running:
        assert running.stdout is not None
        address = next(word for word in running.stdout.readline().split() if word.startswith("http")).rstrip(";")
        page.goto(address)
        page.get_by_text("shoulder", exact=True).wait_for()
        robot.write_text(ARM.replace("shoulder", "hip"))
        page.get_by_text("hip", exact=True).wait_for()
        robot.write_text("<robot")  # half saved: what could be read last stays
        time.sleep(1.5)
        assert page.get_by_text("hip", exact=True).count()
        running.send_signal(signal.SIGINT)
        assert running.wait(timeout=20) == 0
