"""Model folders of Gazebo in a batch: the files beside a model that a model.config names are copied along.

The files of a folder come with the newest model that its model.config names: meshes, textures and all others, without
hidden files, other models, and links that lead elsewhere. The copied model.config names the results.
"""

import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from lxml import etree

from twinform.compiler.batch.entries import PATTERNS, stem
from twinform.compiler.model_config import MANIFESTS, manifest, model_file
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import DiagnosticSink
from twinform.file_access import Readable

_LARGEST = 2**28
"""Bytes of all files that are copied along with a model."""


class FolderTooLargeError(Exception):
    """The files beside a model are too large."""


def folder_files(model: Path, output: str, request: ConversionRequest, version: str | None) -> dict[str, bytes]:
    """Return the files to copy along with a model, by their paths among the results; none if it has no model folder.

    `output` is the path of the model among the results, and `version` its SDF version there.

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
    for path in _find_files(model.parent):
        data = readable.read(path, _LARGEST)
        size += len(data)
        if size > _LARGEST:
            raise FolderTooLargeError(f"what lies beside it is larger than {_LARGEST >> 20} MiB")
        files[str(place / path.relative_to(model.parent).as_posix())] = data
    files[str(place / config.name)] = _adapt_config(config, PurePosixPath(output).name, model.name, request, version)
    return files


def _is_named(config: Path, model: Path) -> bool:
    """Return whether a model.config names this model as the newest one."""
    named = model_file(config, None, DiagnosticSink())
    # One of the versions has to bring the rest along, so that no two results have one place: the
    # one that a reader would take.
    return named is not None and named.resolve() == model.resolve()


def _find_files(folder: Path) -> Iterator[Path]:
    """Yield the files of a folder, sorted, without models and model folders in it."""
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


def _adapt_config(config: Path, output: str, model: str, request: ConversionRequest, version: str | None) -> bytes:
    """Return the model.config with the names of results; only the newest model if all get the same SDF version."""
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
