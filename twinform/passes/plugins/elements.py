"""XML elements of plugins and sensors, in `<gazebo>` and in other untyped content."""

from typing import Any

from lxml import etree

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Element, Opaque, Plugin, Sensor
from twinform.passes.carriers.carriers import to_element
from twinform.schemas import Context, element_xml, reader, table

_NAMES = frozenset({"name", "filename"})


def plugin_of(element: Element) -> Plugin:
    """The plugin that an element stands for."""
    others = tuple(Opaque(attribute=each) for each in element.attributes if each[0] not in _NAMES)
    return Plugin(
        name=element.get("name"),
        filename=element.get("filename"),
        text=element.text,
        content=element.children,
        opaque=others,
        source=element.source,
    )


def plugin_element(plugin: Plugin) -> Element:
    """The element that stands for a plugin; the elements in it keep their places."""
    written = [
        (name, value) for name, value in (("name", plugin.name), ("filename", plugin.filename)) if value is not None
    ]
    others = [part.attribute for part in plugin.opaque if part.attribute]
    inside = tuple(part.element for part in plugin.opaque if part.element)
    return Element(
        name="plugin",
        attributes=(*written, *others),
        text=plugin.text,
        children=(*plugin.content, *inside),
        source=plugin.source,
    )


def sensor_of(element: Element) -> Sensor | None:
    """The sensor that an element stands for; None where it has an error, which the check of the file reports."""
    found = DiagnosticSink(file=element.source.file if element.source else "")
    context = Context(found, found.file, "sdf", table("sdf").newest, declared=False)
    xml = element_xml(element, etree.Element("link", {"name": ""}))
    data: dict[str, Any] = reader("sdf", context.version).read(xml, context, "sensor", Sensor, element.source)
    return None if found.has_errors else Sensor.unchecked(**data)


def sensor_element(sensor: Sensor) -> Element:
    """The element that stands for a sensor."""
    return to_element(sensor, "sensor", "sdf").copy(source=sensor.source)
