"""Numerical libraries as `Any`, because they have no types or other ones. What few jobs need is imported elsewhere."""

import importlib
from typing import Any

Array = Any
"""A numpy array."""

np: Any = importlib.import_module("numpy")
trimesh: Any = importlib.import_module("trimesh")
