"""The physics engines that can be asked, what each of them reads, and the verdict that they give."""

from collections.abc import Callable, Mapping
from enum import StrEnum
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from twinform.dataclass import dataclass
from twinform.testing.oracles import libsdformat


class Alike(StrEnum):
    """In which sense two models are the same robot, the strongest first."""

    FRAMES = "frames"
    """Everything is equal."""
    INERTIAL = "inertial"
    """Link frames lie elsewhere or a massless link is missing; everything else is equal."""
    LUMPED = "lumped"
    """Joints, limits, mass matrix and gravity are equal, and so are groups of welded links weighed together."""
    MOTION = "motion"
    """Both move alike from the same state."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether two models are the same robot; `bool(verdict)` is true if they are.

    `deviation` is the largest difference that was found, and `of` names the quantity. Quantities above one are measured
    against the largest of their kind. `cause` is why the models are not the same robot.
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
    """The engine cannot read a file: it does not know the format, reports an error, or crashes."""

    def __init__(self, engine: str, path: Path, cause: str) -> None:
        super().__init__(f"{engine} cannot read {path}: {cause}")
        self.engine, self.path, self.cause = engine, path, cause

    def __reduce__(self) -> tuple[type["EngineUnreadableError"], tuple[str, Path, str]]:
        # exceptions are pickled with their message alone, and this one comes from another process
        return EngineUnreadableError, (self.engine, self.path, self.cause)


_EXTRA = "pip install 'twinform[engines]'"
_HERE = "twinform.testing.oracles"
# Coarse where the engine itself rounds: libsdformat's reader of URDF prints some numbers with six
# digits, and PyBullet turns inertias with few digits.
_EXACT, _COARSE = 1e-9, 1e-6
_SDF = {".sdf": _EXACT, ".world": _EXACT}
_URDF = {".urdf": _EXACT}
_MJCF = {".xml": _EXACT}
_COARSE_URDF = {".urdf": _COARSE}


@dataclass(frozen=True, slots=True)
class Engine:
    """An engine: the tolerance of its numbers by suffix of the formats it reads, and how to install what it `needs`.

    `module` is our module whose `read` reads a file; nothing of the engine is imported before that.
    """

    name: str
    formats: Mapping[str, float]
    needs: str
    module: str
    present: Callable[[], bool]

    def reads(self, path: Path) -> bool:
        """Whether the engine knows the format of a file."""
        return path.suffix in self.formats


def _importable(*modules: str) -> bool:
    return all(find_spec(module) is not None for module in ("numpy", *modules))


def _libsdformat() -> bool:
    return _importable() and libsdformat.available()


_LIST = (
    Engine("drake", _SDF | _URDF | _MJCF, _EXTRA, _HERE + ".drake", partial(_importable, "pydrake")),
    Engine("libsdformat", _SDF | _COARSE_URDF, libsdformat.MISSING, _HERE + ".libsdformat_robot", _libsdformat),
    Engine("mujoco", _URDF, _EXTRA, _HERE + ".mujoco", partial(_importable, "mujoco")),
    Engine("pinocchio", _URDF, _EXTRA, _HERE + ".pinocchio", partial(_importable, "pinocchio")),
    Engine("pybullet", _COARSE_URDF, _EXTRA, _HERE + ".pybullet", partial(_importable, "pybullet")),
)
ENGINES = {engine.name: engine for engine in _LIST}
"""All engines by name, whether they are installed or not."""


def available(engine: str | None = None) -> bool:
    """Whether an engine is installed; without a name, whether any engine is."""
    names = ENGINES if engine is None else (engine,)
    return any(_find_engine(name).present() for name in names)


def _find_engine(engine: str) -> Engine:
    """Return the engine of a name, or raise `ValueError` if there is none."""
    if engine not in ENGINES:
        raise ValueError(f"there is no engine {engine!r}; there are {', '.join(ENGINES)}")
    return ENGINES[engine]


def required(engine: str) -> Engine:
    """Return the engine of a name.

    Raises:
        EngineMissingError: it is not installed.
        ValueError: there is no such engine.
    """
    wanted = _find_engine(engine)
    if not wanted.present():
        raise EngineMissingError(engine, wanted.needs)
    return wanted
