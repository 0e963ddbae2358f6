"""Writes a document in the terms of SDF as the elements of MJCF: which part of it, and the sections in their order."""

from dataclasses import replace
from functools import reduce
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.ir import Document, Element, Format, Model, Opaque, World
from twinform.ir.frames import FrameError
from twinform.passes.carriers.annotations import has_mixed_words, source_version, without_provenance
from twinform.passes.carriers.carriers import Keeper
from twinform.passes.carriers.old_names import source_name
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.legalise.to_mjcf.actuator_efforts import settle_efforts
from twinform.passes.legalise.to_mjcf.bodies import body_elements
from twinform.passes.legalise.to_mjcf.contacts import add_contacts
from twinform.passes.legalise.to_mjcf.dangling_parts import drop_dangling_parts
from twinform.passes.legalise.to_mjcf.elements import make_element
from twinform.passes.legalise.to_mjcf.equalities import add_equalities
from twinform.passes.legalise.to_mjcf.file_models import is_named_by_file
from twinform.passes.legalise.to_mjcf.kept_mjcf import NO_SECTION, SECTIONS, SINGLE, merged
from twinform.passes.legalise.to_mjcf.kept_sections import add_kept_sections
from twinform.passes.legalise.to_mjcf.lights import world_lights
from twinform.passes.legalise.to_mjcf.made_names import keep_names_read_otherwise, remove_made_names
from twinform.passes.legalise.to_mjcf.mimics import add_gearboxes, add_mimics
from twinform.passes.legalise.to_mjcf.options import add_options
from twinform.passes.legalise.to_mjcf.sites import world_sites
from twinform.passes.legalise.to_mjcf.texts import add_texts
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.passes.shared.replaced_shapes import FOLDER, ShapeReplacer

_COMPILER = make_element(
    "compiler",
    [
        ("angle", "radian"),
        # Whether a joint is limited stands beside its range, where an edit sees it.
        ("autolimits", "false"),
        # A link without mass has none: MuJoCo would compute one of its shapes.
        ("inertiafromgeom", "false"),
    ],
)
_LACKS = frozenset({"cone", "polyline", "image"})
"""The kinds of shapes for which a mesh stands, where there can be one."""


class WriteMjcf(AssetPass):
    """Write a model, or the models of a world, as the elements of MJCF.

    Changes: the document becomes one of MJCF: 1. angles are in radians, orientations are quaternions, and there are no
    classes of defaults; 2. a link without mass has no inertial, and none is computed of its shapes; 3. what MJCF cannot
    say is in the ledger, and with `carriers` in texts of the `custom` section.
    Never touches: what is of MJCF already.
    Diagnostics: `massless-link`, `joint-type-unsupported`, `nested-too-deeply`, `moving-plane`, `unreadable-mesh`.
    """

    name: ClassVar[str] = "write-mjcf"
    carriers: bool = True
    source_version: str | None = None
    """The version of SDF that the source had; without it, the newest."""
    mixed: bool = False
    """Whether the SDF has syntax of newer versions, which goes back into it."""
    shape_error: float | None = None
    side_files: bool = True
    mesh_folder: str = FOLDER

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document in the terms of MJCF; unchanged after an error."""
        if sink.has_errors or document.format is Format.MJCF:
            return document
        if not self.carriers:
            _drop_what_was_carried(sink)
        before = source_version(document, Format.SDF)  # of a URDF that was SDF once
        mixed = self.mixed or (before is not None and has_mixed_words(document))
        if before is not None:
            document = document.copy(models=tuple(map(without_provenance, document.models)))
        holder = holder_of(document)
        keeper = Keeper(sink, self.carriers)
        # MuJoCo looks meshes up by their paths, so that these have no prefix.
        replacer = ShapeReplacer(
            keeper, "MJCF", _LACKS.__contains__, self.shape_error, None, self.side_files, self.mesh_folder
        )
        context = MjcfContext(
            document, holder, sink, keeper, replacer, self._assets, self.source_version, mixed, before
        )
        try:
            _write_sections(context)
        except FrameError as error:
            error.report(sink)
            return document
        parts = [] if is_named_by_file(context) else [Opaque.unchecked(attribute=("model", source_name(holder)))]
        parts += [Opaque.unchecked(element=each) for each in _in_order(context)]
        return Document.unchecked(format=Format.MJCF, opaque=tuple(parts), source=document.source)


def _drop_what_was_carried(sink: DiagnosticSink) -> None:
    """Enter into the ledger that what earlier passes put into carriers is not written."""
    entries = [replace(each, fate=Fate.DROPPED) if each.fate is Fate.CARRIED else each for each in sink.entries]
    sink.entries[:] = entries


def holder_of(document: Document) -> Model | World:
    """What is written of a document: its world, or its model; several models without a world stand in one."""
    if document.worlds:
        return document.worlds[0]
    if len(document.models) == 1:
        return document.models[0]
    return World.unchecked(name="world", models=document.models, lights=document.lights, source=document.source)


def _write_sections(context: MjcfContext) -> None:
    """Fill all sections of a context. Those that name bodies, joints and geoms come after these have their names."""
    add_options(context)
    bodies = body_elements(context)
    for each in (*world_lights(context), *world_sites(context), *bodies):
        context.add("worldbody", each)
    add_mimics(context)
    add_gearboxes(context)
    add_equalities(context)
    add_contacts(context)
    if add_kept_sections(context):
        drop_dangling_parts(context)
    settle_efforts(context)
    keep_names_read_otherwise(context)
    add_texts(context)
    remove_made_names(context)


def _in_order(context: MjcfContext) -> list[Element]:
    """The sections that have anything, in their order."""
    found = [reduce(merged, [_COMPILER, *context.sections.get("compiler", ())])]
    for name in SECTIONS:
        elements = context.sections.get(name, [])
        if elements:
            found.append(reduce(merged, elements) if name in SINGLE else make_element(name, (), elements))
        elif name == "worldbody":
            found.append(make_element(name))
    return [*found, *context.sections.get(NO_SECTION, ())]
