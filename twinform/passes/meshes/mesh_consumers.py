"""Which mesh formats a program reads: the table `data/consumers.toml`."""

import tomllib
from functools import cache
from typing import Literal, NamedTuple, cast

from twinform.package_files import package_files
from twinform.passes.mesh_jobs.formats import MeshFormat

ConsumerName = Literal["gazebo", "gazebo-fortress", "rviz", "mujoco", "pybullet", "drake", "pinocchio", "web"]


class Consumer(NamedTuple):
    """A program: its `formats`, the best first, the versions they were `seen` in, and what is up in its glTF files."""

    title: str
    seen: str
    formats: tuple[str, ...]
    gltf_up: str

    @property
    def written(self) -> MeshFormat:
        """The best of its formats that are written here."""
        return next(cast("MeshFormat", each) for each in self.formats if each in {"obj", "stl", "glb"})


@cache
def consumers() -> dict[str, Consumer]:
    """All, by name."""
    text = package_files("twinform.passes.meshes").joinpath("data", "consumers.toml").read_text(encoding="utf-8")
    return {
        name: Consumer(row["title"], row["seen"], tuple(row["formats"]), row.get("gltf_up", "z"))
        for name, row in tomllib.loads(text).items()
    }
