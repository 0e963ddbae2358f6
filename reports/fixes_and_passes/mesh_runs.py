"""What the passes make of one mesh, each in a process of its own, whose memory and time are measured."""

import hashlib
import importlib
import json
import os
import shutil
import tempfile
import time
from contextlib import suppress
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import twinform
from reports.fixes_and_passes.mesh_distances import Body, apart, body_of, diagonal, mesh
from reports.fixes_and_passes.mesh_files import MeshFile
from testbed.output_files import OUT
from twinform.ir import Collision, Link, Mesh, Visual, walk

PIPELINES = {
    "simplify": "simplify-collisions{how=[primitive,hull]}",
    "parts": "simplify-collisions{how=parts parts=8}",
    "decimate": "decimate-visuals{share=0.25}",
    "convert": "convert-meshes{to=obj drop-appearance=true}",
}
LIMITS = {"simplify": 0.05, "parts": 0.05, "decimate": 0.01, "convert": 1e-6}
"""The distances that are asked for, as a share of the diagonal."""
COLLISIONS = frozenset({"simplify", "parts"})
_MODEL = """<robot name="m"><link name="l">
<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<{tag} name="s"><geometry><mesh filename="{uri}"/></geometry></{tag}></link></robot>"""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a mesh by one pass; lengths are shares of the diagonal, `judged` is what Coal met."""

    name: str
    format: str
    step: str
    said: tuple[str, ...] = ()
    changed: bool = False
    before: int = 0
    after: int = 0
    how: str = ""
    judged: float = 0.0
    seconds: float = 0.0
    megabytes: float = 0.0
    fault: str = ""
    readers: dict[str, bool] = field(default_factory=dict[str, bool])


@dataclass(frozen=True, slots=True)
class Task:
    """A mesh, and the steps to take with it."""

    file: MeshFile
    steps: tuple[str, ...]

    @property
    def kept(self) -> Path:
        """Where its outcomes are kept, so that a run that was broken off goes on."""
        key = hashlib.sha256(repr((self.file.name, self.steps, PIPELINES)).encode()).hexdigest()
        return OUT / "meshes" / f"{key}.json"


def all_judged(task: Task) -> list[Outcome]:
    """Take every step with a mesh, unless its outcomes are kept."""
    if task.kept.is_file():
        return [Outcome(**row) for row in json.loads(task.kept.read_text(encoding="utf-8"))]
    os.environ["TWINFORM_MESH_CACHE"] = "off"  # time and memory are measured
    found = [_judged(task.file, step) for step in task.steps]
    peak = _peak()
    found = [replace(each, megabytes=peak) for each in found]
    twinform.write_atomically(task.kept, json.dumps([asdict(each) for each in found]))
    return found


def _judged(file: MeshFile, step: str) -> Outcome:
    """Run a pass on a model with this mesh, write what it makes, and ask others about it."""
    folder = Path(tempfile.mkdtemp())
    uri = f"in/mesh{file.path.suffix.lower()}"
    shutil.copytree(file.path.parent, folder / "in", ignore=_others(file.path), dirs_exist_ok=True)
    (folder / "in" / file.path.name).rename(folder / uri)
    tag = "collision" if step in COLLISIONS else "visual"
    (folder / "m.urdf").write_text(_MODEL.format(tag=tag, uri=uri))
    begin = time.monotonic()
    made = twinform.convert(folder / "m.urdf", to="urdf", passes=PIPELINES[step])
    seconds = time.monotonic() - begin
    for each in made.side_files:
        twinform.write_atomically(folder / each.path, each.data)
    said = tuple(each.message for each in made.diagnostics if "mesh" in each.rule.name)
    outcome = Outcome(file.name, file.format, step, said=said, seconds=seconds)
    try:
        return replace(outcome, **_facts(step, made.document, folder, uri))
    except Exception as error:  # noqa: BLE001 - a judge that fails is a finding
        return replace(outcome, fault=f"{type(error).__name__}: {error}".replace(f"{folder}/", ""))
    finally:
        with suppress(OSError):
            shutil.rmtree(folder)


def _others(mesh_path: Path) -> Any:
    """Leave out large neighbors and folders: what a mesh names lies beside it."""
    kept = {".mtl", ".png", ".jpg", ".jpeg", ".bin", ".tga", ".bmp"}

    def ignored(folder: str, names: list[str]) -> set[str]:
        paths = [Path(folder, name) for name in names]
        return {each.name for each in paths if each != mesh_path and (each.is_dir() or each.suffix.lower() not in kept)}

    return ignored


def _facts(step: str, document: Any, folder: Path, uri: str) -> dict[str, Any]:
    link = next(node for node in walk(document) if isinstance(node, Link))
    shapes: tuple[Collision | Visual, ...] = link.collisions or link.visuals
    found = [each.geometry.shape if each.geometry else None for each in shapes]
    if len(found) == 1 and isinstance(found[0], Mesh) and found[0].uri == uri:
        return {}
    old = mesh(folder / uri)
    if step in COLLISIONS:
        new = [body_of(each.geometry.shape if each.geometry else None, each.pose, folder) for each in shapes]
    else:
        new = [mesh(folder / (each.uri or "")) for each in found if isinstance(each, Mesh)]
    size = diagonal(old)
    parts = f"{len(new)} convex" if step in COLLISIONS else "mesh"
    first = found[0]
    how = first.kind if first and not isinstance(first, Mesh) else parts
    uris = [each.uri or "" for each in found if isinstance(each, Mesh)]
    return {
        "changed": True,
        "before": old.shape.num_tris,
        "after": sum(getattr(each.shape, "num_tris", 0) for each in new),
        "how": how,
        "judged": apart(old, new, outside=step in COLLISIONS) / size,
        "readers": {} if step in COLLISIONS else _readers(folder / uris[0], old, size),
    }


def _readers(path: Path, old: Body, size: float) -> dict[str, bool]:
    """Whether MuJoCo reads the new file, with corners where assimp has those of the old one."""
    np: Any = importlib.import_module("numpy")
    mujoco: Any = importlib.import_module("mujoco")
    xml = (
        f'<mujoco><asset><mesh name="m" inertia="shell" file="{path}"/></asset>'
        '<worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>'
    )
    try:
        model = mujoco.MjModel.from_xml_string(xml)
    except ValueError:
        return {"mujoco": False}
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, model.mesh_quat[0])
    points = model.mesh_vert @ turned.reshape(3, 3).T + model.mesh_pos[0]
    theirs = np.asarray(old.shape.vertices())
    same = np.abs(np.array([points.min(0) - theirs.min(0), points.max(0) - theirs.max(0)])).max() <= 0.011 * size
    return {"mujoco": bool(same)}


def _peak() -> float:
    """Megabytes of the largest process that did work on meshes."""
    resource: Any = importlib.import_module("resource")
    from twinform.passes.mesh_jobs import child_process  # noqa: PLC0415 - it is ended, so that it is counted

    child_process.shared().end()
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1000
