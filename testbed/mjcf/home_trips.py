"""MJCF that became SDF or URDF and then MJCF again: MuJoCo's model array by array, and the normal form.

The order of elements is no part of a robot, so what came back is first put into the order of the source. An inertia
that the source leaves to MuJoCo is written in what comes back: there it is compared in MuJoCo's arrays alone.
"""

import os
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np

from testbed.mjcf.canonical_models import body_inertias, canonical, differences, load_canonical
from twinform.compiler.normal_form import NormalForm
from twinform.schemas import XmlElement
from twinform.schemas.mjcf_references import own_references

_COMPUTED = frozenset({
    "bvh_aabb", "geom_sameframe", "body_sameframe", "dof_length", "meansize", "meanmass", "body_simple",
    "dof_simplenum", "site_sameframe", "meaninertia",
    "M_colind", "M_rowadr", "M_rownnz", "mapD2M", "mapM2D", "mapM2M", "nC",
})  # fmt: skip
"""Arrays that MuJoCo computes of others, with single bits for whether these are exactly equal.

The mass matrix is stored without its zeros where MuJoCo finds a body simple.
"""
_FLOATS = 1e-5
_OF_MASS = frozenset({
    "body_mass", "body_subtreemass", "body_ipos", "body_inertia", "body_iquat", "body_invweight0", "dof_invweight0",
    "dof_M0", "actuator_acc0", "tendon_invweight0", "center", "extent", "light_poscom0", "cam_poscom0",
})  # fmt: skip
"""Arrays that follow from the masses and centers of bodies."""
_ON_SLIDES = 2
"""What `body_simple` is of a body that only slides move."""
_OF_INERTIA = frozenset({"body_iquat", "body_inertia"})
_SIZES = {"sphere": 1, "cylinder": 2, "capsule": 2}
"""How many numbers the size of a shape has, where it has not three."""
_OF_PARTS = frozenset({"equality", "actuator", "contact", "sensor"})
"""Sections whose elements are known by what they refer to. What a joint or body of SDF says comes before the others."""
_CHANGING = frozenset({"settotalmass", "boundmass", "boundinertia", "balanceinertia"})
"""Settings of the compiler that change written masses."""
_OF_MASSES = _CHANGING | {"inertiafromgeom", "inertiagrouprange"}
"""How MuJoCo computes masses that are written in what comes back."""


def came_home(mujoco: Any, path: Path, model: Any, text: str) -> list[str]:
    """Return what differs between a file, of which MuJoCo makes a model, and the text that came back of it.

    Raises:
        ValueError: MuJoCo refuses the text, or it is not canonical.
    """
    source, _ = canonical(path)
    beside = path.with_name(f".back-{os.getpid()}-{path.name}")
    try:
        beside.write_text(text)
        back, found = canonical(beside)
    finally:
        beside.unlink()
    if source is None or back is None:
        raise ValueError("; ".join(each.message for each in found) or "it has no canonical form")
    put_in_order(source, back)
    model, home = _compile(mujoco, path, model, source, back)
    arrays = set(differences(mujoco, model, home)) - _COMPUTED
    if _is_weighed_shortly(model, home):
        arrays.discard("body_invweight0")
    if model.nmesh:
        arrays -= _of_single_precision(mujoco, model, home, arrays)
    return [*(f"array {each}" for each in sorted(arrays)), *_in_normal_form(source, back)]


def _compile(mujoco: Any, path: Path, model: Any, source: XmlElement, back: XmlElement) -> tuple[Any, Any]:
    """Return MuJoCo's models of both trees.

    Where a free body is put into its principal axes, of which any order will do, both are compiled as they are drawn.
    """
    if source.find(".//freejoint[@align]") is None and source.find("compiler[@alignfree]") is None:
        return model, load_canonical(mujoco, path, back)
    drawn = deepcopy(source), deepcopy(back)
    for tree in drawn:
        for each in tree.iter("freejoint", "joint", "compiler"):
            each.attrib.pop("align", None)
            each.attrib.pop("alignfree", None)
    one, other = (load_canonical(mujoco, path, each) for each in drawn)
    return one, other


def _is_weighed_shortly(one: Any, other: Any) -> bool:
    """Tell whether inverse weights differ only of bodies on slides that one model alone has as simple.

    Of a body that nothing but slides move, and whose inertial frame is exactly its own, MuJoCo takes 1 / mass: three
    times what it has for one slide and the same matrix about axes in another order. All that it computes them of is
    compared by itself.
    """
    if one.nbody != other.nbody:
        return False
    differs = ~np.isclose(one.body_invweight0, other.body_invweight0, rtol=1e-9, atol=1e-9).all(axis=1)
    simple = one.body_simple == _ON_SLIDES
    return bool((differs <= (simple != (other.body_simple == _ON_SLIDES))).all())


def _of_single_precision(mujoco: Any, one: Any, other: Any, names: set[str]) -> set[str]:
    """Return the arrays whose difference is that of the points of meshes, which MuJoCo has in single precision."""
    close = {each for each in _OF_MASS & names if _are_close(_array(one, each), _array(other, each))}
    # of two nearly equal moments the axes are chance, and of one matrix in another order
    is_alike = _OF_INERTIA & names and _are_close(*(body_inertias(mujoco, each) for each in (one, other)))
    return close | (_OF_INERTIA if is_alike else set())


def _array(model: Any, name: str) -> Any:
    return np.asarray(getattr(model, name) if hasattr(model, name) else getattr(model.stat, name))


def _are_close(one: Any, other: Any) -> bool:
    """Tell whether masses are the same but for the points of meshes, which MuJoCo has in single precision."""
    return one.shape == other.shape and bool(
        np.allclose(one, other, rtol=_FLOATS, atol=_FLOATS * float(np.max(np.abs(one))))
    )


def _in_normal_form(source: XmlElement, back: XmlElement) -> Iterator[str]:
    settings = {name: value for each in source.iter("compiler") for name, value in each.items()}
    is_changed = settings.get("inertiafromgeom") == "true" or bool(_CHANGING.intersection(settings))
    for body, other in zip(source.iter("body"), back.iter("body"), strict=False):
        for tree in (body, other) if is_changed or body.find("inertial") is None else ():
            for inertial in tree.findall("inertial"):
                tree.remove(inertial)
    for tree in (source, back):
        _spell_alike(tree)
    for each in NormalForm.of(source).compare(NormalForm.of(back)):
        yield f"{each.kind}: {each.message.partition(': ')[2]}"


def _spell_alike(tree: XmlElement) -> None:
    """Leave out what a canonical tree may say and need not."""
    for each in tree.iter():
        for name in [name for name, value in each.items() if name.endswith("limited") and value == "false"]:
            del each.attrib[name]
        if each.tag == "compiler":
            for name in _OF_MASSES.intersection(each.keys()):
                del each.attrib[name]
        elif each.tag == "joint" and each.get("type") == "ball":
            each.attrib.pop("axis", None)  # of a class, for joints of other types
        elif each.tag == "light" and each.attrib.pop("directional", "false") == "true":
            each.set("type", "directional")
        elif each.tag in {"geom", "site"} and (size := each.get("size")) is not None:
            each.set("size", " ".join(size.split()[: _SIZES.get(each.get("type") or "sphere")]))


def put_in_order(source: XmlElement, back: XmlElement) -> None:
    """Put the elements of a canonical tree into the order of another one: by name, or else as like ones follow."""
    waiting: dict[tuple[str, ...], list[XmlElement]] = {}
    for each in back:
        waiting.setdefault(_key(each), []).append(each)
    pairs = [(each, found.pop(0)) for each in source if (found := waiting.get(_key(each)))]
    left = [each for found in waiting.values() for each in found]
    for each in list(back):
        back.remove(each)
    back.extend([*(each for _, each in pairs), *left])
    for each, other in pairs:
        put_in_order(each, other)


def _key(element: XmlElement) -> tuple[str, ...]:
    name = element.get("name") or ""
    if element.tag == "geom":
        touches = (element.get("contype"), element.get("conaffinity")) != ("0", "0")
        return "geom", name, str(touches), element.get("type") or "sphere"
    if element.tag == "light" and not name:  # SDF has those that follow nothing, before the others
        return "light", name, element.get("mode") or ""
    parent = element.getparent()
    if parent is not None and parent.tag in _OF_PARTS and not name:
        return str(element.tag), *sorted(f"{each.attribute}={each.name}" for each in own_references(element))
    return str(element.tag), name
