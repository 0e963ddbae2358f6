"""A world taken apart: a file for each of its models, and one that includes them."""

from twinform.compiler.splitting.worlds import Split, split

__all__ = ["Split", "split"]
