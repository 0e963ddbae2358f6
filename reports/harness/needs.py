"""What reports need that may not be here: each gives the reason why not, and nothing where it is here."""

from collections.abc import Callable
from importlib.util import find_spec

from testbed.corpus import files
from testbed.engines import gazebo as gz_physics
from testbed.oracles import urdfdom as check_urdf
from twinform.testing import oracles
from twinform.testing.oracles import libsdformat as sdformat12


def need(is_here: Callable[[], bool], missing: str) -> Callable[[], str]:
    """The reason why something is missing; empty where it is here."""
    return lambda: "" if is_here() else missing


corpus = need(files.CORPUS.is_dir, files.MISSING)
drake = need(lambda: oracles.available("drake"), "Drake is not here: pip install '.[engines]'")
mujoco = need(lambda: oracles.available("mujoco"), "MuJoCo is not here: pip install '.[engines]'")
scipy = need(lambda: find_spec("scipy") is not None, "SciPy, which makes hulls of vertices, is not here")
libsdformat = need(sdformat12.available, sdformat12.MISSING)
urdfdom = need(check_urdf.available, check_urdf.MISSING)
urdfdom_6 = need(check_urdf.available_6, check_urdf.MISSING_6)
gazebo = need(gz_physics.available, gz_physics.MISSING)
"""gz-physics with at least one engine."""
