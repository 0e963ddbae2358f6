"""From canonical MJCF to a document in the terms of SDF.

A file with nothing but one tree of bodies is a model, as are robots in libraries; lights and cameras may stand beside
it. Any other file is a world: it has shapes that belong to no body, such as a floor, or several trees. Each tree of a
world is a model of its own, and the shapes of the world itself are a static model. The only tree of a file has the name
of the file, and of several each has that of its first body. Carriers may say otherwise: see `model_trees.py`.
"""

from collections.abc import Iterable
from pathlib import Path

from twinform.compiler.input.load_options import LoadOptions, unexpanded_name
from twinform.compiler.input.mjcf.assets import AssetTable
from twinform.compiler.input.mjcf.contact_masks import ContactMasks, touches_itself
from twinform.compiler.input.mjcf.geom_solids import GeomSolids
from twinform.compiler.input.mjcf.lower_bodies import JOINTS, TreeLowering, TreeParts
from twinform.compiler.input.mjcf.lower_equalities import followers, loop_of, lower_loop, places_beside_tree
from twinform.compiler.input.mjcf.lower_geoms import GeomLowering
from twinform.compiler.input.mjcf.lower_inertials import MassSettings, body_inertia, scale_of
from twinform.compiler.input.mjcf.lower_lights import lower_light
from twinform.compiler.input.mjcf.lower_option import lower_option
from twinform.compiler.input.mjcf.lower_sensors import SiteSensor, by_site, lower_sensor
from twinform.compiler.input.mjcf.model_trees import ModelTrees, WrittenModels
from twinform.compiler.input.mjcf.names import NameScope, name_mark
from twinform.compiler.input.mjcf.pieces import Piece, pose_of
from twinform.compiler.input.mjcf.remainders import RemainderKeeper, in_sections, with_rest
from twinform.compiler.input.mjcf.sections import Owners, Sections
from twinform.compiler.resolve_uris import LocalAssets
from twinform.ir import Document, Element, Format, Frame, Joint, Light, Link, Model, World
from twinform.ir.frames import WORLD
from twinform.passes.carriers.annotations import MADE_NAME, WORLDBODY, annotation, with_annotation
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX, ROOT
from twinform.passes.legalise.to_mjcf.actuator_efforts import Actuator, efforts
from twinform.passes.legalise.to_mjcf.file_models import UNNAMED_MODEL
from twinform.passes.legalise.to_mjcf.kept_mjcf import KNOWN
from twinform.passes.legalise.to_mjcf.writing_context import safe_name
from twinform.passes.shared.mesh_solids import Meshes
from twinform.passes.shared.nodes import reserve_name
from twinform.schemas import DEFAULT_SDF_VERSION, Context, XmlElement

_MARK = Element.unchecked(name=ROOT)
"""What says that a model or world was read of MJCF, so that it is written as MJCF has it."""
_NAMED = frozenset({"body", "site", *JOINTS})
"""What becomes a link, frame or joint."""


def lower(
    root: XmlElement,
    context: Context,
    load_options: LoadOptions,
    file: XmlElement,
    written: WrittenModels = WrittenModels(),  # noqa: B008 - it never changes
) -> Document:
    """Build the document of a canonical tree, which was made of the tree of a file with such models."""
    return FileLowering(Piece(root, context.file), context, load_options, file, written).document()


class FileLowering:
    """Lowers one file; what is left of its sections goes to the model that it is about, or to the world."""

    def __init__(
        self, root: Piece, context: Context, load_options: LoadOptions, file: XmlElement, written: WrittenModels
    ) -> None:
        self.root = root
        self.in_world = written.in_world
        self.sections = Sections(root)
        self.keeper = RemainderKeeper(context.sink, file)
        trees = [each for each in self.sections.inside(WORLDBODY) if each.tag == "body"]
        self.models = written.grouped(trees)
        self.owners = Owners([each.trees for each in self.models], self.sections)
        self.assets = AssetTable(self.sections.of("asset"))
        settings = MassSettings.of(self.sections.of("compiler"))
        meshes = Meshes(LocalAssets(load_options.search, Path(unexpanded_name(context.file))))
        by_bounds = any(each.peek("fitaabb") == "true" for each in self.sections.of("compiler"))
        solids = GeomSolids(self.assets, meshes, context.sink, by_bounds=by_bounds)
        masks = ContactMasks.of(each for each in root.walk() if each.tag == "geom")
        self.geoms = GeomLowering(self.assets, masks, self.keeper, solids)
        bodies = [each for tree in trees for each in tree.bodies()]
        self.inertias = {each: body_inertia(each, settings, solids) for each in bodies}
        self.scale = scale_of(settings, [each.solid.mass for each in self.inertias.values()])
        parts = (each.peek("name") for each in root.walk() if each.tag in _NAMED)
        self.written_names = frozenset(each for each in parts if each)
        self.followers = followers(self.sections.inside("equality"))
        self.efforts = efforts(Actuator(each.tag, each.peek) for each in self.sections.inside("actuator"))
        self.numbers: dict[str, int] = {}
        self.sensors: dict[int | None, list[SiteSensor]] = {}
        for found in by_site(self.sections.inside("sensor")):
            self.sensors.setdefault(self.owners.of_part("site", found.site), []).append(found)

    @property
    def is_world(self) -> bool:
        """Whether the file is a world and not a model; without bodies it is one."""
        if self.in_world is not None and self.models:
            return self.in_world
        return len(self.models) != 1 or self._has_ground

    @property
    def _has_ground(self) -> bool:
        """Whether there are shapes that belong to the world itself."""
        return any(each.tag == "geom" for each in self.sections.inside(WORLDBODY))

    def document(self) -> Document:
        """Build the document."""
        name = self.root.take("model")
        taken = {each.name for each in self.models if each.name is not None}
        if self._has_ground:
            taken.add(WORLDBODY)
        models = [self._model(number, each, name, taken) for number, each in enumerate(self.models)]
        models = [with_rest(each, in_sections(self._left_of(number))) for number, each in enumerate(models)]
        if not self.is_world:
            return self._in_sdf(models=(*models, *self._ground()))
        return self._in_sdf(worlds=(self._world(name, models),))

    def _in_sdf(self, models: tuple[Model, ...] = (), worlds: tuple[World, ...] = ()) -> Document:
        return Document.unchecked(
            format=Format.SDF,
            version=DEFAULT_SDF_VERSION,
            namespaces=((PREFIX, NAMESPACE),),
            models=models,
            worlds=worlds,
            source=self.root.source,
        )

    def _model(self, number: int, found: ModelTrees, file_name: str | None, taken: set[str]) -> Model:
        first, names = found.trees[0], NameScope(self.written_names)
        lowering = TreeLowering(
            found.trees,
            found.at,
            self.geoms,
            self.keeper,
            self.inertias,
            self.scale,
            self.followers,
            self.efforts,
            names,
        )
        parts = lowering.lower()
        self._close_loops(number, lowering, parts)
        self._add_sensors(number, parts)
        is_of_file = len(self.models) == 1 or not self.is_world
        name = found.name or (file_name if is_of_file else first.name)
        given = found.name or reserve_name(safe_name(name or UNNAMED_MODEL), taken, self.numbers)
        is_static = lowering.is_static
        return Model.unchecked(
            name=given,
            pose=pose_of(first.transform() if found.at is None else found.at, source=first.source),
            static=True if is_static else None,
            self_collide=None if is_static else touches_itself(parts.masks),
            links=tuple(parts.links),
            joints=tuple(parts.joints),
            frames=tuple(parts.frames),
            opaque=name_mark(name, given),
            source=first.source,
        )

    def _close_loops(self, number: int, lowering: TreeLowering, parts: TreeParts) -> None:
        found: list[tuple[Piece, Joint]] = []
        for piece in self.owners.about(number, "equality"):
            if piece.is_settled or lowering.mocap & {piece.peek("body1"), piece.peek("body2")}:
                continue
            unnamed = f"{piece.peek('body1')}_{piece.peek('body2')}_{piece.tag}"
            loop = loop_of(piece, piece.name or unnamed, parts.links_of)
            if loop is not None:
                found.append((piece, loop))
        for place in places_beside_tree((loop for _, loop in found), parts.joints):
            piece, loop = found[place]
            joint = lower_loop(piece, loop, self.keeper)
            made = lowering.names.make(safe_name(loop.name))
            parts.joints.append(joint.copy(name=made, opaque=(*name_mark(piece.name, made), *joint.opaque)))

    def _add_sensors(self, number: int, parts: TreeParts) -> None:
        """Put the sensors at the sites of a model on its links and joints."""
        sensors = [each for each in self.sensors.get(number, ()) if each.site in parts.sites]
        if not sensors:
            return
        links = {each.name: index for index, each in enumerate(parts.links)}
        above: dict[str | None, int] = {}
        for index, each in enumerate(parts.joints):
            above.setdefault(each.child, index)
        for each in sensors:
            if not any(piece.is_settled for piece in each.pieces):
                link, frame = parts.sites[each.site]
                self._add_sensor(each, frame, parts, links[link], above.get(link))

    def _add_sensor(self, found: SiteSensor, frame: str, parts: TreeParts, index: int, above: int | None) -> None:
        """Put a sensor on a link, or on the joint above it; both are known by their places."""
        link, name = parts.links[index], f"{safe_name(found.site)}_{found.type}"
        if found.type == "force_torque" and above is None:
            return
        sensor = lower_sensor(found, name, frame, link, self.keeper)
        if sensor is None:
            return
        if found.type != "force_torque" or above is None:
            parts.links[index] = link.copy(sensors=(*link.sensors, sensor))
        else:
            joint = parts.joints[above]
            parts.joints[above] = joint.copy(sensors=(*joint.sensors, sensor))

    def _left_of(self, number: int) -> dict[str, list[Element]]:
        """Return what no node says of the sections and is about one model alone, once all have been lowered.

        What is about none or several belongs to the world, or else to the first model.
        """
        left = {} if number and not self.is_world else {ROOT: [_MARK]}
        for tag in self.sections.tags:
            if tag not in KNOWN or tag in {WORLDBODY, "asset", "compiler", "option", "default"}:
                continue
            for piece in self.owners.about(number, tag):
                if not piece.is_settled:
                    left.setdefault(tag, []).append(self._rest(piece, tag))
        if not self.is_world and number == 0:
            for tag, elements in self._left(self._scene()).items():
                left.setdefault(tag, []).extend(elements)
        return left

    def _rest(self, piece: Piece, section: str) -> Element:
        """Return what is left of an element of a section: all of it, or the attributes that nobody took."""
        return self.keeper.rest_element(piece) if piece.taken else self.keeper.whole(piece, section)

    def _left(self, scene: list[Element]) -> dict[str, list[Element]]:
        """Return what no node says of all sections, and is about no model or several."""
        left: dict[str, list[Element]] = {WORLDBODY: scene} if scene else {}
        self.geoms.solids.keep_what_is_fitted_to()
        for section in self.sections.all:
            if section.tag == WORLDBODY:
                section.is_settled = True
                continue
            if section.tag not in KNOWN:
                left.setdefault(section.tag, []).append(self.keeper.whole(section))
                continue
            own = self.keeper.rest_element(section, with_inside=False)
            if own.attributes:
                left.setdefault(section.tag, []).append(own)
            for piece in section.inside:
                element = self._left_of_piece(piece, section.tag)
                if element is not None:
                    left.setdefault(section.tag, []).append(element)
        attributes = self.keeper.rest_element(self.root, with_inside=False).attributes
        left[ROOT] = [_MARK.copy(attributes=attributes)]
        return left

    def _left_of_piece(self, piece: Piece, section: str) -> Element | None:
        if piece.is_settled:
            return None
        if section == "asset" and piece.taken:
            element = self.keeper.rest_element(piece)
            is_more = element.children or len(element.attributes) > (piece.name is not None)
            return element if is_more else None
        return self._rest(piece, section)

    def _scene(self) -> list[Element]:
        """Return what a model has no place for: lights, cameras and sites of the world around it."""
        return [
            self.keeper.whole(each, why="a model has no place for what is around it")
            for each in self.sections.inside(WORLDBODY)
            if each.tag not in {"body", "geom"}
        ]

    def _world(self, name: str | None, models: list[Model]) -> World:
        settings = lower_option(self.sections.of("option"))
        lights: list[Light] = []
        for number, piece in enumerate(each for each in self.sections.inside(WORLDBODY) if each.tag == "light"):
            light = lower_light(piece, piece.name or f"light{number or ''}", self.keeper)
            if light is not None:
                lights.append(light if piece.name else with_annotation(light, MADE_NAME, light.name))
        ground = self._ground()
        frames = tuple(self._frames({each.name or "" for each in (*ground, *models, *lights)}))
        left = [
            self.keeper.whole(each, why="a world of SDF has no place for it")
            for each in self.sections.inside(WORLDBODY)
            if each.tag != "body" and not each.is_settled
        ]
        given = safe_name(name or UNNAMED_MODEL)
        rest = in_sections(self._left(left))
        return World.unchecked(
            name=given,
            gravity=settings.gravity,
            models=(*ground, *models),
            lights=tuple(lights),
            frames=frames,
            opaque=(*name_mark(name, given), *settings.opaque, *rest),
            source=self.root.source,
        )

    def _frames(self, taken: set[str]) -> Iterable[Frame]:
        """Yield the sites of the world, called otherwise than what else is in it and than the world itself."""
        taken |= {WORLD}
        for site in self.sections.inside(WORLDBODY):
            if site.tag == "site" and site.name is not None:
                name = site.take("name") or ""
                pose = pose_of(site.transform(), source=site.source)
                rest = self.keeper.rest(site, is_marked=True)
                given = reserve_name(safe_name(name), taken)
                marks = name_mark(name, given)
                yield Frame.unchecked(name=given, pose=pose, opaque=(*marks, *rest), source=site.source)

    def _ground(self) -> tuple[Model, ...]:
        """Return the static model with the shapes of the world itself, if it has any."""
        bodies = [each for each in self.sections.of(WORLDBODY) if each.find("geom") is not None]
        if not bodies:
            return ()
        shapes = [self.geoms.lower(each, WORLDBODY) for each in bodies]
        link = Link.unchecked(
            name=WORLDBODY,
            visuals=tuple(visual for each in shapes for visual in each.visuals),
            collisions=tuple(collision for each in shapes for collision in each.collisions),
            opaque=tuple(part for each in shapes for part in each.rest),
            source=bodies[0].source,
        )
        mark = (annotation(MADE_NAME, WORLDBODY),)
        model = Model.unchecked(name=WORLDBODY, static=True, links=(link,), opaque=mark, source=bodies[0].source)
        return (with_rest(model, in_sections({ROOT: [_MARK]})),)  # taken out of its world, it is still of MJCF
