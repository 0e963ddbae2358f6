"""USD as a second opinion: robots in the physics of a stage (UsdPhysics, and what engines add to it) as documents.

Nothing is converted from it or to it: `twinform diff` alone reads it.
"""

from twinform.compiler.usd.read_usd import read_usd

__all__ = ["read_usd"]
