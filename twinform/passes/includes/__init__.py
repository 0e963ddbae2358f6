"""Expanding includes: pure functions that replace `<include>` by the models that it names."""

from twinform.passes.includes.detach import detach, links_named_around
from twinform.passes.includes.expand import Included, Resolver, expand_includes, has_includes
from twinform.passes.includes.place import frame_of_sdf

__all__ = ["Included", "Resolver", "detach", "expand_includes", "frame_of_sdf", "has_includes", "links_named_around"]
