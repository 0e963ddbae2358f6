"""Gazebo Classic plugins that measure at a link, when it is lumped into another."""

from collections.abc import Mapping

from twinform.ir import Element, Pose
from twinform.ir.frames import FrameGraph
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform
from twinform.schemas import format_value

# The parameters that libsdformat rewrites when it lumps a link (parser_urdf.cc,
# ReduceSDFExtensionPluginFrameReplace).
_BODIES = ("bodyName", "frameName")
_OFFSETS = ("xyzOffset", "rpyOffset")


def moved_plugin(plugin: Element, hosts: Mapping[str, str], graph: FrameGraph) -> Element:
    """The plugin at the same place of another body: `xyzOffset` (m) and `rpyOffset` (rad) are from that body's frame.

    The plugin is moved once, also where both of them name the link.
    """
    named = next((child.text for child in plugin.children if child.name in _BODIES and child.text in hosts), None)
    if named is None:
        return plugin
    # parser_urdf.cc, ReduceSDFExtensionPluginFrameReplace: libsdformat rewrites these two parameters and
    # their offsets, and no others.
    host = hosts[named]
    offset = Pose(xyz=_numbers(plugin.find("xyzOffset")), rpy=_numbers(plugin.find("rpyOffset")))
    at = graph.pose(named, host).compose(Transform.from_pose(offset))
    kept = tuple(
        child.copy(text=host) if child.name in _BODIES and child.text == named else child
        for child in plugin.children
        if child.name not in _OFFSETS
    )
    texts = (" ".join(map(format_value, at.translation)), " ".join(map(format_value, at.rpy())))
    made = tuple(Element(name=name, text=text) for name, text in zip(_OFFSETS, texts, strict=True))
    return plugin.copy(children=(*kept, *made))


def _numbers(element: Element | None) -> Vector3 | None:
    try:
        x, y, z = map(float, (element.text or "").split()) if element is not None else (0.0, 0.0, 0.0)
    except ValueError:
        return None
    return x, y, z
