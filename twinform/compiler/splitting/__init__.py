"""Splits a world: a file for each of its models, and one that includes them."""

from twinform.compiler.splitting.worlds import Placement, Split, split

__all__ = ["Placement", "Split", "split"]
