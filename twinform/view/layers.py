"""The layers of a robot: shapes, frames, axes and limits of joints, masses, sensors, names."""

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

from twinform.compiler.graph.graph import shortened
from twinform.ir import Mesh
from twinform.ir.transform import Transform
from twinform.view.figure import Figure, Handle, Rgb, rgb
from twinform.view.marks import centers, inertias, joint_axes, joint_limits, sensors, skeleton

SKELETON = "Skeleton"
_COLLISION: Rgb = (230, 90, 60)
_SEE_THROUGH = 0.35


def _draw_visuals(figure: Figure) -> Iterator[Handle]:
    for link, name, shape in figure.shapes("visual"):
        color = figure.look.color or rgb(shape.color)
        opacity = figure.look.opacity or next(iter((shape.color or ())[3:]), None)  # SDF may leave alpha out
        yield _listen(figure, link, figure.draw(shape, name, color, opacity))


def _draw_collisions(figure: Figure) -> Iterator[Handle]:
    for link, name, shape in figure.shapes("collision"):
        yield _listen(figure, link, figure.draw(shape, name, figure.look.color or _COLLISION, _SEE_THROUGH))


def _listen(figure: Figure, link: str, handle: Handle) -> Handle:
    if figure.listen is not None:
        figure.listen(figure, handle, link)
    return handle


def _draw_link_frames(figure: Figure) -> Iterator[Handle]:
    for link in figure.scene.links:
        yield figure.axes(f"{figure.node_name(link.name)}/frame", Transform(), f"frame of {shortened(link.name)}")


def _draw_named_frames(figure: Figure) -> Iterator[Handle]:
    for number, frame in enumerate(figure.scene.frames):
        lines = f"frame {shortened(frame.name)}", f"on {shortened(frame.link)}"
        yield figure.axes(f"{figure.node_name(frame.link)}/frames/{number}", frame.pose, *lines)


def _draw_mesh_origins(figure: Figure) -> Iterator[Handle]:
    for role in ("visual", "collision"):
        for link, name, shape in figure.shapes(role):
            if isinstance(shape.shape, Mesh):
                lines = f"origin of {shortened(shape.shape.uri or 'a mesh')}", f"{role} of {shortened(link)}"
                yield figure.axes(f"{name}-origin", shape.pose, *lines)


def _write_link_names(figure: Figure) -> Iterator[Handle]:
    for link in figure.scene.links:
        yield figure.api.add_label(f"{figure.node_name(link.name)}/name", shortened(link.name))


def _write_joint_names(figure: Figure) -> Iterator[Handle]:
    for number, joint in enumerate(figure.scene.joints):
        at = figure.from_world(joint.child).apply(joint.frame.translation)
        name = f"{figure.node_name(joint.child)}/joints/{number}"
        yield figure.api.add_label(name, shortened(joint.name), position=at)


class Layer(NamedTuple):
    """A layer: its label, whether it is shown at first, and the function that draws it."""

    label: str
    shown: bool
    draw: Callable[[Figure], Iterable[Handle]]


LAYERS: tuple[Layer, ...] = (
    Layer("Visuals", shown=True, draw=_draw_visuals),
    Layer("Collisions", shown=False, draw=_draw_collisions),
    Layer(SKELETON, shown=False, draw=skeleton),
    Layer("Link frames", shown=False, draw=_draw_link_frames),
    Layer("Named frames", shown=False, draw=_draw_named_frames),
    Layer("Joint axes", shown=False, draw=joint_axes),
    Layer("Joint limits", shown=False, draw=joint_limits),
    Layer("Inertias", shown=False, draw=inertias),
    Layer("Centers of mass", shown=False, draw=centers),
    Layer("Sensors", shown=False, draw=sensors),
    Layer("Mesh origins", shown=False, draw=_draw_mesh_origins),
    Layer("Link names", shown=False, draw=_write_link_names),
    Layer("Joint names", shown=False, draw=_write_joint_names),
)
