"""Splits a world: a file for each of its models, and one that includes them."""

from twinform.compiler.splitting.split_world import Placement, SplitWorld, split

__all__ = ["Placement", "SplitWorld", "split"]
