"""What engines say when they load a URDF file without its shapes: errors and warnings, in their own words."""

import contextlib
import importlib
import logging
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from twinform.testing.oracles.child import ChildDiedError, call

Words = tuple[str, ...]
"""What an engine complains of; nothing where it loads the file and is content."""

_SECONDS = 120.0
_PORTION = 25
_DIED = "it ends the process"


def complaints(engine: str, texts: Sequence[bytes]) -> list[Words]:
    """What an engine says of each text. It works in processes of its own, which may die."""
    found: list[Words] = []
    for start in range(0, len(texts), _PORTION):
        found += _portion(engine, tuple(texts[start : start + _PORTION]))
    return found


def _portion(engine: str, texts: tuple[bytes, ...]) -> list[Words]:
    """Halve what kills the process, until it is alone."""
    try:
        return call(_all, engine, texts, seconds=_SECONDS)
    except ChildDiedError:
        if len(texts) == 1:
            return [(_DIED,)]
    middle = len(texts) // 2
    return [*_portion(engine, texts[:middle]), *_portion(engine, texts[middle:])]


def _all(engine: str, texts: tuple[bytes, ...]) -> list[Words]:
    load = _LOADERS[engine]
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):  # MuJoCo writes a log where it stands
        return [load(text, Path(folder)) for text in texts]


def _mujoco(text: bytes, _folder: Path) -> Words:
    mujoco: Any = importlib.import_module("mujoco")
    try:
        spec = mujoco.MjSpec.from_string(text.decode())
        spec.compiler.fusestatic = False
        spec.compile()
    except Exception as error:  # noqa: BLE001 - whatever it raises is what it says
        return (" ".join(str(error).split()),)
    return ()


def _drake(text: bytes, folder: Path) -> Words:
    said = _Listener()
    log = logging.getLogger("drake")
    log.handlers, log.propagate = [said], False
    path = folder / "model.urdf"
    path.write_bytes(text)
    try:
        plant = importlib.import_module("pydrake.multibody.plant").MultibodyPlant(0.0)
        importlib.import_module("pydrake.multibody.parsing").Parser(plant).AddModels(str(path))
        plant.Finalize()
    except Exception as error:  # noqa: BLE001 - likewise
        return (*said.words, " ".join(str(error).split()))
    return tuple(said.words)


class _Listener(logging.Handler):
    """Keeps what is logged."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.words: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.words.append(" ".join(record.getMessage().split()))


_LOADERS: dict[str, Callable[[bytes, Path], Words]] = {"drake": _drake, "mujoco": _mujoco}
ENGINES = tuple(_LOADERS)
