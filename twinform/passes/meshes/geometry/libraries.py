"""The libraries that the work on triangles is done with; of those without types, or with other ones, each is `Any`."""

import importlib
from typing import Any

Array = Any
"""A numpy array."""

coacd: Any = importlib.import_module("coacd")
fast_simplification: Any = importlib.import_module("fast_simplification")
np: Any = importlib.import_module("numpy")
optimize: Any = importlib.import_module("scipy.optimize")
spatial: Any = importlib.import_module("scipy.spatial")
trimesh: Any = importlib.import_module("trimesh")
