"""Replace the meshes of visuals by ones with fewer triangles, within a distance; levels of detail."""

from typing import ClassVar, Self, cast

from pydantic import Field, model_validator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import CHANGED_MESH, KEPT_MESH, NOTHING_MATCHED
from twinform.ir import Document, Geometry, Link, Mesh, Visual, rewrite
from twinform.lazy import lazy_pattern
from twinform.passes.framework.pass_base import EVERY, matches, with_such_a_name
from twinform.passes.mesh_jobs.job import Options
from twinform.passes.meshes.mesh_pass import (
    MeshOutcome,
    MeshPass,
    Workbench,
    as_number,
    report_kept_mesh,
    without_submesh,
)
from twinform.passes.shared.mesh_solids import MeshError
from twinform.passes.shared.shape_meshes import format_length

_MADE = lazy_pattern(r"_lod\d+$")
_MOST_LEVELS = 8


class DecimateVisuals(MeshPass):
    """Replace the meshes of visuals by ones with fewer triangles, within a distance that is guaranteed.

    Changes the visuals with a mesh whose name matches `visuals`, on links whose name matches `links`. Edges are
    collapsed until `triangles`, or a `share` of them, are left; where that is farther off than `max-error` or
    `max-relative-error`, as many are kept as the distance needs. With `levels` more than one, each level has that share
    of the triangles of the one before, as long as the distance allows a coarser one. Neither URDF nor SDF has an
    element for levels of detail: all are written, as `NAME_lod1` and so on, and the document names the one of `use`.

    The distance is the greatest between both surfaces, both ways; it is bounded triangle by triangle, not sampled. An
    STL file stays STL, and others become OBJ with their materials. (`pip install 'twinform[meshes]'`)

    Never touches: collisions, masses and frames. A visual stays where its mesh has textures or colors of vertices,
    which the library cannot follow, or where a twentieth of its triangles cannot be saved.
    Diagnostics: `changed-mesh` for each visual with its triangles and distances, `kept-mesh`, `unreadable-mesh`,
    `mesh-reader-missing`, and `nothing-matched`.
    """

    name = "decimate-visuals"
    example: ClassVar[str] = "decimate-visuals{share=0.25 max-error=0.001}"

    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only links"))
    visuals: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only visuals"))
    share: float = Field(default=0.5, gt=0, lt=1, description="How many of the triangles are left, as a share.")
    triangles: int | None = Field(default=None, ge=4, description="How many are left, in place of a share.")
    max_error: float | None = Field(
        default=None, gt=0, allow_inf_nan=False, description="The distance that is allowed, in m."
    )
    max_relative_error: float | None = Field(
        default=0.01, gt=0, allow_inf_nan=False, description="The same as a share of the diagonal of the mesh."
    )
    levels: int = Field(default=1, ge=1, le=_MOST_LEVELS, description="How many levels of detail are written.")
    use: int = Field(default=1, ge=0, description="The level that the document names; 0 is the mesh that it has.")

    @model_validator(mode="after")
    def _check_use(self) -> Self:
        if self.use > self.levels:
            raise ValueError(f"use={self.use} is more than there are levels")
        return self

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with other visuals."""
        bench, matched = self.workbench(sink), list[Visual]()

        def change(link: Link) -> Link:
            if not matches(link.name, self.links):
                return link
            visuals = tuple(self._decimate_visual(link, each, bench, matched) for each in link.visuals)
            return link if visuals == link.visuals else link.copy(visuals=visuals)

        made = rewrite(document, Link, change)
        if not matched:
            message = f"no visual {', '.join(self.visuals)!r} on a link {', '.join(self.links)!r} has a mesh"
            sink.report(NOTHING_MATCHED, message, document.location, found=", ".join(self.visuals))
        return made

    def _decimate_visual(self, link: Link, visual: Visual, bench: Workbench, matched: list[Visual]) -> Visual:
        mesh = visual.geometry.shape if visual.geometry else None
        if not isinstance(mesh, Mesh) or not matches(visual.name, self.visuals):
            return visual
        matched.append(visual)
        what = f"visual {visual.name!r} of link {link.name!r}" if visual.name else f"a visual of link {link.name!r}"
        try:
            if bench.sources.find((mesh.uri or "").strip()).is_made(_MADE):
                return visual
            outcome = bench.outcome("decimate", mesh, self._options(mesh))
            return self._use_levels(visual, mesh, what, outcome, bench)
        except MeshError as error:
            report_kept_mesh(bench.sink, error, what, visual.location)
            return visual

    def _options(self, mesh: Mesh) -> Options:
        return {
            **self.read_options, "share": self.share, "triangles": self.triangles, "max_error": self.max_error,
            "max_relative_error": self.max_relative_error, "levels": self.levels,
            "scale": list(mesh.scale or (1.0, 1.0, 1.0)),
        }  # fmt: skip

    def _use_levels(self, visual: Visual, mesh: Mesh, what: str, outcome: MeshOutcome, bench: Workbench) -> Visual:
        """The visual with the level that the document is to name; reports all levels."""
        facts, before = outcome.result.facts, as_number(outcome.result.facts["before"])
        if "kept" in facts:
            message = f"{what} stays as it is: {facts['kept']}"
            bench.sink.report(KEPT_MESH, message, visual.location, found=f"{before:.0f} triangles")
            return visual
        levels = cast("list[dict[str, float]]", facts["levels"])
        uris: list[str] = []
        for level in range(1, len(levels) + 1):
            files = {name: data for name, data in outcome.result.files.items() if name.startswith(f"_lod{level}")}
            # An element of ours for levels of detail would be read by nobody. The files are for
            # whoever packs the model for a renderer.
            uris.append(bench.add(outcome.stem, files))
        words = [f"{each['triangles']:.0f} at most {format_length(each['error'])} off" for each in levels]
        rest = ", and no coarser level is within the distance" if len(levels) < self.levels else ""
        message = f"{what}: {before:.0f} triangles became {', '.join(words)}{rest}"
        bench.sink.report(CHANGED_MESH, message, visual.location)
        if not self.use:
            return visual
        changed = without_submesh(mesh).copy(uri=uris[min(self.use, len(uris)) - 1])
        geometry = (visual.geometry or Geometry()).copy(shape=changed)
        return visual.copy(geometry=geometry)
