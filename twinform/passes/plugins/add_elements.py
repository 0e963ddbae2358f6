"""Adding plugins and sensors to models and worlds, in URDF and SDF."""

from twinform.ir import Element, Format, GazeboExtension, Link, Model, Plugin, Sensor, World, replace_fields
from twinform.passes.plugins.elements import plugin_element, sensor_element


def add_plugin(model: Model, plugin: Plugin, format_: Format) -> Model:
    """The model with one more plugin, after those that it has; itself, if it has the same already."""
    if format_ is Format.SDF:
        return model if plugin in model.plugins else model.copy(plugins=(*model.plugins, plugin))
    return _extended(model, GazeboExtension(content=(plugin_element(plugin),)))


def add_visual_plugin(model: Model, on: str, plugin: Plugin, format_: Format) -> Model | None:
    """The model with a plugin on the visual `on`, or on all visuals of the link `on`; None where there is neither.

    In URDF all visuals of a link share what `<gazebo>` sets for them.
    """
    if format_ is Format.URDF:
        link = next((link for link in model.links if on == link.name or any(on == v.name for v in link.visuals)), None)
        if link is None:
            return None
        content = (Element(name="visual", children=(plugin_element(plugin),)),)
        return _extended(model, GazeboExtension(reference=link.name, content=content))
    made = replace_fields(model, links=tuple(_with_visual_plugin(link, on, plugin) for link in model.links))
    return None if made is model else made


def _with_visual_plugin(link: Link, on: str, plugin: Plugin) -> Link:
    if on != link.name and all(on != visual.name for visual in link.visuals):
        return link
    visuals = tuple(
        visual.copy(plugins=(*(each for each in visual.plugins if each != plugin), plugin))
        if on in {link.name, visual.name}
        else visual
        for visual in link.visuals
    )
    return link.copy(visuals=visuals)


def add_sensor(model: Model, holder: str, sensor: Sensor, format_: Format, *, kept: bool = False) -> Model:
    """The model with one more sensor on a link or joint of its own; a link where both have the name.

    `kept` requires of a fixed joint of URDF that Gazebo must not lump its links, as the joint would go with its sensor.
    """
    if format_ is Format.URDF:
        keep = (Element(name="preserveFixedJoint", text="true"),) if kept else ()
        return _extended(model, GazeboExtension(reference=holder, content=(*keep, sensor_element(sensor))))
    field = "links" if any(link.name == holder for link in model.links) else "joints"
    nodes = tuple(
        node.copy(sensors=(*node.sensors, sensor)) if node.name == holder else node for node in getattr(model, field)
    )
    return model.copy(**{field: nodes})


def add_world_plugin(world: World, plugin: Plugin) -> World:
    """The world with one more plugin; itself, if it has the same already."""
    return world if plugin in world.plugins else world.copy(plugins=(*world.plugins, plugin))


def _extended(model: Model, extension: GazeboExtension) -> Model:
    """The model with one more `<gazebo>`; itself, if it has the same already."""
    return model if extension in model.extensions else model.copy(extensions=(*model.extensions, extension))
