"""Shapes that an older version of SDF lacks, made of those that it has."""

from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Capsule, Cone, Document, Ellipsoid, Link, Polyline, bits_of, replace_fields, rewrite
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.mesh_jobs.mesh_files import NoMeshError
from twinform.passes.sdf_versions.spans import has_shape
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.replaced_shapes import AnyPart, ShapeReplacer, map_sensors, with_ends

_HAVING = bits_of(Capsule) | bits_of(Cone) | bits_of(Ellipsoid) | bits_of(Polyline)


class ReplaceShapes(VersionPass):
    """Write shapes that the version lacks by those that it has.

    Changes: 1. a capsule becomes a cylinder and two spheres, or a sphere where it has no length, and a
    contact sensor that names it names all of these; 2. an ellipsoid, cone
    or polyline becomes a mesh beside the result, at most `shape_error` off.
    Never touches: masses and inertias; shapes of which no mesh is made, which a later pass carries.
    Diagnostics: `replaced-shape` for each mesh, `older-version` where none can be written; in the ledger
    `replaced-shape`.
    """

    name: ClassVar[str] = "replace-shapes"
    shape_error: float | None = None
    mesh_prefix: str | None = None
    side_files: bool = True

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with shapes of the version."""
        replacer = ShapeReplacer(
            keeper,
            f"SDF {self.version}",
            lambda kind: not has_shape(self.version, kind),
            self.shape_error,
            self.mesh_prefix,
            self.side_files,
        )

        def change(link: Link) -> Link:
            visuals, _ = with_ends(_replace_parts(link.visuals, link.name, replacer), annotated=self.carriers)
            parts = _replace_parts(link.collisions, link.name, replacer)
            collisions, names = with_ends(parts, annotated=self.carriers)
            return map_sensors(replace_fields(link, visuals=visuals, collisions=collisions), names)

        return rewrite(document, Link, change, having=_HAVING)


def _replace_parts(parts: tuple[AnyPart, ...], link: str, replacer: ShapeReplacer) -> list[AnyPart]:
    made: list[AnyPart] = []
    for part in parts:
        try:
            made.append(replacer.replace(part, link))
        except NoMeshError as error:
            message = f"{replacer.target} has no shape for {type(part).__name__.lower()} {part.name!r} of link {link!r}"
            replacer.keeper.sink.report(rules.OLDER_VERSION, message, part.location, help=str(error))
            made.append(part)
    return made
