"""Libraries that make meshes of meshes, as `Any`: reading and measuring them does without."""

import importlib
from typing import Any

coacd: Any = importlib.import_module("coacd")
fast_simplification: Any = importlib.import_module("fast_simplification")
optimize: Any = importlib.import_module("scipy.optimize")
spatial: Any = importlib.import_module("scipy.spatial")
