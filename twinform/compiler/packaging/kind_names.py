"""The names of the kinds of packages, for who does not build any."""

from collections.abc import Mapping
from typing import Literal, get_args

KindName = Literal["gazebo-model", "ros2"]
KIND_NAMES = (*get_args(KindName), "both")
"""What may be asked for."""

REQUIRED: Mapping[str, tuple[str, ...]] = {
    "gazebo-model": ("description", "maintainer", "email"),
    "ros2": ("description", "maintainer", "email", "license"),
}
"""What a package of each kind has to say about itself: fields of its details."""


def kinds_of(asked: str) -> tuple[str, ...]:
    """The kinds that are meant."""
    return get_args(KindName) if asked == "both" else (asked,)
