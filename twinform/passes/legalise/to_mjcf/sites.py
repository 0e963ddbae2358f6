"""Sites of MJCF: the named frames of SDF, each in the body that it moves with."""

from twinform.ir import Element, Frame
from twinform.ir.frames import WORLD
from twinform.ir.transform import Transform
from twinform.passes.legalise.to_mjcf.elements import Value, make_element, placement
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements, with_kept
from twinform.passes.legalise.to_mjcf.materials import with_known_material
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext, ScopedFrame

HIDDEN = 4
"""The group of sites that stand for a frame or sensor: viewers of MuJoCo show the groups 0 to 2 unless told to."""


def body_sites(context: MjcfContext, body: Body) -> list[Element]:
    """The sites for the named frames that move with a link."""
    return [_frame_site(context, each, body.name) for each in context.frames_by_link.get(body.name, ())]


def world_sites(context: MjcfContext) -> list[Element]:
    """The sites for the named frames that stand still in the world."""
    return [_frame_site(context, each, None) for each in context.frames_by_link.get(WORLD, ())]


def _frame_site(context: MjcfContext, scoped: ScopedFrame, link: str | None) -> Element:
    name, frame = scoped
    shape: list[tuple[str, Value]] = []
    if not any(each.name == "site" for each in kept_elements(frame)):
        shape = [("group", HIDDEN)]
    place = context.place(name, link, kind="frame")
    written = context.written_sites[name] = _name(context, name, frame)
    site = make_element("site", [("name", written), *placement(place), *shape], source=frame.source)
    return with_known_material(context, with_kept(site, frame))


def _name(context: MjcfContext, name: str, frame: Frame) -> str:
    """The name that a frame had in its source, unless that is the name of another frame here."""
    wanted = context.wish("site", context.scope_of(name), context.old_name("site", context.scope_of(name), frame))
    taken = context.names.setdefault("site", set())
    if wanted in taken:
        return name
    taken.add(wanted)
    return wanted


def sensor_site(name: str | None, place: Transform) -> Element:
    """A hidden site for a sensor at a place in its body."""
    return make_element("site", [("name", name), *placement(place), ("group", HIDDEN)])
