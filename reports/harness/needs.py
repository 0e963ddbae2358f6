"""What reports need that may not be here: each says why not, and nothing where it is here."""

from tests.corpus import files
from tests.oracles import urdfdom as check_urdf
from twinform.testing import oracles
from twinform.testing.oracles import gazebo as gz_physics
from twinform.testing.oracles import libsdformat as sdformat12


def corpus() -> str:
    """The corpus."""
    return "" if files.CORPUS.is_dir() else files.MISSING


def drake() -> str:
    """Drake."""
    return "" if oracles.available("drake") else "Drake is not here: pip install '.[oracles]'"


def libsdformat() -> str:
    """Libsdformat 12."""
    return "" if sdformat12.available() else sdformat12.MISSING


def urdfdom() -> str:
    """Urdfdom."""
    return "" if check_urdf.available() else check_urdf.MISSING


def gazebo() -> str:
    """gz-physics with at least one engine."""
    return "" if gz_physics.available() else gz_physics.MISSING
