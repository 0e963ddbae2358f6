"""Model folders of Gazebo in a batch: what lies beside a model that its model.config names comes along.

A folder comes with the newest model that its model.config names. Its model.config then names what the models became;
meshes, textures and all other files are copied, but for hidden ones, other models, and links that lead elsewhere.
"""

import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from lxml import etree

from twinform.compiler.batch.entries import PATTERNS, stem
from twinform.compiler.includes.model_config import MANIFESTS, manifest, model_file
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import DiagnosticSink
from twinform.file_access import Readable

_LARGEST = 2**28
"""Bytes of all files that come along with a model."""


class FolderTooLargeError(Exception):
    """There is too much beside a model."""


def folder_files(model: Path, output: str, request: ConversionRequest, version: str | None) -> dict[str, bytes]:
    """What comes along with a model, by its place among the results; nothing where it has no folder of its own.

    `output` is the place of the model among them, and `version` what it has there.

    Raises:
        FolderTooLargeError: there is too much.
        OSError: a file cannot be read.
    """
    config = manifest(model.parent)
    if config is None or not _is_named(config, model):
        return {}
    place = PurePosixPath(output).parent
    files: dict[str, bytes] = {}
    size, readable = 0, Readable.of(model)
    for path in _inside(model.parent):
        data = readable.read(path, _LARGEST)
        size += len(data)
        if size > _LARGEST:
            raise FolderTooLargeError(f"what lies beside it is larger than {_LARGEST >> 20} MiB")
        files[str(place / path.relative_to(model.parent).as_posix())] = data
    files[str(place / config.name)] = _adapted(config, PurePosixPath(output).name, model.name, request, version)
    return files


def _is_named(config: Path, model: Path) -> bool:
    """Whether a model.config names this model as the newest one."""
    named = model_file(config, None, DiagnosticSink())
    # One of the versions has to bring the rest along, so that no two results have one place: the
    # one that a reader would take.
    return named is not None and named.resolve() == model.resolve()


def _inside(folder: Path) -> Iterator[Path]:
    """The files of a folder that are neither models nor those of a model folder in it, sorted."""
    readable = Readable((os.path.realpath(folder),))
    for place, folders, files in os.walk(folder):
        here = Path(place)
        folders[:] = sorted(name for name in folders if not name.startswith(".") and manifest(here / name) is None)
        for name in sorted(files):
            path = here / name
            is_model = any(path.match(pattern) for pattern in PATTERNS)
            if is_model or name.startswith(".") or (here == folder and name in MANIFESTS):
                continue
            if path.is_file() and readable.allows(path):
                yield path


def _adapted(config: Path, output: str, model: str, request: ConversionRequest, version: str | None) -> bytes:
    """A model.config that names what the models became; where all become one version, only the newest model."""
    data = Readable.of(config).read(config)
    try:
        tree = etree.fromstring(data, etree.XMLParser(resolve_entities=False, no_network=True)).getroottree()
    except etree.XMLSyntaxError:
        return data
    for row in list(tree.getroot().iterchildren("sdf")):
        name = PurePosixPath((row.text or "").strip())
        if name.name == model:
            row.text = output
            if request.to == "sdf" and version:
                row.set("version", version)
        elif request.to == "sdf" and request.sdf_version is not None:
            tree.getroot().remove(row)
        elif name.suffix.lower() in {".sdf", ".urdf"}:
            row.text = f"{stem(str(name))}.{request.to}"
    return etree.tostring(tree, xml_declaration=True, encoding="UTF-8") + b"\n"
