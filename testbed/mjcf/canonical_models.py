"""The models of the file format MJCF that are tested with MuJoCo: our cases, and the files of published packages.

`make mjcf` downloads the packages into `out/mjcf`; TWINFORM_MJCF names another folder with their files.
"""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lxml import etree

from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.mjcf.normalize import normalize
from twinform.compiler.input.mjcf.splice_includes import splice_includes
from twinform.compiler.input.parsing import UnreadableError
from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.schemas import Context, XmlElement, known_version, versions_of

ROOT = Path(__file__).parents[2]
CASES = ROOT / "tests" / "cases" / "mjcf"
PACKAGES = Path(os.environ.get("TWINFORM_MJCF") or ROOT / "out" / "mjcf" / "files")
_NOT_COMPARED = frozenset({
    "names", "paths", "text_data", "names_map", "signature", "buffer", "npaths", "nnames",
    "nnames_map", "nbuffer", "narena", "bvh_aabb", "bvh_child", "bvh_depth", "bvh_nodeid",
})  # fmt: skip
"""Names of their own, memory, and the boxes around geoms: these follow from others, in single precision."""
_PATHS = ("_pathadr", "pathadr")
_TOLERANCE = 1e-9
_POSITIONS = frozenset({"qpos0", "qpos_spring"})
_OF_INERTIA = frozenset({"body_iquat", "body_inertia"})
_OF_DRAWN_TENDONS = frozenset({"tendon_rgba", "tendon_width", "tendon_matid"})
"""A fixed tendon takes these of its class, draws nothing, and has no attributes for them."""


def package_files() -> list[Path]:
    """Return the files of packages whose root is `mujoco`, sorted."""
    return sorted(path for path in PACKAGES.rglob("*.xml") if _is_mjcf(path))


def _is_mjcf(path: Path) -> bool:
    try:
        return etree.parse(path, etree.XMLParser(recover=True)).getroot().tag == "mujoco"
    except (etree.XMLSyntaxError, AttributeError):
        return False


def canonical(path: Path) -> tuple[XmlElement | None, list[Diagnostic]]:
    """Return the canonical tree of a file, or None, and what was found on the way."""
    sink, options = DiagnosticSink(str(path)), LoadOptions.of({"paths": [PACKAGES]})
    text = path.read_bytes()
    try:
        spliced = splice_includes(path, text, sink, options)
    except UnreadableError:
        return None, sink.diagnostics
    root = etree.fromstring(spliced.text if spliced else text, etree.XMLParser(remove_comments=True, remove_pis=True))
    version = known_version("mjcf", versions_of("mjcf")[-1])
    assert version is not None
    return normalize(root, Context(sink, str(path), "mjcf", version), options), sink.diagnostics


def load(mujoco: Any, path: Path) -> Any:
    """Return MuJoCo's model of a file, or None where it refuses the file."""
    try:
        return mujoco.MjModel.from_xml_path(str(path))
    except ValueError:
        return None


def load_canonical(mujoco: Any, path: Path, tree: XmlElement) -> Any:
    """Return MuJoCo's model of a canonical tree, written beside the file that it comes from, so that meshes are found.

    Raises:
        ValueError: MuJoCo refuses it.
    """
    beside = path.with_name(f".canonical-{os.getpid()}-{path.name}")
    try:
        beside.write_bytes(etree.tostring(tree, pretty_print=True))
        return mujoco.MjModel.from_xml_path(str(beside))
    finally:
        beside.unlink(missing_ok=True)


def differences(mujoco: Any, one: Any, other: Any) -> list[str]:
    """Return the fields in which two models of MuJoCo differ by more than 1e-9."""
    import numpy as np  # noqa: PLC0415 - it comes with MuJoCo, which is not everywhere

    found = [name for name, a, b in _arrays(one, other) if not (_are_equal(np, a, b) or _are_turns(np, name, a, b))]
    if _OF_INERTIA.intersection(found) and _are_equal(np, body_inertias(mujoco, one), body_inertias(mujoco, other)):
        # the principal axes of one matrix, in another order or sign
        found = [name for name in found if name not in _OF_INERTIA]
    if "actuator_ctrlrange" in found and _are_equal(np, _controls(np, one), _controls(np, other)):
        found.remove("actuator_ctrlrange")  # some actuators cannot say a range that does not limit
    found = [name for name in found if name not in _POSITIONS or not _are_positions(np, name, one, other)]
    if "names" in found or one.names != other.names:
        found.append("names")
    if _has_fixed_tendons(mujoco, one):
        found = [name for name in found if name not in _OF_DRAWN_TENDONS]
    return [name for name in found if not name.endswith(_PATHS)]


def _arrays(one: Any, other: Any) -> Iterator[tuple[str, Any, Any]]:
    for holder in ("", "opt", "stat", "vis"):
        a, b = (getattr(each, holder) if holder else each for each in (one, other))
        for name in dir(a):
            if name[0] == "_" or name in _NOT_COMPARED or name.startswith("name_"):
                continue
            value = getattr(a, name)
            if hasattr(value, "dtype") or isinstance(value, int | float):
                yield name, value, getattr(b, name)


def _are_equal(np: Any, a: Any, b: Any) -> bool:
    a, b = np.asarray(a), np.asarray(b)
    if a.shape != b.shape:
        return False
    if a.dtype.kind != "f":
        return bool((a == b).all())
    return bool(np.allclose(a, b, rtol=_TOLERANCE, atol=_TOLERANCE, equal_nan=True))


def _are_turns(np: Any, name: str, a: Any, b: Any) -> bool:
    """Tell whether two arrays have the same rotations: a quaternion and its opposite are one."""
    if not name.endswith("quat") or a.shape != b.shape:
        return False
    return bool(np.allclose(np.abs((a * b).sum(axis=-1)), 1.0, rtol=0, atol=_TOLERANCE))


def _are_positions(np: Any, name: str, one: Any, other: Any) -> bool:
    """Tell whether two positions of all joints are the same, whatever the signs of quaternions in them are."""
    a, b = (np.array(getattr(each, name)) for each in (one, other))
    if a.shape != b.shape:
        return False
    for kind, start in zip(one.jnt_type, one.jnt_qposadr, strict=True):
        turn = slice(start + 3, start + 7) if kind == 0 else slice(start, start + 4 * (kind == 1))
        if (a[..., turn] * b[..., turn]).sum() < 0:
            b[..., turn] *= -1
    return _are_equal(np, a, b)


def _controls(np: Any, model: Any) -> Any:
    """Return the ranges of controls, where they limit."""
    return np.where(np.asarray(model.actuator_ctrllimited)[:, None], model.actuator_ctrlrange, 0.0)


def body_inertias(mujoco: Any, model: Any) -> Any:
    """Return the inertia of each body about its own axes."""
    import numpy as np  # noqa: PLC0415 - it comes with MuJoCo, which is not everywhere

    found: list[Any] = []
    for quaternion, moments in zip(model.body_iquat, model.body_inertia, strict=True):
        matrix = np.zeros(9)
        mujoco.mju_quat2Mat(matrix, quaternion)
        turn = matrix.reshape(3, 3)
        found.append(turn @ np.diag(moments) @ turn.T)
    return np.array(found)


def _has_fixed_tendons(mujoco: Any, model: Any) -> bool:
    kinds = {int(kind) for kind in model.wrap_type}
    return int(mujoco.mjtWrap.mjWRAP_JOINT) in kinds
