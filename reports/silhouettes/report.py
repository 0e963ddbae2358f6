"""Ten robots in the 3D view of a real browser, read from URDF and from SDF: silhouettes, and pictures for the docs."""

import random
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from PIL import Image

import twinform
from reports.harness.browser import chromium, missing
from reports.harness.needs import corpus
from reports.harness.pages import section, table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample
from reports.silhouettes.projecting import Mask, overlap, silhouette
from tests.corpus.files import CORPUS, ROOT
from twinform.compiler import LoadOptions
from twinform.compiler.scene import Positions, Scene
from twinform.ir import Format
from twinform.view import Subject, new_viewer, read_subject
from twinform.view.camera import Camera
from twinform.view.joint_controls import slider_range
from twinform.view.viewer import Viewer, camera_for

if TYPE_CHECKING:
    from playwright.sync_api import Page

WIDTH, HEIGHT = 480, 360
PICTURES = ROOT / "docs" / "images" / "robots"
SAMPLES = 3
"""Joint positions: all at zero, and others by chance."""
_PROJECTED, _SAME = 0.9, 0.98
"""How much of the two silhouettes has to be the same: of the drawn and the projected one, and of both formats."""
_WHITE = (255, 255, 255, 255)
_ABOUT = f"""\
Each robot is shown by `twinform view` in headless Chromium, from its own file and from what `twinform convert` makes of
it in the other format, at {SAMPLES} joint positions: all at zero, and two that are drawn by chance within the limits.
The pixels that the browser draws are compared with those that the shapes must cover, which are projected from the frame
graph by a few lines of code that know nothing of the view (`reports/silhouettes/projecting.py`), and those of both
formats with each other. *Intersection over union* is 1 for the same pixels; the least of all positions counts, and it
has to be at least {_PROJECTED} for the first, {_SAME} for the second. All visuals of these files are primitive shapes,
since the corpus has no meshes."""


@dataclass(frozen=True, slots=True)
class Overlaps:
    """The least intersection over union of a robot: of each format with its projection, and of both."""

    name: str
    file: str
    urdf: float
    sdf: float
    both: float


def measure(sample: Sample) -> Findings:
    """Draw every robot."""
    del sample
    rows: list[Overlaps] = []
    robots: dict[str, str] = tomllib.loads(Path(__file__).with_name("robots.toml").read_text(encoding="utf-8"))
    viewer = new_viewer()
    try:
        with chromium() as browser:
            page = browser.new_page(viewport={"width": 1000, "height": 700})
            rows = [_drawn(viewer, page, name, file) for name, file in robots.items()]
    finally:
        viewer.stop()
    faults = [f"{row.name}: {row}" for row in rows if min(row.urdf, row.sdf) < _PROJECTED or row.both < _SAME]
    cells = [(row.name, f"{row.urdf:.3f}", f"{row.sdf:.3f}", f"{row.both:.3f}") for row in rows]
    totals = table(("robot", "URDF and projection", "SDF and projection", "URDF and SDF"), cells)
    return Findings(
        [totals, section("Pictures", "URDF to the left, SDF to the right.", *_pictures(rows))], totals, faults
    )


def _pictures(rows: Sequence[Overlaps]) -> Iterator[str]:
    for row in rows:
        yield f"![{row.name} from URDF and from SDF](../images/robots/{row.name}.png)\n\n`{row.file}`"


def _drawn(viewer: Viewer, page: "Page", name: str, file: str) -> Overlaps:
    """The overlaps of a robot; its picture is written."""
    subjects = _in_both(CORPUS / file)
    camera: Camera | None = None
    least: dict[Format, list[float]] = {format: [] for format in Format}
    masks: dict[Format, list[Mask]] = {format: [] for format in Format}
    pictures: dict[Format, Image.Image] = {}
    positions = _positions(subjects[Format.SDF].scene, subjects[Format.URDF].scene)
    for format, subject in subjects.items():
        viewer.show([subject])
        page.goto(viewer.address)
        page.get_by_text("Joints", exact=True).wait_for()
        camera = camera or camera_for(viewer.figures)
        for each in positions:
            viewer.move(each)
            picture = viewer.picture(camera, WIDTH, HEIGHT)
            mask = picture[:, :, 3] > 0
            masks[format].append(mask)
            least[format].append(overlap(mask, silhouette(subject.scene, each, camera, WIDTH, HEIGHT)))
            pictures[format] = Image.fromarray(picture)
    _write(name, [pictures[Format.URDF], pictures[Format.SDF]])
    both = min(overlap(a, b) for a, b in zip(masks[Format.URDF], masks[Format.SDF], strict=True))
    return Overlaps(name, file, min(least[Format.URDF]), min(least[Format.SDF]), both)


def _in_both(path: Path) -> dict[Format, Subject]:
    """A file in its own format, and in the other one."""
    document = twinform.load(path)
    other = Format.SDF if document.format is Format.URDF else Format.URDF
    converted = twinform.convert(path, to=other.value).text.encode()
    found: dict[Format, Subject] = {}
    for source in (path, converted):
        subject, loaded = read_subject(source, LoadOptions())
        if subject is None:
            raise AssertionError(loaded.diagnostics)
        found[subject.document.format] = subject
    return found


def _positions(one: Scene, other: Scene) -> list[Positions]:
    """Joint positions that both scenes have: for a joint of several degrees of freedom in one of them, zero."""
    random_ = random.Random(1)
    counts = {joint.name: len(joint.degrees) for joint in other.joints}
    moving = [joint for joint in one.joints if len(joint.degrees) == counts.get(joint.name) == 1]
    zero = {(joint.name, 0): 0.0 for joint in moving}
    chosen = [
        {(joint.name, 0): random_.uniform(*slider_range(joint.degrees[0])) for joint in moving}
        for _ in range(SAMPLES - 1)
    ]
    return [*chosen, zero]  # pictures are made of the last one


def _write(name: str, pictures: Sequence[Image.Image]) -> None:
    """Write pictures beside each other, on white."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    whole = Image.new("RGBA", (WIDTH * len(pictures), HEIGHT), _WHITE)
    for number, each in enumerate(pictures):
        whole.alpha_composite(each.convert("RGBA"), (WIDTH * number, 0))
    colors = whole.convert("RGB").quantize(64)
    colors.save(PICTURES / f"{name}.png", optimize=True)


REPORT = Report("silhouettes", "The 3D view and the frame graph", _ABOUT, measure, needs=(corpus, missing))
