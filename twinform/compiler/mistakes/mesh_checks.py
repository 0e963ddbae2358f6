"""Checks of meshes: broken files, packages without their manifest, collisions that are missing or too detailed."""

from pathlib import Path
from typing import NamedTuple

from twinform.compiler.mistakes.mesh_files import MeshFiles
from twinform.compiler.resolve_uris import SearchPath, UriError, exists
from twinform.compiler.ros_packages import MANIFEST
from twinform.diagnostics import DiagnosticSink, Rule, Severity, rules
from twinform.ir import Document, Link, Mesh, Model
from twinform.passes.mesh_jobs.mesh_files import kind_of
from twinform.passes.shared.moving_bodies import movable_models

_DETAILED = 2**20
"""A mesh of this size, in bytes, has 20,000 triangles as an STL: too many to touch with."""
_MOST_OF = 0.75
"""If so much of the links that are seen can be touched, a link that cannot was forgotten."""
_FEW = 5


class Fault(NamedTuple):
    """What is wrong with a file that is there."""

    rule: Rule
    message: str
    help: str | None = None


def find_mesh_fault(uri: str, files: MeshFiles) -> Fault | None:
    """Find out whether a file that is there is no mesh of the kind that its name says."""
    fault = files.fault(files.paths[uri]) if uri in files.paths else None
    return Fault(rules.BROKEN_MESH, f"the mesh {uri!r} {fault}") if fault else None


def find_package_fault(uri: str, search: SearchPath, beside: Path) -> Fault | None:
    """Find out whether a package is a mere folder, which ROS does not find."""
    name = uri.removeprefix("package://").partition("/")[0]
    try:
        folder = search.package(name, beside)
    except UriError:
        return None
    if exists(folder / MANIFEST):
        return None
    message = f"package {name!r} is found as a folder, which has no {MANIFEST}: ROS knows no such package"
    hint = f"add a {MANIFEST} with <name>{name}</name>, or write the name of the package that the folder is in"
    return Fault(rules.PACKAGE_WITHOUT_MANIFEST, message, hint)


def report_collisions(document: Document, files: MeshFiles, sink: DiagnosticSink) -> None:
    """Report links that are seen and cannot be touched, and large meshes that serve for both."""
    for model in movable_models(document):
        _report_untouchable(model, sink)
        for link in model.links:
            _report_detailed(link, files, sink)


def _report_untouchable(model: Model, sink: DiagnosticSink) -> None:
    seen = [link for link in model.links if link.visuals and link.inertial and link.inertial.mass]
    without = [link for link in seen if not link.collisions]
    if len(seen) < _FEW or not without or len(without) > (1 - _MOST_OF) * len(seen):
        return
    moved = {joint.child for joint in model.joints if joint.type != "fixed"}
    # One that was forgotten stands out; where several have none, it is mostly meant.
    severity = None if len(without) == 1 else Severity.INFO
    for link in without:
        if link.name in moved:
            others = f"{len(seen) - len(without)} of {len(seen)} links"
            message = f"link {link.name!r} moves and has no <collision>; {others} of {model.name!r} have one"
            sink.report(rules.MISSING_COLLISION, message, link.location, expected="<collision>", severity=severity)


def _report_detailed(link: Link, files: MeshFiles, sink: DiagnosticSink) -> None:
    seen = {shape.uri for each in link.visuals if each.geometry and isinstance(shape := each.geometry.shape, Mesh)}
    for each in link.collisions:
        shape = each.geometry.shape if each.geometry else None
        path = files.paths.get((shape.uri or "").strip()) if isinstance(shape, Mesh) and shape.uri in seen else None
        found = files.head(path) if path else None
        if path and found and shape and found[1] > _DETAILED and not files.fault(path):
            size = f"{found[1] / 2**20:.1f} MiB"
            count = f", {(found[1] - 84) // 50} triangles" if kind_of(path) == "stl" else ""
            message = (
                f"the collision of link {link.name!r} is the mesh of its visual, of {size}{count}: contacts are slow"
            )
            hint = "make a simple one: --passes simplify-collisions"
            sink.report(rules.DETAILED_COLLISION, message, shape.location, found=path.name, help=hint)
