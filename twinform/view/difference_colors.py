"""Which links two robots differ in, and in what color they are shown."""

from collections.abc import Iterator, Mapping, Sequence

from twinform.compiler.compare.comparison import Comparison, Difference
from twinform.compiler.scene import Scene
from twinform.view.figure import Rgb
from twinform.view.subject import ViewSubject

CHANGED: Rgb = (220, 40, 40)
ONLY_A: Rgb = (150, 50, 200)
ONLY_B: Rgb = (20, 150, 60)
MEANINGS: Mapping[str, Rgb] = {"in both, and different": CHANGED, "in A only": ONLY_A, "in B only": ONLY_B}


def difference_colors(comparison: Comparison, subjects: Sequence[ViewSubject]) -> dict[str, Rgb]:
    """The colors of links that differ."""
    first, second = (subject.links for subject in subjects)
    found: dict[str, Rgb] = {}
    for link in (link for each in comparison.counted for link in links_of(each, subjects)):
        found[link] = CHANGED if link in first and link in second else ONLY_A if link in first else ONLY_B
    return found


def links_of(difference: Difference, subjects: Sequence[ViewSubject]) -> tuple[str, ...]:
    """The links that a difference is seen on."""
    found = (link for subject in subjects for link in _seen_on(difference, subject.scene))
    return tuple(dict.fromkeys(found))


def _seen_on(difference: Difference, scene: Scene) -> Iterator[str]:
    """In scenes of several models, names have the model's before them."""
    model = difference.model.rpartition("::")[2]
    names = {difference.name, f"{model}::{difference.name}"}
    joints, frames = difference.group == "joint", difference.group == "frame"
    if not joints:
        yield from (link.name for link in scene.links if link.name in names)
    if joints:
        yield from (joint.child for joint in scene.joints if joint.name in names)
    if frames:
        yield from (frame.link for frame in scene.frames if frame.name in names)
