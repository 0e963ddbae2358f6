"""What engines report when they load a URDF file without its shapes: errors and warnings, verbatim."""

import contextlib
import importlib
import logging
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from twinform.compiler.workers import Failure, run

Messages = tuple[str, ...]
"""What an engine complains of; nothing where it loads the file and is content."""


def complaints(engine: str, texts: Sequence[bytes]) -> list[Messages]:
    """What an engine reports about each text. It works in processes of its own, which may die."""
    jobs = [(engine, number, text) for number, text in enumerate(texts)]
    found = {
        job: ("it ends the process",) if isinstance(answer, Failure) else answer for job, answer in run(_load, jobs)
    }
    return [found[job] for job in jobs]


def _load(job: tuple[str, int, bytes]) -> Messages:
    engine, _, text = job
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):  # MuJoCo writes a log where it stands
        return _LOADERS[engine](text, Path(folder))


def _mujoco(text: bytes, _folder: Path) -> Messages:
    mujoco: Any = importlib.import_module("mujoco")
    try:
        spec = mujoco.MjSpec.from_string(text.decode())
        spec.compiler.fusestatic = False
        spec.compile()
    except Exception as error:  # noqa: BLE001 - whatever it raises is its message
        return (" ".join(str(error).split()),)
    return ()


def _drake(text: bytes, folder: Path) -> Messages:
    listener = _Listener()
    log = logging.getLogger("drake")
    log.handlers, log.propagate = [listener], False
    path = folder / "model.urdf"
    path.write_bytes(text)
    try:
        plant = importlib.import_module("pydrake.multibody.plant").MultibodyPlant(0.0)
        importlib.import_module("pydrake.multibody.parsing").Parser(plant).AddModels(str(path))
        plant.Finalize()
    except Exception as error:  # noqa: BLE001 - an engine may raise anything
        return (*listener.messages, " ".join(str(error).split()))
    return tuple(listener.messages)


class _Listener(logging.Handler):
    """Keeps what is logged."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(" ".join(record.getMessage().split()))


_LOADERS: dict[str, Callable[[bytes, Path], Messages]] = {"drake": _drake, "mujoco": _mujoco}
ENGINES = tuple(_LOADERS)
