"""A folder of models that change, and what each of them has to become now."""

import os
import random
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from testbed import robots
from twinform.compiler import ConversionRequest, LoadOptions
from twinform.compiler.batch import Convert, ModelEntry
from twinform.compiler.batch.task import Task, work

_TIME = 1_000_000_000
"""Every file has this time, as in a reproducible archive; all contents of one file have one size, too."""
_SHARED = 20
"""One of so many models is a world that includes the crate, and one is a xacro file that includes the part."""
_WRONG = '<robot name="r"><link name="a"/><link name="a"/></robot>'
_CRATE = '<sdf version="1.11"><model name="crate"><link name="v{0:03}"/></model></sdf>'
_CONFIG = '<model><sdf version="1.11">model.sdf</sdf></model>'
_WORLD = '<sdf version="1.11"><world name="v{0:03}"><include><uri>model://crate</uri></include></world></sdf>'
_PART = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><material name="v{0:03}"/></robot>'
_XACRO = """<robot name="v{0:03}" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:include filename="part.xacro"/><link name="base"/></robot>"""
_CRATE_FILE, _PART_FILE = "crate/model.sdf", "part.xacro"
JOB = Convert(to=ConversionRequest(to="sdf", expand_includes=True))


class _Made(NamedTuple):
    """What became of a model, and the versions of the files that it was made from."""

    versions: tuple[int, ...]
    text: bytes


@dataclass(slots=True)
class Sources:
    """The models in `folder`, relative to the current one; each has a version, and some have an error."""

    folder: Path
    count: int
    chance: random.Random
    versions: dict[str, int] = field(default_factory=dict[str, int])
    wrong: set[str] = field(default_factory=set[str])
    _wanted: dict[str, "_Made"] = field(default_factory=dict[str, "_Made"])

    @property
    def names(self) -> list[str]:
        """The models."""
        return [name for name in self.versions if name != _PART_FILE]

    def make(self) -> None:
        """Write all of them."""
        (self.folder / ".git").mkdir(parents=True)
        self._write("crate/model.config", _CONFIG)
        kinds = {0: "w{0:03}.world", 1: "x{0:03}.urdf.xacro"}
        names = [kinds.get(number % _SHARED, "r{0:03}.urdf").format(number) for number in range(self.count - 1)]
        for name in (_CRATE_FILE, _PART_FILE, *names):
            self._change(name)

    def change(self, share: float) -> None:
        """Give a share of the models another content of the same size and time, in which some have an error."""
        for name in self.chance.sample(self.names, max(2, round(share * self.count))):
            if name.startswith("r"):
                fault = self.chance.random() < 0.2
                (self.wrong.add if fault else self.wrong.discard)(name)
            self._change(name)
        if self.chance.random() < share:
            self._change(_PART_FILE)

    def result(self, name: str) -> str:
        """The place of the result of a model."""
        return f"{name.partition('.')[0]}.{'world' if name.endswith('.world') else 'sdf'}"

    def wanted(self) -> dict[str, bytes]:
        """What each model without an error has to become, by its place; made without any record of an earlier run."""
        return {self.result(name): self._make_once(name) for name in self.names if name not in self.wrong}

    def _make_once(self, name: str) -> bytes:
        key = tuple(self.versions[each] for each in (name, _CRATE_FILE, _PART_FILE))
        key = key if name[0] in "wx" else key[:1]
        known = self._wanted.get(name)
        if known is None or known.versions != key:
            task = Task(
                entry=ModelEntry(name, name),
                job=JOB,
                root=str(self.folder),
                load_options=LoadOptions(),
                output=self.result(name),
            )
            text = next(iter(work(task).texts.values()))
            known = self._wanted[name] = _Made(key, text if isinstance(text, bytes) else text.encode())
        return known.text

    def _change(self, name: str) -> None:
        self.versions[name] = version = self.versions.get(name, 0) + 1
        if name in self.wrong:
            self._write(name, _WRONG)
            return
        templates = {"w": _WORLD, "x": _XACRO, "c": _CRATE, "p": _PART}
        if name[0] in templates:
            self._write(name, templates[name[0]].format(version))
        else:
            robot = robots.urdf(3 + int(name[1:4]) % 5)
            self._write(name, robot.replace('name="tree_of_', f'name="v{version:03}_of_'))

    def _write(self, name: str, text: str) -> None:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        os.utime(path, (_TIME, _TIME))
