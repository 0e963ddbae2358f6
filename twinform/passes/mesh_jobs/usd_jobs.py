"""Jobs on USD: what a layer holds and names, and the prims of the stage that layers compose.

All layers are anonymous, and whatever they name is another one of them: USD itself opens no file.
"""

import importlib
import io
import zipfile
from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice
from typing import Any

from twinform.passes.mesh_jobs.job import MeshJob, MeshResult
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError

Sdf: Any = importlib.import_module("pxr.Sdf")
Tf: Any = importlib.import_module("pxr.Tf")
Usd: Any = importlib.import_module("pxr.Usd")
UsdGeom: Any = importlib.import_module("pxr.UsdGeom")

_LONGEST_ARRAY = 64
"""Items of an array that is kept: points of meshes say nothing about joints and masses."""
_MOST_PRIMS = 100_000
"""Prims of a stage, those of instances among them: references to references make many out of little."""
_APPEARANCE = frozenset({"Material", "Shader", "NodeGraph", "GeomSubset"})
_SHAPES = frozenset({"size", "radius", "height", "axis", "width", "length", "radiusTop", "radiusBottom"})
"""Attributes of shapes, which have a value where none is written."""
_ASIDE = ("primvars:", "xformOp:", "inputs:", "outputs:", "ui:")
_WARM_UP = '#usda 1.0\ndef Cube "x" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {\n}'


def warm_up() -> None:
    """Have USD load its plugins, which it could not do any more once the process is confined."""
    importlib.import_module("encodings.cp437")  # of names in packages
    layer = _text_layer("warm", _WARM_UP.encode())
    opened = Usd.Stage.Open(layer)
    for prim in opened.Traverse():
        _facts_of(prim, UsdGeom.XformCache())
    Sdf.FileFormat.FindById("usdc")


def layer(job: MeshJob) -> MeshResult:
    """The text of a layer without long arrays, and the assets that it is composed of; or the files of a package."""
    if job.kind == "usdz":
        return MeshResult({}, dict(_members(job.content)))
    opened = _opened(job)
    _remove_bulk(opened)
    assets = sorted(each for each in opened.GetCompositionAssetDependencies() if each)
    return MeshResult({"assets": assets}, {"text": opened.ExportToString().encode()})


def stage(job: MeshJob) -> MeshResult:
    """The facts about the prims of a stage; `links` has triples: a layer, an asset, and the layer that it means."""
    texts = [job.content, *job.companions.values()]
    layers = [_checked(partial(_text_layer, str(number), text)) for number, text in enumerate(texts)]
    links: Any = job.options["links"]
    for at, asset, there in zip(*[iter(links)] * 3, strict=True):
        layers[at].UpdateCompositionAssetDependency(asset, layers[there].identifier)
    opened = _checked(lambda: Usd.Stage.Open(layers[0]))
    root = opened.GetDefaultPrim()
    facts: dict[str, object] = {
        "up": str(UsdGeom.GetStageUpAxis(opened)),
        "meters": UsdGeom.GetStageMetersPerUnit(opened),
        "kilograms": opened.GetMetadata("kilogramsPerUnit") or 1.0,
        "default": str(root.GetPath()) if root else "",
        "errors": [_first_line(str(each)) for each in opened.GetCompositionErrors()],
        "prims": list(_prims(opened)),
    }
    return MeshResult(facts)


def _members(content: bytes) -> Iterator[tuple[str, bytes]]:
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as package:
            for info in package.infolist():
                if info.compress_type != zipfile.ZIP_STORED or info.flag_bits & 1:
                    raise RefusedMeshError(f"{info.filename!r} in the package is compressed, which USDZ does not allow")
                if not info.is_dir():
                    yield info.filename, package.read(info)
    except (zipfile.BadZipFile, EOFError, ValueError) as error:
        raise RefusedMeshError(f"the package is broken: {error}") from error


def _opened(job: MeshJob) -> Any:
    if job.kind == "usdc":
        return _checked(lambda: Sdf.Layer.OpenAsAnonymous(str(job.options["file"])))
    return _checked(partial(_text_layer, "layer", job.content))


def _text_layer(name: str, text: bytes) -> Any:
    made = Sdf.Layer.CreateAnonymous(f"{name}.usda")
    return made if made.ImportFromString(text.decode()) else None


def _checked(make: Callable[[], Any]) -> Any:
    """The result of a call of USD, whose errors become one line."""
    try:
        made = make()
    except UnicodeDecodeError as error:
        raise RefusedMeshError("it is neither a text of USD in UTF-8 nor a binary layer") from error
    except Tf.ErrorException as error:
        raise RefusedMeshError(_first_line(str(error.args[0].commentary if error.args else error))) from error
    if not made:
        raise RefusedMeshError("USD makes nothing of it")
    return made


def _first_line(text: str) -> str:
    return next((line.strip() for line in text.splitlines() if line.strip()), "")


def _remove_bulk(opened: Any) -> None:
    """Remove long arrays, and value clips: these name files that nothing would look up for them."""

    def visit(path: Any) -> None:
        spec = opened.GetObjectAtPath(path)
        if isinstance(spec, Sdf.AttributeSpec):
            if _is_long(spec.default):
                spec.ClearDefaultValue()
            for time in opened.ListTimeSamplesForPath(path):
                opened.EraseTimeSample(path, time)
        elif isinstance(spec, Sdf.PrimSpec) and spec.HasInfo("clips"):
            spec.ClearInfo("clips")

    opened.Traverse(Sdf.Path.absoluteRootPath, visit)


def _is_long(value: Any) -> bool:
    return not isinstance(value, str) and hasattr(value, "__len__") and len(value) > _LONGEST_ARRAY


def _prims(opened: Any) -> Iterator[dict[str, object]]:
    cache = UsdGeom.XformCache()
    found: list[Any] = list(islice(opened.Traverse(Usd.TraverseInstanceProxies()), _MOST_PRIMS + 1))
    if len(found) > _MOST_PRIMS:
        raise RefusedMeshError(f"the stage has more than {_MOST_PRIMS:,} prims")
    for prim in found:
        if str(prim.GetTypeName()) not in _APPEARANCE or prim.GetAppliedSchemas():
            yield _facts_of(prim, cache)


def _facts_of(prim: Any, cache: Any) -> dict[str, object]:
    matrix = cache.GetLocalToWorldTransform(prim)
    relationships = (each for each in prim.GetRelationships() if each.HasAuthoredTargets())
    return {
        "path": str(prim.GetPath()),
        "type": str(prim.GetTypeName()),
        "schemas": list(map(str, prim.GetPrimTypeInfo().GetAppliedAPISchemas())),
        "name": prim.GetDisplayName(),
        "matrix": [number for row in matrix for number in row],
        "values": dict(_values(prim)),
        "targets": {each.GetName(): list(map(str, each.GetTargets())) for each in relationships},
    }


def _values(prim: Any) -> Iterator[tuple[str, object]]:
    for attribute in prim.GetAttributes():
        name = attribute.GetName()
        wanted = name in _SHAPES or (":" in name and not name.startswith(_ASIDE) and attribute.HasAuthoredValue())
        value = _as_json(attribute.Get()) if wanted else None
        if value is not None:
            yield name, value


def _as_json(value: Any) -> object:
    """A value as JSON has it: a quaternion as its real part and three others; None for what is not needed."""
    if isinstance(value, bool | int | float | str):
        return value
    if hasattr(value, "GetImaginary"):
        return [value.GetReal(), *value.GetImaginary()]
    if hasattr(value, "__len__") and len(value) <= _LONGEST_ARRAY:
        parts = list(value)
        return parts if all(isinstance(part, bool | int | float | str) for part in parts) else None
    return None
