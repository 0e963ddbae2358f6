"""URIs of meshes and textures for ROS: `model://` to `package://`."""

from typing import TypeVar

from twinform.diagnostics import rules
from twinform.ir import Collision, Visual
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.legalise.to_urdf.to_urdf_pass import UrdfKeeper
from twinform.passes.shared.document_uris import GAZEBO, package_uri, scheme_of

Shape = TypeVar("Shape", Visual, Collision)


def urdf_uri(shape: Shape, kind: str, written: str, keeper: UrdfKeeper) -> tuple[Shape, str]:
    """A URI in a visual or collision for ROS, and the shape with an annotation if SDF would have another scheme for it.

    `kind` is the annotation's. One that came from URDF with the scheme of Gazebo keeps that.
    """
    annotation = find_annotation(shape, kind)
    shape = without_annotation(shape, kind)
    if annotation is not None and annotation.get("scheme") == scheme_of(written) == GAZEBO:
        return shape, written
    # Gazebo looks up `model://` in its resource path and ROS `package://` in its own; both name a
    # folder and a path in it.
    uri, lost = package_uri(written)
    if lost:
        keeper.account(rules.SDF_ONLY, f"{written!r} has the scheme that model:// becomes", shape.location, 1)
        shape = keeper.annotate(shape, kind, attributes={"scheme": scheme_of(written)})
    return shape, uri
