"""The options on what a file becomes: format, version, passes, and what goes along."""

import math
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Literal, TypedDict, get_args

from twinform.dataclass import dataclass
from twinform.option import Option
from twinform.schemas import versions_of

if TYPE_CHECKING:
    from twinform.passes.framework.pass_base import Pass

Language = Literal["sdf", "urdf", "mjcf", "json"]
UrdfVersion = Literal["1.0", "1.1", "1.2"]
URDF_VERSIONS: tuple[UrdfVersion, ...] = get_args(UrdfVersion)


def known_sdf_version(version: str) -> str:
    """Return a version of SDF unchanged.

    Raises:
        ValueError: SDF has no such version.
    """
    versions = versions_of("sdf")
    if version not in versions:
        raise ValueError(f"SDF has no version {version!r}; it has {', '.join(versions)}")
    return version


def distance(text: str | float) -> float:
    """Return a distance in m that was typed.

    Raises:
        ValueError: it is no number above 0.
    """
    value = float(text)
    if not 0 < value < math.inf:
        raise ValueError(f"{text} is no distance above 0")
    return value


def known_prefix(uri: str) -> str:
    """Return the beginning of the URIs of new meshes unchanged.

    Raises:
        ValueError: it is no folder in a package of ROS or a model of Gazebo.
    """
    if not re.fullmatch(r"(package|model)://[^/\s]+(/[^\s]*)?", uri):
        raise ValueError("takes package://NAME or model://NAME")
    return uri


class RequestOptions(TypedDict, total=False):
    """What a file becomes. `model` is the one that is meant of several; `keep_physics` is for the consumers' passes.

    With `side_files` false, no files are made that would have to lie beside the result.
    """

    sdf_version: Annotated[
        str | None,
        Option(
            help="The version of SDF to write.",
            metavar="V",
            parse=known_sdf_version,
            known=lambda: versions_of("sdf"),
            setting=True,
        ),
    ]
    urdf_version: Annotated[UrdfVersion | None, Option(help="The version of URDF to write.", setting=True)]
    passes: Annotated[
        "str | Iterable[Pass] | None",
        Option(
            help="Passes to run, such as 'check-inertia', or @NAME for one that the configuration names.",
            metavar="PIPELINE",
            setting=True,
        ),
    ]
    carriers: Annotated[bool, Option(help="Whether to keep what the target lacks in elements of tf:.", setting=True)]
    shape_error: Annotated[
        float | None,
        Option(
            help="How far a mesh that stands for a shape which the target lacks may be from it, in m; else 1 % of its "
            "largest radius.",
            metavar="M",
            parse=distance,
            setting=True,
        ),
    ]
    mesh_prefix: Annotated[
        str | None,
        Option(
            help="What the URIs of such meshes begin with, such as package://arm; else they are relative paths.",
            metavar="URI",
            parse=known_prefix,
            setting=True,
        ),
    ]
    keep_paths: Annotated[
        bool,
        Option(
            help="Leave relative paths as they are in the source, for a result that will lie beside it; else they lead "
            "from the folder of the result."
        ),
    ]
    default_classes: Annotated[
        bool,
        Option(help="Whether MJCF has classes of defaults for what many of its elements say alike.", setting=True),
    ]
    side_files: bool
    comments: Annotated[bool, Option(help="Whether comments of the source go along.")]
    expand_includes: bool
    model: str | None
    keep_physics: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Requested:
    """What is asked for, with the defaults of the options: legalisation and the writer read it, and all between them.

    Only pipelines are elsewhere, as they are made of the text of `passes`.
    """

    sdf_version: str | None = None
    urdf_version: UrdfVersion | None = None
    carriers: bool = True
    shape_error: float | None = None
    mesh_prefix: str | None = None
    keep_paths: bool = False
    default_classes: bool = False
    side_files: bool = True
    mesh_folder: str = "meshes"
    """Where meshes of shapes go that MJCF lacks; packages have their own folders."""
    comments: bool = True
    expand_includes: bool = False
    model: str | None = None
    keep_physics: bool = False


USUAL = Requested()
"""What a conversion is that nothing else was asked of."""
