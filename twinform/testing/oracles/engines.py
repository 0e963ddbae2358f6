"""The engines that can be asked, and what each of them reads."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.verdict import EngineMissingError

_EXTRA = "pip install 'twinform[oracles]'"
_HERE = "twinform.testing.oracles"
# Coarse where the engine itself rounds: libsdformat's reader of URDF prints some numbers with six
# digits, and PyBullet turns inertias with few digits.
_EXACT, _COARSE = 1e-9, 1e-6
_SDF = {".sdf": _EXACT, ".world": _EXACT}
_URDF = {".urdf": _EXACT}
_COARSE_URDF = {".urdf": _COARSE}


@dataclass(frozen=True, slots=True)
class Engine:
    """An engine: its formats by suffix, with the tolerance that its numbers allow, and what it `needs`.

    `module` has the `read` for files; nothing of the engine is imported before that.
    """

    name: str
    formats: Mapping[str, float]
    needs: str
    module: str
    present: Callable[[], bool]

    def reads(self, path: Path) -> bool:
        """Whether it has the format of a file."""
        return path.suffix in self.formats


def _importable(*modules: str) -> bool:
    return all(find_spec(module) is not None for module in ("numpy", *modules))


def _libsdformat() -> bool:
    return _importable() and libsdformat.available()


_LIST = (
    Engine("drake", _SDF | _URDF, _EXTRA, _HERE + ".drake", partial(_importable, "pydrake")),
    Engine(
        "libsdformat", _SDF | _COARSE_URDF, libsdformat.MISSING, _HERE + ".libsdformat.libsdformat_robot", _libsdformat
    ),
    Engine("mujoco", _URDF, _EXTRA, _HERE + ".mujoco", partial(_importable, "mujoco")),
    Engine("pinocchio", _URDF, _EXTRA, _HERE + ".pinocchio", partial(_importable, "pinocchio")),
    Engine("pybullet", _COARSE_URDF, _EXTRA, _HERE + ".pybullet", partial(_importable, "pybullet")),
)
ENGINES = {engine.name: engine for engine in _LIST}
"""All engines by name, whether they are installed or not."""


def available(engine: str | None = None) -> bool:
    """Whether an engine is installed, or, without a name, any."""
    names = ENGINES if engine is None else (engine,)
    return any(found(name).present() for name in names)


def found(engine: str) -> Engine:
    """The engine of a name.

    Raises:
        ValueError: there is none.
    """
    if engine not in ENGINES:
        raise ValueError(f"there is no engine {engine!r}; there are {', '.join(ENGINES)}")
    return ENGINES[engine]


def required(engine: str) -> Engine:
    """The engine of a name, which must be installed.

    Raises:
        EngineMissingError: it is not.
    """
    wanted = found(engine)
    if not wanted.present():
        raise EngineMissingError(engine, wanted.needs)
    return wanted
