"""Putting included models in the place of their includes: pure functions from documents to a document."""

from twinform.passes.includes.detach import detach
from twinform.passes.includes.expand import Included, Resolver, expand_includes, has_includes

__all__ = ["Included", "Resolver", "detach", "expand_includes", "has_includes"]
