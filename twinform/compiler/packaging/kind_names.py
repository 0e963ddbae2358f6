"""The names of the kinds of packages, without what builds them."""

from collections.abc import Mapping
from typing import Literal, get_args

KindName = Literal["gazebo-model", "ros2"]
KIND_NAMES = (*get_args(KindName), "both")
"""The kinds of packages that can be requested."""

REQUIRED: Mapping[str, tuple[str, ...]] = {
    "gazebo-model": ("description", "maintainer", "email"),
    "ros2": ("description", "maintainer", "email", "license"),
}
"""The details that a package of each kind needs."""


def kinds_of(asked: str) -> tuple[str, ...]:
    """Return the kinds of packages that a request means."""
    return get_args(KindName) if asked == "both" else (asked,)
