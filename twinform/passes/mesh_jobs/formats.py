"""Formats of mesh files that are written: names, and the mark by which our own files are known."""

from typing import Literal

MARK = "made by twinform"
"""In the first bytes of every mesh that is written, so that nobody else's file is ever written over."""
MeshFormat = Literal["obj", "stl", "glb"]
