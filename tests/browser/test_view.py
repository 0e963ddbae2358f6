"""The 3D view in a real browser."""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.sax.saxutils import quoteattr

import pytest

import twinform
from tests.browser.silhouettes import overlap, silhouette
from twinform.compiler import LoadOptions

pytest.importorskip("viser", reason="viser is not installed")

from tests.browser.camera import camera_for, take_picture
from twinform.compiler.graph.graph import shortened
from twinform.view import ViewSubject, read_subject, standalone_page
from twinform.view.viewer import Viewer

from .watched import strict_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

    from twinform.compiler.compare.comparison import Comparison
    from twinform.ir import Vector3

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
FIRST = """<robot name="first">
  <link name="only"><visual><geometry><sphere radius="1"/></geometry></visual></link>
</robot>
"""
"""What is shown before the first test; with shapes, since a robot without them is shown as a skeleton."""
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


def _subject(text: str | bytes | Path) -> ViewSubject:
    source = text.encode() if isinstance(text, str) else text
    subject, _ = read_subject(source, LoadOptions())
    assert subject is not None
    return subject


class Stage(NamedTuple):
    """A viewer, the page on which it shows, and what went wrong there."""

    viewer: Viewer
    page: "Page"
    faults: list[str]

    def settle(self) -> None:
        """Wait until the page has all that was sent; what is replaced before is an error of viser's client."""
        take_picture(self.viewer, camera_for(self.viewer.figures), 16, 16)

    def show(self, *models: str | bytes | Path, comparison: "Comparison | None" = None) -> None:
        """Show models in place of what was shown, with all joints at zero, and the camera where all is seen."""
        self.settle()
        self.viewer.show([_subject(model) for model in models], comparison)
        self.viewer.move(ZERO)
        self.viewer.aim()


@pytest.fixture(scope="module")
def theater(browser: "Browser") -> Iterator[Stage]:
    """One page for all tests: what takes time is the first picture of a page."""
    viewer = Viewer()
    viewer.show([_subject(FIRST)])
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
        drawn = take_picture(viewer, camera, WIDTH, HEIGHT)[:, :, 3] > 0
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
    drawn = take_picture(viewer, camera_for(viewer.figures), WIDTH, HEIGHT)[:, :, 3] > 0
    assert overlap(drawn, expected) > 0.9


def test_a_planted_difference_is_red(stage: Stage) -> None:
    other = ARM.replace('radius="0.05" length="0.5"', 'radius="0.09" length="0.5"')
    comparison = twinform.diff(ARM.encode(), other.encode())
    assert not comparison.same
    stage.show(ARM, other, comparison=comparison)
    viewer, page, _ = stage
    page.get_by_text("Differences", exact=True).click()
    page.get_by_text("in both, and different").wait_for()
    picture = take_picture(viewer, camera_for(viewer.figures), WIDTH, HEIGHT).astype(int)
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


def _hostile() -> str:
    text = ARM
    for name, hostile in HOSTILE.items():
        text = text.replace(f'"{name}"', quoteattr(hostile))
    return text


def test_hostile_names_do_nothing(stage: Stage) -> None:
    stage.show(_hostile())
    viewer, page, _ = stage
    page.get_by_text("Show", exact=True).click()
    layers = ("Link names", "Joint names", "Skeleton", "Joint axes")
    for layer in layers:
        page.get_by_text(layer, exact=True).click()
    page.get_by_text("Tree", exact=True).click()
    for name in HOSTILE.values():
        viewer.select(name)
    viewer.select(HOSTILE["base"])
    page.get_by_text("shapes", exact=True).wait_for()
    page.get_by_text("Show", exact=True).click()
    for layer in layers:
        page.get_by_text(layer, exact=True).click()
    assert page.evaluate("window.hit") is None


def _pixel(stage: Stage, link: str, point: "Vector3") -> tuple[float, float]:
    """Where on the page a point of a link is, for the camera with which pages begin."""
    canvas = stage.page.locator("canvas").first.bounding_box()
    assert canvas is not None
    (figure,) = stage.viewer.figures
    at = camera_for([figure]).pixels([figure.poses[link].apply(point)], int(canvas["width"]), int(canvas["height"]))
    return canvas["x"] + float(at[0][0]), canvas["y"] + float(at[0][1])


def _assert_hover(stage: Stage, link: str, point: "Vector3", expected: str) -> None:
    """The page says what is expected with the mouse over a point of a link, as soon as that is drawn where it is."""
    x, y = _pixel(stage, link, point)
    tip = stage.page.locator("#twinform-tip")
    text = None
    for step in range(30):
        stage.page.mouse.move(x + step % 2, y)
        time.sleep(0.2)
        text = tip.inner_text() if tip.is_visible() else ""
        if text == expected:
            return
    assert text == expected


@pytest.fixture
def roomy(stage: Stage) -> Iterator[Stage]:
    """The page with room for the robot beside the panel."""
    usual = stage.page.viewport_size
    assert usual is not None
    stage.page.set_viewport_size({"width": 1000, "height": 600})
    yield stage
    stage.page.set_viewport_size(usual)


def _begin(stage: Stage, *models: str | bytes | Path) -> None:
    stage.show(*models)
    stage.settle()
    for notice in stage.page.locator(".mantine-Notification-closeButton").all():
        notice.click()


def test_names_are_shown_on_hover(roomy: Stage) -> None:
    _begin(roomy, ARM)
    _assert_hover(roomy, "base", (0.15, -0.15, 0.0), "base")
    _assert_hover(roomy, "upper", (0.0, 0.0, 0.3), "upper\nrevolute joint shoulder")
    roomy.viewer.move({("shoulder", 0): 0.8})
    roomy.settle()
    _assert_hover(roomy, "slider", (0.15, 0.0, 0.0), "slider\nprismatic joint slide")
    roomy.page.mouse.move(5, 5)
    roomy.page.locator("#twinform-tip").wait_for(state="hidden")


def test_what_is_hidden_has_no_name_on_hover_and_marks_have_one(roomy: Stage) -> None:
    _begin(roomy, ARM)
    roomy.page.get_by_text("Show", exact=True).click()
    roomy.page.get_by_text("Visuals", exact=True).click()
    roomy.page.get_by_text("Skeleton", exact=True).click()
    roomy.settle()
    says = "joint shoulder\nrevolute, from base to upper\nfrom -1.5 to 1.5 rad"
    _assert_hover(roomy, "upper", (0.0, 0.0, 0.0), says)
    _assert_hover(roomy, "base", (0.19, -0.19, 0.0), "")
    for layer in ("Visuals", "Skeleton"):
        roomy.page.get_by_text(layer, exact=True).click()


def test_hostile_names_are_text_on_hover_and_in_the_tree(roomy: Stage) -> None:
    _begin(roomy, _hostile())
    _assert_hover(roomy, HOSTILE["base"], (0.15, -0.15, 0.0), HOSTILE["base"])
    says = f"{HOSTILE['upper']}\nrevolute joint {shortened(HOSTILE['shoulder'])}"
    _assert_hover(roomy, HOSTILE["upper"], (0.0, 0.0, 0.3), says)
    roomy.page.get_by_text("Tree", exact=True).click()
    for name in HOSTILE.values():
        row = roomy.page.locator("[data-twinform-link]").filter(has_text=name[:20])
        if row.count():
            row.first.click()
            roomy.page.locator("[aria-current=true]").filter(has_text=name[:20]).wait_for()
    assert roomy.page.evaluate("window.hit") is None


def test_where_the_client_is_another_one_there_are_no_names_and_no_errors(roomy: Stage) -> None:
    _begin(roomy, ARM)
    page, tip = roomy.page, roomy.page.locator("#twinform-tip")
    x, y = _pixel(roomy, "upper", (0.0, 0.0, 0.3))
    page.evaluate("window.own = window.__viserMutable")
    for other in ("{...window.own, scene: {}}", "undefined"):
        page.evaluate(f"window.__viserMutable = {other}")
        page.mouse.move(x, y)
        page.mouse.move(x + 1, y)
        time.sleep(0.3)
        assert not tip.is_visible()
    page.evaluate("window.__viserMutable = window.own")
    _assert_hover(roomy, "upper", (0.0, 0.0, 0.3), "upper\nrevolute joint shoulder")


def test_a_click_in_the_tree_selects_the_link_and_a_selected_link_is_marked_there(stage: Stage) -> None:
    stage.show(ARM)
    viewer, page, _ = stage
    page.get_by_text("Tree", exact=True).click()
    page.get_by_role("button", name="slider", exact=True).click()
    page.get_by_text("slide (prismatic) on upper").wait_for()
    assert page.locator("[aria-current=true]").inner_text() == "slider"
    assert _orange(viewer) > 100
    viewer.select("base")
    page.locator("[aria-current=true]", has_text="base").wait_for()
    assert page.locator("[aria-current=true]").count() == 1
    page.get_by_role("button", name="slider", exact=True).click()  # the same again
    page.locator("[aria-current=true]", has_text="slider").wait_for()


def _orange(viewer: Viewer) -> int:
    picture = take_picture(viewer, camera_for(viewer.figures), WIDTH, HEIGHT).astype(int)
    return int(((picture[:, :, 0] - picture[:, :, 2] > 60) & (picture[:, :, 3] > 0)).sum())


def test_a_link_is_found_by_what_is_typed(stage: Stage) -> None:
    stage.show(ARM)
    page = stage.page
    page.get_by_text("Tree", exact=True).click()
    field = page.locator(".mantine-TextInput-input:visible").last
    for typed, found in (
        ("foll", "follower"),
        ("SLIDE", "slider"),
        ("shoulder", "upper"),
        ("nothing like it", "upper"),
    ):
        field.fill(typed)
        page.locator("[aria-current=true]", has_text=found).wait_for()


def test_a_dragged_part_moves_its_joint_and_its_slider(roomy: Stage) -> None:
    _begin(roomy, ARM)
    (x, y), page = _pixel(roomy, "upper", (0.0, 0.0, 0.3)), roomy.page
    page.keyboard.down("Shift")
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 8):
        page.mouse.move(x + 5 * step, y)
        time.sleep(0.08)
    page.mouse.up()
    page.keyboard.up("Shift")
    (figure,) = roomy.viewer.figures
    _until(lambda: figure.poses["upper"].rpy()[1] > 0.15)
    turned = figure.poses["upper"].rpy()[1]
    _until(lambda: abs(float(page.locator("input[inputmode=decimal]").first.input_value()) - turned) < 0.01)
    assert figure.poses["base"] == figure.kinematics.at_zero["base"]


def test_degrees_limits_poses_and_text_are_one_set_of_positions(stage: Stage) -> None:
    stage.show(ARM)
    viewer, page, _ = stage
    page.get_by_text("Degrees", exact=True).click()
    field = page.locator("input[inputmode=decimal]:visible").first
    page.get_by_text("85.94", exact=True).wait_for()  # 1.5 rad
    field.fill("45")
    field.press("Enter")
    _until(lambda: abs(viewer.figures[0].poses["upper"].rpy()[1] - 0.7854) < 1e-3)
    page.get_by_text("Ignore limits", exact=True).click()
    page.get_by_text("360", exact=True).wait_for()
    page.get_by_text("Positions as text").click()
    text = page.locator("textarea:visible")
    assert json.loads(text.input_value())["shoulder"] == pytest.approx(0.7854, abs=1e-3)
    text.fill('{"shoulder": 1.75, "slide": 0.1, "no such joint": 3}')
    _until(lambda: abs(viewer.figures[0].poses["upper"].rpy()[1] - 1.3916) < 1e-3)  # pi - 1.75: beyond a quarter turn
    _until(lambda: abs(float(field.input_value()) - 100.268) < 0.1)
    page.get_by_role("button", name="Zero").click()
    _until(lambda: viewer.figures[0].poses == viewer.figures[0].kinematics.at_zero)
    page.get_by_role("button", name="Random").click()
    _until(lambda: viewer.figures[0].poses != viewer.figures[0].kinematics.at_zero)
    page.get_by_text("Ignore limits", exact=True).click()
    page.get_by_text("Degrees", exact=True).click()
    page.get_by_text("-1.5", exact=True).wait_for()


def test_added_and_removed_links_have_colors_of_their_own(stage: Stage) -> None:
    box = '<visual><origin xyz="-0.3 -0.3 0"/><geometry><box size="0.2 0.2 0.2"/></geometry></visual>'
    more = f'<link name="more">{box}</link>'
    joint = '<joint name="j" type="fixed"><parent link="base"/><child link="more"/></joint>'
    longer = ARM.replace("</robot>", f"{more}{joint}</robot>")
    for a, b, says, channel in ((ARM, longer, "in B only", 1), (longer, ARM, "in A only", 2)):
        stage.show(a, b, comparison=twinform.diff(a.encode(), b.encode()))
        stage.page.get_by_text("Differences", exact=True).click()
        stage.page.get_by_text(says).wait_for()
        picture = take_picture(stage.viewer, camera_for(stage.viewer.figures), WIDTH, HEIGHT).astype(int)
        of_box = silhouette(
            _without(_scene_with(stage.viewer, "more"), "more"), {}, camera_for(stage.viewer.figures), WIDTH, HEIGHT
        )
        colors = picture[of_box & (picture[:, :, 3] > 0)][:, :3]
        others = [each for each in range(3) if each != channel]
        assert (colors[:, channel] - colors[:, others[0]] > 15).mean() > 0.5, says


def _scene_with(viewer: Viewer, link: str) -> Any:
    return next(figure.scene for figure in viewer.figures if link in figure.poses)


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


TIPS = {"upper\nrevolute joint shoulder", "slider\nprismatic joint slide", "base", "follower\nrevolute joint mimic"}


def _tip_after_a_move(page: "Page") -> str:
    page.mouse.move(291, 200)  # on the robot
    page.mouse.move(292, 200)
    time.sleep(0.2)
    return page.locator("#twinform-tip").inner_text()


def test_a_page_opens_without_a_server(page: "Page", tmp_path: Path) -> None:
    text = standalone_page(twinform.loads(ARM))
    (tmp_path / "arm.html").write_text(text)
    page.context.set_offline(True)
    page.goto((tmp_path / "arm.html").as_uri())
    page.locator("canvas").first.wait_for()
    _until(lambda: _tip_after_a_move(page) in TIPS)


def test_a_missing_mesh_is_a_box_with_a_finding(stage: Stage) -> None:
    text = ARM.replace('<sphere radius="0.08"/>', '<mesh filename="gone.stl"/>')
    stage.show(text)
    viewer, page, _ = stage
    page.get_by_text("Findings", exact=True).click()
    page.get_by_text("not drawn: visual").wait_for()
    assert [link for link, _, _ in viewer.figures[0].problems()] == ["follower"]


@contextmanager
def _killed(process: subprocess.Popen[str]) -> Generator[None]:
    """A test that fails leaves no process behind, and does not wait for one."""
    try:
        yield
    finally:
        process.kill()


def test_a_saved_file_is_shown_again(page: "Page", tmp_path: Path) -> None:
    pytest.importorskip("watchfiles", reason="watchfiles is not installed")
    robot = tmp_path / "arm.urdf"
    robot.write_text(ARM)
    program = [sys.executable, "-m", "twinform", "view", str(robot), "--watch", "--no-open"]
    with (
        subprocess.Popen(program, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as running,
        _killed(running),
    ):
        assert running.stdout is not None
        address = next(word for word in running.stdout.readline().split() if word.startswith("http")).rstrip(";")
        page.goto(address)
        page.get_by_text("shoulder", exact=True).wait_for()
        robot.write_text(ARM.replace("shoulder", "hip"))
        page.get_by_text("hip", exact=True).wait_for()
        robot.write_text("<robot")  # half saved: what could be read last stays, and the page says why
        page.get_by_text("what could be read last is shown").wait_for()
        assert page.get_by_text("hip", exact=True).count()
        robot.write_text(ARM)
        page.get_by_text("what could be read last is shown").wait_for(state="detached")
        running.send_signal(signal.SIGTERM)
        assert running.wait(timeout=20) == 0


def test_what_is_chosen_stays_when_a_file_is_shown_again(stage: Stage) -> None:
    _begin(stage, ARM)
    viewer, page, _ = stage
    viewer.move({("shoulder", 0): 0.5})
    page.get_by_text("Show", exact=True).click()
    page.get_by_text("Joint axes", exact=True).click()
    _until(lambda: any("axes" in name for name in viewer.figures[0].labels))
    before = viewer.figures[0].poses["upper"]
    stage.settle()
    viewer.show([_subject(ARM.replace("0.08", "0.09"))])
    assert viewer.figures[0].poses["upper"] == before
    assert any("axes" in name for name in viewer.figures[0].labels)
    page.get_by_text("Show", exact=True).click()
    page.get_by_text("Joint axes", exact=True).click()
