"""Libraries without types, or with other ones, as `Any`. What few jobs need is imported where it is used."""

import importlib
from typing import Any

Array = Any
"""A numpy array."""

np: Any = importlib.import_module("numpy")
trimesh: Any = importlib.import_module("trimesh")
