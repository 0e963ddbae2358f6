"""Expanding includes: pure functions that replace `<include>` elements by the models that they name."""

from twinform.passes.includes.detach import detach, links_named_around
from twinform.passes.includes.expand import Included, Resolver, expand_includes, has_includes
from twinform.passes.includes.merge import frame_of_sdf
from twinform.passes.includes.newer_includes import newer_includes

__all__ = [
    "Included",
    "Resolver",
    "detach",
    "expand_includes",
    "frame_of_sdf",
    "has_includes",
    "links_named_around",
    "newer_includes",
]
