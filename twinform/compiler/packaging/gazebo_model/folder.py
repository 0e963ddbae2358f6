"""The folder of one model, once its texts and files are known."""

from collections.abc import Iterator, Mapping

from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.gazebo_model.model_config import model_config
from twinform.compiler.packaging.gazebo_model.thumbnail import thumbnail
from twinform.compiler.packaging.order import Order
from twinform.compiler.packaging.package import Content
from twinform.compiler.search.packages import MODEL_CONFIG
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Model
from twinform.ir.scopes import nested_includes
from twinform.schemas import parse_version

_PICTURE = "thumbnails/1.png"
_OF_MODELS = ("model://", "http://", "https://")


def reserve_names(collection: Collection) -> None:
    """Keep the places free that every folder needs."""
    for path in (MODEL_CONFIG, _PICTURE):
        collection.reserve(path)


def sdf_names(versions: Iterator[str]) -> dict[str, str]:
    """The SDF files by their versions, the newest first: `model.sdf` for that, `model-1_9.sdf` for an older one."""
    # Gazebo takes the newest file of model.config that it reads, so one folder serves several
    # releases.
    newest, *older = sorted(set(versions), key=parse_version, reverse=True)
    return {newest: "model.sdf", **{each: f"model-{each.replace('.', '_')}.sdf" for each in older}}


def folder_files(
    name: str, order: Order, texts: Mapping[str, str], document: Document, collection: Collection, sink: DiagnosticSink
) -> dict[str, Content]:
    """All files of a folder; `texts` are by their versions, and `document` is the model in one of them."""
    names = sdf_names(iter(texts))
    files: dict[str, Content] = {file: texts[version].encode() for version, file in names.items()}
    includes = [uri for model in document.models for uri in _includes(model)]
    files[MODEL_CONFIG] = model_config(name, order.details, names, includes)
    if order.thumbnail and (picture := thumbnail(document, collection, sink)):
        files[_PICTURE] = picture
    return collection.files | files


def _includes(model: Model) -> Iterator[str]:
    """The URIs of the models that it includes."""
    found = (include.uri.strip() for include in nested_includes(model) if include.uri)
    return (uri for uri in found if uri.startswith(_OF_MODELS))
