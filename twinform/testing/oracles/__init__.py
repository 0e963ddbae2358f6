"""Physics engines as judges: are two files, of either format, the same robot?

    from twinform.testing import oracles

    if oracles.available("drake"):
        verdict = oracles.compare("robot.urdf", "robot.sdf", engine="drake")
        assert verdict, verdict

Engines come with `pip install 'twinform[engines]'`, and are imported when they are asked.
"""

from twinform.testing.oracles.engines import (
    ENGINES,
    Alike,
    Engine,
    EngineMissingError,
    EngineUnreadableError,
    OracleError,
    Verdict,
    available,
)
from twinform.testing.oracles.isolated import compare, simulate

__all__ = [
    "ENGINES",
    "Alike",
    "Engine",
    "EngineMissingError",
    "EngineUnreadableError",
    "OracleError",
    "Verdict",
    "available",
    "compare",
    "simulate",
]
