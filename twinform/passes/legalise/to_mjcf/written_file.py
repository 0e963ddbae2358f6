"""Finds what a file of MJCF has of a node: its geom, the assets of that, and the elements that a sensor became.

The nodes are those of the flattened model, with scoped names.
"""

from collections import defaultdict
from collections.abc import Mapping
from functools import cached_property

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Collision, Element, Format, Frame, Joint, Light, Link, Model, Node, Sensor, Visual, World
from twinform.ir.frames import FrameGraph
from twinform.passes.carriers.annotations import came_from
from twinform.passes.carriers.mjcf_texts import Tagged, tagged
from twinform.passes.legalise.joint_notation import ExpressAxes, ResolveJointEnds
from twinform.passes.legalise.nested_models import flat_model
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext, safe_name, without_gearboxes
from twinform.passes.legalise.to_urdf_pass import UrdfKeeper

Shape = Visual | Collision
_WITH_FILES = frozenset({"mesh", "hfield"})
"""The kinds of assets of shapes, and the attributes of geoms that name them."""
_SHOWN = frozenset({"camera", "light"})
"""Elements in bodies that sensors and lights become."""


class WrittenFile:
    """The elements of one file, whose other sections than `custom` are complete.

    Attributes:
        part: the link, joint or frame that is looked at; shapes are those of this link.
        was_urdf: whether the model was a URDF once.
        is_back: whether the source is a URDF.
    """

    def __init__(self, context: MjcfContext) -> None:
        self.context = context
        self.sections = context.sections
        self.part: Node = context.holder
        self.was_urdf = isinstance(context.holder, Model) and came_from(context.holder, Format.URDF)
        self.is_back = self.was_urdf and context.source_version is None

    @cached_property
    def flat(self) -> Model:
        """The model, or the world as one, flattened, with joints between links and axes in their frames.

        Annotations say how it was. What these passes account for is nothing that MJCF lacks.
        """
        holder = self.context.holder
        if isinstance(holder, World):
            model = Model.unchecked(
                name=holder.name, models=holder.models, joints=holder.joints, frames=holder.frames, source=holder.source
            )
        else:
            model = holder
        keeper = UrdfKeeper(DiagnosticSink(), carriers=True)
        if model.models:
            model = flat_model(model, keeper)
        for step in (ResolveJointEnds.unchecked(), ExpressAxes.unchecked()):
            model = step.run_model(model, keeper)
        return model

    @cached_property
    def graph(self) -> FrameGraph:
        """The frames of the flattened model, which are those of the tree where nothing had to be rewritten."""
        is_as_it_was = self.flat is without_gearboxes(self.context.holder)
        return self.context.tree.frames if is_as_it_was else FrameGraph(self.flat)

    @cached_property
    def closing(self) -> frozenset[str]:
        """The joints that close loops."""
        return frozenset(each.name for each in self.context.closing)

    @cached_property
    def hidden(self) -> frozenset[str]:
        """The links between joints of one body, which are no bodies."""
        return frozenset(each.name for each in self.flat.links if each.name not in self.context.written_bodies)

    def geom_name(self, shape: Shape) -> str | None:
        """The name of the geom of a shape of the link that is looked at; None where it has none."""
        return self._geom_names.get((type(shape), self.part.name if isinstance(self.part, Link) else "", shape.name))

    def geom(self, shape: Shape) -> Element | None:
        """The geom of a shape of the link that is looked at."""
        return self._geoms.get(self.geom_name(shape) or "")

    def other_names(self, node: Node) -> tuple[str, ...]:
        """The names of what stands for a link, joint, frame or shape, where they are not its own name alone."""
        context = self.context
        match node:
            case Visual() | Collision():
                name = self.geom_name(node) or node.name
                names = (safe_name(name) if name else "",)  # as the geom is called once it is read
            case Link():
                names = (context.written_bodies.get(node.name, node.name),)
            case Joint():
                names = context.written_joints.get(node.name) or (node.name,)
                # of the two joints of a screw only the one that turns counts for others
                if node.type == "screw" and node.name in context.written_slides:
                    names = (context.written_slides[node.name], *names)
            case Frame():
                names = (context.written_sites.get(node.name, node.name),)
            case Sensor() if (read := context.kept_sensors.get(id(node.source))) is not None:
                names = (read.name,)
            case _:
                return ()
        return () if names == (node.name,) else names

    def has_site(self, frame: Frame) -> bool:
        """Whether there is a site of the name of a frame."""
        return frame.name in self.context.names.get("site", ())

    def asset(self, tag: str, name: str | None) -> list[Tagged]:
        """The asset of a name, such as a mesh or a material, with the elements in it."""
        found = self.asset_element(tag, name)
        return [] if found is None else tagged(found.walk())

    def asset_element(self, tag: str, name: str | None) -> Element | None:
        """The asset of a name."""
        return self._assets.get((tag, name))

    def file_of(self, geom: Element) -> str | None:
        """The file of the mesh or height field of a geom."""
        assets = (self._assets.get(each) for each in geom.attributes if each[0] in _WITH_FILES)
        return next((each.get("file") for each in assets if each is not None), None)

    def parts_of(self, part: Sensor | Light) -> list[Element]:
        """The elements that a sensor or light has become: readings, and then cameras, lights and sites."""
        readings = self._readings.get(id(part.source), [])
        sites = {each.get("site") or each.get("objname") for each in readings}
        places = [
            *self._shown.get(id(part.source), ()),
            *(place for name in sites if name is not None for place in self._sites.get(name, ())),
        ]
        return [*readings, *(self._in_bodies[place] for place in sorted(places))]

    @cached_property
    def _geom_names(self) -> Mapping[tuple[type[Shape], str, str | None], str]:
        """The names of geoms by the scoped name of the link, and the class and name of the shape."""
        names = self.context.written_geoms
        return {
            (type(each), link, each.name): names[id(each)]
            for link, node in self.context.tree.links.items()
            for each in (*node.visuals, *node.collisions)
            if id(each) in names
        }

    @cached_property
    def _geoms(self) -> dict[str, Element]:
        return {each.get("name") or "": each for each in self._in_bodies if each.name == "geom"}

    @cached_property
    def _in_bodies(self) -> list[Element]:
        """All elements of the world and its bodies."""
        return [each for body in self.sections.get("worldbody", ()) for each in body.walk()]

    @cached_property
    def _assets(self) -> dict[tuple[str, str | None], Element]:
        return {(each.name, each.get("name")): each for each in reversed(self.sections.get("asset", ()))}

    @cached_property
    def _readings(self) -> dict[int, list[Element]]:
        """The elements of the `sensor` section by the identity of what they were made from."""
        found: dict[int, list[Element]] = defaultdict(list)
        for each in self.sections.get("sensor", ()):
            found[id(each.source)].append(each)
        return found

    @cached_property
    def _shown(self) -> dict[int, list[int]]:
        """The places of cameras and lights in the bodies by the identity of what they were made from."""
        found: dict[int, list[int]] = defaultdict(list)
        for place, each in enumerate(self._in_bodies):
            if each.name in _SHOWN:
                found[id(each.source)].append(place)
        return found

    @cached_property
    def _sites(self) -> dict[str | None, list[int]]:
        """The places of sites in the bodies by their names."""
        found: dict[str | None, list[int]] = defaultdict(list)
        for place, each in enumerate(self._in_bodies):
            if each.name == "site":
                found[each.get("name")].append(place)
        return found
