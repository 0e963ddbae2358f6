"""What engines that know no carriers see of an edited file and its result, where one of them is MJCF.

MuJoCo reads MJCF, and URDF as it stands; Drake reads SDF. Meshes are left out: what is edited here has no files.
"""

import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from itertools import combinations
from pathlib import Path
from typing import Any

from lxml import etree

from testbed.edits.edited_file import OURS, EditedFile, end, geom_in
from twinform.schemas import XmlElement

_DIGITS = 6
_SPRINGS = ("stiffness of joint ", "spring of joint ")


class NotReadError(Exception):
    """An engine does not read an edited file, or is not installed."""

    def __init__(self, engine: str) -> None:
        super().__init__(f"{engine} does not read it")
        self.engine = engine


def differences_in_engines(file: EditedFile, result: str, back: str) -> Iterator[str]:
    """Yield what differs between the robot of an edited file and that of its result, of which one is MJCF.

    Raises:
        NotReadError: the edited file is not read.
    """
    if find_spec("mujoco") is None:
        raise NotReadError("MuJoCo, which is not here")
    match file.language:
        case "mjcf":
            yield from _of_mjcf(file, result, back)
        case "urdf":
            yield from _of_urdf(file, result)
        case "sdf":
            yield from _of_sdf(file, result)


def is_refused_by_mujoco(file: EditedFile) -> bool:
    """Whether MuJoCo does not read an edited MJCF either."""
    try:
        _compiled(file)
    except NotReadError:
        return True
    return False


def _compiled(file: EditedFile) -> Any:
    # these modules need numpy, which not everybody has who runs the tests of the other languages
    from testbed.mjcf.compiled import UnreadableError, compile_mjcf, without_meshes  # noqa: PLC0415

    try:
        return compile_mjcf(without_meshes(file.text.decode()))
    except UnreadableError as error:
        raise NotReadError("MuJoCo") from error


def _of_mjcf(file: EditedFile, result: str, back: str) -> Iterator[str]:
    from testbed.mjcf.compiled import UnreadableError, compile_mjcf, without_meshes  # noqa: PLC0415
    from testbed.mjcf.differences import differences, matched_geoms  # noqa: PLC0415

    source = _compiled(file)
    try:
        made = compile_mjcf(without_meshes(_without_carried(file, back)))
    except UnreadableError as error:
        yield f"MuJoCo refuses the result: {error}"
        return
    renamed = {f"body {each!r} is missing" for each in file.sites_of_sensors}  # sensors are compared themselves
    yield from (each for each in differences(source, made) if each not in renamed)
    # A model without a name in MJCF has one in URDF alone; the name of the file was that of the world around it.
    has_name = etree.fromstring(result.encode()).find(f"{OURS}made-name") is None
    yield from _of_looks(source, made, has_name=has_name)
    yield from _of_contacts(source.model, made.model, matched_geoms(source, made))


def _without_carried(file: EditedFile, back: str) -> str:
    """MJCF without the geoms of shapes that the edited file could not have, such as a plane of what moved before."""
    if not file.carried_shapes:
        return back
    root = etree.fromstring(back.encode())
    for geom in [*root.iter("geom")]:
        around = geom.getparent()
        if around is not None and geom_in(geom) in file.carried_shapes:
            around.remove(geom)
    return etree.tostring(root, encoding="unicode")


def _of_looks(one: Any, other: Any, *, has_name: bool) -> Iterator[str]:
    """Yield what differs in colors, in friction, in the name, and in how many parts there are of each kind."""
    for name, of_one in _looks(one).items():
        if name == "model" and not has_name:
            continue
        if of_one != (of_other := _looks(other)[name]):
            yield f"{name}: only before {list(of_one - of_other)[:2]}, only after {list(of_other - of_one)[:2]}"


def _of_urdf(file: EditedFile, result: str) -> Iterator[str]:
    from testbed.mjcf.compiled import UnreadableError, compile_mjcf, compile_urdf, without_meshes  # noqa: PLC0415
    from testbed.mjcf.differences import differences  # noqa: PLC0415

    if is_static(file.root):
        raise NotReadError("MuJoCo, which does not know what is static")
    try:
        source = compile_urdf(_without_meshes_of_urdf(file), absent_is_nothing=True)
    except UnreadableError as error:
        raise NotReadError("MuJoCo") from error
    try:
        made = compile_mjcf(_held(without_meshes(result), file))
    except UnreadableError as error:
        yield f"MuJoCo refuses the result: {error}"
        return
    # URDF has springs in <gazebo> alone, which MuJoCo does not read
    yield from (each for each in differences(source, made) if not each.startswith(_SPRINGS))


def is_static(robot: XmlElement) -> bool:
    """Whether a URDF is static in Gazebo; of one that was read of MJCF that only says that nothing moves."""
    found = (each.text or "" for each in robot.iterfind("gazebo/static"))
    return robot.find(f"{OURS}mjcf") is None and any(each.strip() in {"true", "1"} for each in found)


def _of_sdf(file: EditedFile, result: str) -> Iterator[str]:
    from testbed.mjcf.compiled import UnreadableError, compile_mjcf, without_meshes  # noqa: PLC0415
    from testbed.mjcf.from_drake import UncomparableError, differences_from_drake  # noqa: PLC0415
    from twinform.testing.oracles import drake  # noqa: PLC0415

    try:
        made = compile_mjcf(without_meshes(result))
    except UnreadableError as error:
        yield f"MuJoCo refuses the result: {error}"
        return
    if find_spec("pydrake") is None:
        raise NotReadError("Drake, which is not here")
    if len([*file.root.iterfind("world/model"), *file.root.iterfind("model")]) > 1:
        raise NotReadError("Drake, which is asked for the first model")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "edited.sdf"
        path.write_bytes(file.text)
        try:
            drake.parts(path)
        except Exception as error:  # Drake has no narrower type
            raise NotReadError("Drake") from error
        try:
            # Drake reads no gravity of a file, and a model keeps that of MJCF as what only MJCF says.
            yield from differences_from_drake(path, made, gravity=tuple(map(float, made.model.opt.gravity)))
        except UncomparableError as error:
            raise NotReadError("Drake with a joint that is compared") from error


def _without_meshes_of_urdf(file: EditedFile) -> bytes:
    root = etree.fromstring(file.text)
    for mesh in [*root.iter("mesh")]:
        shape = mesh.getparent()
        around = shape.getparent() if shape is not None else None
        if around is not None and (link := around.getparent()) is not None:
            link.remove(around)
    return etree.tostring(root)


def _held(text: str, urdf: EditedFile) -> str:
    """MJCF with its robots held at the world, as MuJoCo has all of URDF but what floats there."""
    root = etree.fromstring(text.encode())
    floating = {end(each, "child"): each.get("name", "") for each in urdf.root.iterfind("joint[@type='floating']")}
    for joint in [*root.iterfind("worldbody/body/freejoint"), *root.iterfind("worldbody/body/joint[@type='free']")]:
        body = joint.getparent()
        if body is not None and (name := floating.get(body.get("name") or "")):
            joint.set("name", name)
        elif body is not None:
            body.remove(joint)
    for each in root.findall("keyframe"):  # it has a number for each freedom
        root.remove(each)
    return etree.tostring(root, encoding="unicode")


def _looks(compiled: Any) -> dict[str, Counter[object]]:
    model = compiled.model
    touched = [bool(a or b) for a, b in zip(model.geom_contype, model.geom_conaffinity, strict=True)]
    numbers = range(model.ngeom)
    return {
        "model": Counter((bytes(model.names).partition(b"\0")[0],)),
        "colors": Counter(tuple(model.geom_rgba[each].round(_DIGITS)) for each in numbers if not touched[each]),
        "friction": Counter(round(float(model.geom_friction[each][0]), _DIGITS) for each in numbers if touched[each]),
        "actuators": Counter(
            (int(model.actuator_trntype[each]), *_rounded(model.actuator_gear[each], model.actuator_gainprm[each][:3]))
            for each in range(len(model.actuator_trntype))  # one may have several controls
        ),
        "sensors": Counter(int(each) for each in model.sensor_type),
        "equalities": Counter(
            (int(model.eq_type[each]), *_rounded(model.eq_data[each][:5])) for each in range(model.neq)
        ),
    }


def _rounded(*arrays: Any) -> tuple[float, ...]:
    return tuple(float(number) for array in arrays for number in array.round(_DIGITS))


def _of_contacts(source: Any, made: Any, matched: Iterable[tuple[int, int]]) -> Iterator[str]:
    """Yield what differs in which geoms may touch; those that have no counterpart differ by themselves."""
    pairs = tuple(matched)
    number = {second: first for first, second in pairs}
    of_one = set(_touching(source, sorted(first for first, _ in pairs)))
    touching = ((number[first], number[second]) for first, second in _touching(made, sorted(number)))
    of_other = {(min(pair), max(pair)) for pair in touching}
    if of_one != of_other:
        before, after = (
            [_geom_names(source, pair) for pair in sorted(some)[:2]] for some in (of_one - of_other, of_other - of_one)
        )
        yield f"contacts: only before {before}, only after {after}"


def _geom_names(model: Any, pair: tuple[int, int]) -> tuple[str, ...]:
    return tuple(model.geom(each).name or f"geom {each}" for each in pair)


def _touching(model: Any, geoms: Iterable[int]) -> Iterator[tuple[int, int]]:
    """Yield the pairs of geoms that may touch, by their bits, by what is excluded and by what holds what."""
    excluded = {(int(each) >> 16, int(each) & 0xFFFF) for each in model.exclude_signature}
    joined = [
        {int(model.eq_obj1id[each]), int(model.eq_obj2id[each])} for each in range(model.neq) if _joins(model, each)
    ]
    types, affinities, bodies = model.geom_contype.tolist(), model.geom_conaffinity.tolist(), model.geom_bodyid.tolist()
    for first, second in combinations(geoms, 2):
        if not types[first] & affinities[second] and not types[second] & affinities[first]:
            continue
        one, other = bodies[first], bodies[second]
        if model.body_weldid[one] == model.body_weldid[other] or excluded & {(one, other), (other, one)}:
            continue
        held = [_held_as_one(model, each) for each in (one, other)]
        above = [_held_as_one(model, int(model.body_parentid[each])) for each in held]
        # URDF and SDF say nothing of contacts between two links that a joint connects, one that closes a loop too
        if 0 in {one, other} or (held[0] != above[1] and held[1] != above[0] and {one, other} not in joined):
            yield first, second


def _joins(model: Any, equality: int) -> bool:
    """Whether an equality holds two bodies to each other: `connect` or `weld`."""
    return int(model.eq_type[equality]) in {0, 1} and int(model.eq_objtype[equality]) == 1


def _held_as_one(model: Any, body: int) -> int:
    """The topmost body that a body is fixed to, below the world."""
    while body and not model.body_jntnum[body] and model.body_parentid[body]:
        body = int(model.body_parentid[body])
    return body
