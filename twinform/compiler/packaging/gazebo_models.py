"""Builds model folders of Gazebo: a model.config, an SDF file for each version, meshes, textures and a thumbnail.

Each model of a world gets a folder of its own, beside the world that includes them:

    worlds/warehouse.sdf   models/shelf/model.config   models/shelf/model.sdf   models/shelf/meshes/...

Models that the world already includes, by `model://` or from Fuel, stay where they are.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field, replace
from pathlib import Path, PurePosixPath

from lxml import etree

from twinform.compiler.input.loading import read
from twinform.compiler.packaging.collect_files import CollectFiles
from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.order import Built, Order, PackageDetails
from twinform.compiler.packaging.package import Content, Package, PackageLayout
from twinform.compiler.packaging.thumbnail import thumbnail
from twinform.compiler.resolve_uris import LocalAssets
from twinform.compiler.ros_packages import MODEL_CONFIG
from twinform.compiler.split_world import Placement, split
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Ledger
from twinform.diagnostics.rules import UNPACKAGED_INCLUDE
from twinform.ir import Document, Model
from twinform.ir.scopes import nested_includes
from twinform.passes import Pipeline
from twinform.passes.legalise.to_urdf.select_model import SelectModel
from twinform.schemas import DEFAULT_SDF_VERSION, XmlElement, parse_version


def build(order: Order, collection: Collection) -> Built:
    """Build the folder of a model, or those of the models of a world.

    Raises:
        CompileError: the model or a file of it has an error, or there are several models.
    """
    if is_world(order):
        return build_world(order)
    order = _require_one_model(order)
    reserve_names(collection)
    made = [order.convert(collection, "sdf", version) for version in order.sdf_versions or (None,)]
    by_version = {conversion.document.version or "": conversion for conversion in made}
    texts = {version: conversion.text for version, conversion in by_version.items()}
    sink = DiagnosticSink(order.source_name)
    files = folder_files(order.name, order, texts, made[0].document, collection, sink)
    found = dict.fromkeys(each for conversion in made for each in conversion.diagnostics)
    ledgers = {file: by_version[version].ledger for version, file in sdf_names(iter(texts)).items()}
    return Built(Package(order.folder, files), (*found, *sink.diagnostics), ledgers)


def _require_one_model(order: Order) -> Order:
    """Return the order with a pass that refuses a file of several models if none is named."""
    if order.conversion.model is not None:
        return order
    passes = Pipeline((*order.conversion.passes, SelectModel.unchecked(model=None)))
    return replace(order, conversion=replace(order.conversion, passes=passes))


_SCHEME = "model://"


def is_world(order: Order) -> bool:
    """Whether a file has worlds, and no model of it is asked for alone."""
    if order.conversion.model is not None:
        return False
    document = read(order.source, order.load_options, name=order.source_name).document
    return document is not None and bool(document.worlds)


def build_world(order: Order) -> Built:
    """Build the folders of a world and its models.

    Raises:
        CompileError: the world or a file of it has an error.
    """
    folders = _WorldFolders(order)
    found: list[Diagnostic] = []
    ledgers: dict[str, Ledger] = {}
    for version in order.sdf_versions or (None,):
        request = replace(order.conversion, to="sdf", sdf_version=version)
        placement = Placement(_model_uri, folders.collect_and_rewrite)
        made = split(request, order.source, order.load_options, name=order.source_name, placement=placement)
        found += made.diagnostics
        ledgers[folders.add(made.files, version)] = made.ledger
    sink = DiagnosticSink(order.source_name)
    package = Package(order.name, folders.files(sink))
    return Built(package, (*dict.fromkeys(found), *sink.diagnostics), ledgers)


def _model_uri(file: str) -> str:
    """Return the URI by which the world includes a model."""
    # As in all collections of models for Gazebo. Includes that were there stay: they are somebody
    # else's models, with a version of their own.
    return _SCHEME + PurePosixPath(file).stem


@dataclass(slots=True)
class _WorldFolders:
    """The folders of models by name, each with its files, its document, and its text in each version."""

    order: Order
    around: Collection = field(init=False)
    models: dict[str, Collection] = field(default_factory=dict[str, Collection])
    documents: dict[str, Document] = field(default_factory=dict[str, Document])
    texts: dict[str, dict[str, str]] = field(default_factory=dict[str, dict[str, str]])
    worlds: dict[str, Content] = field(default_factory=dict[str, Content])

    def __post_init__(self) -> None:
        self.around = Collection(PackageLayout({}), self.order.allow_missing)

    def collect_and_rewrite(self, document: Document, file: str, sink: DiagnosticSink) -> Document:
        """Collect the files of a document, and write their URIs in its folder."""
        folder = PurePosixPath(file).stem
        if document.worlds:
            self._require_other_names(document, sink)
            collection = self.around
        elif folder in self.models:
            collection = self.models[folder]
        else:
            collection = self.models[folder] = Collection(PackageLayout({"model": folder}), self.order.allow_missing)
            reserve_names(collection)
        assets = LocalAssets(self.order.load_options.search, Path(sink.file))
        document = CollectFiles.into(collection).with_assets(assets).run(document, sink)
        self.documents.setdefault(folder, document)
        return document

    def add(self, files: Mapping[str, str], version: str | None) -> str:
        """Add the texts of all files in one version, the world last, and return the place of the world."""
        *models, world = files
        written = version or self.documents[PurePosixPath(world).stem].version or DEFAULT_SDF_VERSION
        for file in models:
            self.texts.setdefault(PurePosixPath(file).stem, {})[written] = files[file]
        stem, suffix = PurePosixPath(world).stem, PurePosixPath(world).suffix
        place = f"worlds/{stem}-{written.replace('.', '_')}{suffix}" if self.worlds else f"worlds/{world}"
        self.worlds[place] = files[world].encode()
        return place

    def files(self, sink: DiagnosticSink) -> dict[str, Content]:
        """Return all files of the package."""
        files = {f"worlds/{path}": content for path, content in self.around.files.items()} | self.worlds
        for name, texts in self.texts.items():
            own = folder_files(name, self.order, texts, self.documents[name], self.models[name], sink)
            files |= {f"models/{name}/{path}": content for path, content in own.items()}
        return files

    def _require_other_names(self, document: Document, sink: DiagnosticSink) -> None:
        """Report models that the world includes from elsewhere under the name of one that gets a folder here."""
        places = [include for world in document.worlds for include in world.includes] + list(document.includes)
        uris = Counter((include.uri or "").strip().rstrip("/") for include in places)
        for include in places:
            uri = (include.uri or "").strip().rstrip("/")
            if uri.removeprefix(_SCHEME) in self.models and uris[uri] > 1:
                message = f"{uri!r} would lead to the folder of another model of the package"
                advice = "put it in its place with --expand-includes, or rename the other model"
                sink.report(UNPACKAGED_INCLUDE, message, include.location, found=uri, help=advice)
                uris[uri] = 0


_PICTURE = "thumbnails/1.png"
_OF_MODELS = ("model://", "http://", "https://")


def reserve_names(collection: Collection) -> None:
    """Keep the places free that every model folder needs."""
    for path in (MODEL_CONFIG, _PICTURE):
        collection.reserve(path)


def sdf_names(versions: Iterator[str]) -> dict[str, str]:
    """Return the SDF files by version, the newest first: `model.sdf` for that, `model-1_9.sdf` for an older one."""
    # Gazebo takes the newest file of model.config that it reads, so one folder serves several
    # releases.
    newest, *older = sorted(set(versions), key=parse_version, reverse=True)
    return {newest: "model.sdf", **{each: f"model-{each.replace('.', '_')}.sdf" for each in older}}


def folder_files(
    name: str, order: Order, texts: Mapping[str, str], document: Document, collection: Collection, sink: DiagnosticSink
) -> dict[str, Content]:
    """Return all files of a model folder; `texts` has its SDF by version, and `document` is one of them."""
    names = sdf_names(iter(texts))
    files: dict[str, Content] = {file: texts[version].encode() for version, file in names.items()}
    includes = [uri for model in document.models for uri in _included_models(model)]
    files[MODEL_CONFIG] = model_config(name, order.details, names, includes)
    if order.thumbnail and (picture := thumbnail(document, collection, sink)):
        files[_PICTURE] = picture
    return collection.files | files


def _included_models(model: Model) -> Iterator[str]:
    """Return the URIs of the models that a model includes."""
    found = (include.uri.strip() for include in nested_includes(model) if include.uri)
    return (uri for uri in found if uri.startswith(_OF_MODELS))


def model_config(
    name: str, details: PackageDetails, sdf_files: Mapping[str, str], includes: Iterable[str] = ()
) -> bytes:
    """Write a model.config.

    `sdf_files` are the SDF files by version, the newest first: Gazebo takes the newest that it reads. `includes` are
    the URIs of models that this one depends on.
    """
    root = etree.Element("model")
    _add_element(root, "name", name)
    _add_element(root, "version", details.version)
    for version, file in sdf_files.items():
        _add_element(root, "sdf", file).set("version", version)
    author = etree.SubElement(root, "author")
    _add_element(author, "name", details.author or details.maintainer)
    _add_element(author, "email", details.email)
    _add_element(root, "description", details.description)
    uris = sorted(set(includes))
    if uris:
        depend = etree.SubElement(root, "depend")
        for uri in uris:
            model = etree.SubElement(depend, "model")
            _add_element(model, "uri", uri)
            _add_element(model, "version", "1.0")
    etree.indent(root)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True).replace(b"'", b'"', 4) + b"\n"


def _add_element(parent: XmlElement, name: str, text: str) -> XmlElement:
    element = etree.SubElement(parent, name)
    element.text = text
    return element
