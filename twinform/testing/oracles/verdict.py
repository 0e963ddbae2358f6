"""The verdict of an engine on two models, and the errors that keep it from one."""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path


class Alike(StrEnum):
    """In which sense two models are the same robot, the strongest first."""

    FRAMES = "frames"
    """Everything is equal."""
    INERTIAL = "inertial"
    """Everything but where the frames of links lie, or a massless link is missing."""
    LUMPED = "lumped"
    """Joints, limits, mass matrix and gravity, and links weighed together with those that are fixed to them."""
    MOTION = "motion"
    """From one state, both move alike."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether two models are the same robot; `bool(verdict)` is true where they are.

    `deviation` is the largest difference that was found, and `of` is in what. Numbers above one are measured
    against the largest of their kind. `cause` is why two models are not the same.
    """

    engine: str
    alike: Alike | None
    deviation: float
    of: str = ""
    cause: str = ""

    def __bool__(self) -> bool:
        return self.alike is not None

    def __str__(self) -> str:
        found = f"the same ({self.alike})" if self.alike else "different"
        measure = f", {self.of} differs by {self.deviation:.2g}" if self.of else ""
        return f"{self.engine}: {found}{measure}" + (f"; {self.cause}" if self.cause else "")


class OracleError(Exception):
    """No verdict is possible."""


class EngineMissingError(OracleError):
    """The engine is not installed."""

    def __init__(self, engine: str, needs: str) -> None:
        super().__init__(f"{engine} is not here: {needs}")


class EngineUnreadableError(OracleError):
    """The engine cannot read a file: a format that it does not have, a fault, or a crash."""

    def __init__(self, engine: str, path: Path, cause: str) -> None:
        super().__init__(f"{engine} cannot read {path}: {cause}")
        self.engine, self.path, self.cause = engine, path, cause

    def __reduce__(self) -> tuple[type["EngineUnreadableError"], tuple[str, Path, str]]:
        # exceptions are pickled with their message alone, and this one comes from another process
        return EngineUnreadableError, (self.engine, self.path, self.cause)
