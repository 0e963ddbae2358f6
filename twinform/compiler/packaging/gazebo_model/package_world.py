"""Builds the package of a world: each of its models in a folder of its own, and the world that includes them.

    worlds/warehouse.sdf   models/shelf/model.config   models/shelf/model.sdf   models/shelf/meshes/...

Models that the world includes already, by `model://` or from Fuel, stay where they are.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath

from twinform.compiler.input.loading import read
from twinform.compiler.packaging.collect_files import CollectFiles
from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.gazebo_model.folder import folder_files, reserve_names
from twinform.compiler.packaging.layout import PackageLayout
from twinform.compiler.packaging.order import Built, Order
from twinform.compiler.packaging.package import Content, Package
from twinform.compiler.search.resolve_uris import LocalAssets
from twinform.compiler.splitting import Placement, split
from twinform.diagnostics import Diagnostic, DiagnosticSink, Ledger
from twinform.diagnostics.rules import UNPACKAGED_INCLUDE
from twinform.ir import Document
from twinform.schemas import DEFAULT_SDF_VERSION

_SCHEME = "model://"


def is_world(order: Order) -> bool:
    """Whether a file has worlds, and no model of it is asked for alone."""
    if order.conversion.model is not None:
        return False
    document = read(order.source, order.load_options, name=order.source_name).document
    return document is not None and bool(document.worlds)


def build(order: Order) -> Built:
    """The folders of a world.

    Raises:
        CompileError: the world or a file of it has an error.
    """
    folders = _Folders(order)
    found: list[Diagnostic] = []
    ledgers: dict[str, Ledger] = {}
    for version in order.sdf_versions or (None,):
        request = replace(order.conversion, to="sdf", sdf_version=version)
        placement = Placement(_uri, folders.adapted)
        made = split(request, order.source, order.load_options, name=order.source_name, placement=placement)
        found += made.diagnostics
        ledgers[folders.add(made.files, version)] = made.ledger
    sink = DiagnosticSink(order.source_name)
    package = Package(order.name, folders.files(sink))
    return Built(package, (*dict.fromkeys(found), *sink.diagnostics), ledgers)


def _uri(file: str) -> str:
    """How the world includes a model."""
    # As in all collections of models for Gazebo. Includes that were there stay: they are somebody
    # else's models, with a version of their own.
    return _SCHEME + PurePosixPath(file).stem


@dataclass(slots=True)
class _Folders:
    """The folders of the models by their names, each with its files, its document, and its text in each version."""

    order: Order
    around: Collection = field(init=False)
    models: dict[str, Collection] = field(default_factory=dict[str, Collection])
    documents: dict[str, Document] = field(default_factory=dict[str, Document])
    texts: dict[str, dict[str, str]] = field(default_factory=dict[str, dict[str, str]])
    worlds: dict[str, Content] = field(default_factory=dict[str, Content])

    def __post_init__(self) -> None:
        self.around = Collection(PackageLayout({}), self.order.allow_missing)

    def adapted(self, document: Document, file: str, sink: DiagnosticSink) -> Document:
        """The document of a file, which names its files as they are in its folder."""
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
        """The texts of all files in one version, the last of which is that of the world; gives its place."""
        *models, world = files
        written = version or self.documents[PurePosixPath(world).stem].version or DEFAULT_SDF_VERSION
        for file in models:
            self.texts.setdefault(PurePosixPath(file).stem, {})[written] = files[file]
        stem, suffix = PurePosixPath(world).stem, PurePosixPath(world).suffix
        place = f"worlds/{stem}-{written.replace('.', '_')}{suffix}" if self.worlds else f"worlds/{world}"
        self.worlds[place] = files[world].encode()
        return place

    def files(self, sink: DiagnosticSink) -> dict[str, Content]:
        """All files of the package."""
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
