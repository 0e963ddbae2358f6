"""The order of a package: its model, its name, and its details, which may come from the package around the model."""

from collections.abc import Mapping
from dataclasses import field, fields, replace
from pathlib import Path
from typing import Self

from lxml import etree

from twinform.compiler.conversion import Conversion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.input.loading import Input, LoadOptions
from twinform.compiler.packaging.collect_files import CollectFiles, MadeFiles
from twinform.compiler.packaging.collecting import HIGHEST, Collection, UncollectedError
from twinform.compiler.packaging.package import Package, PackageLayout
from twinform.compiler.request import ConversionRequest
from twinform.compiler.ros_packages import MANIFEST, MODEL_CONFIG, read_manifest
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Ledger, Location, Severity
from twinform.diagnostics.rules import UNPACKAGED_FILE
from twinform.lazy import lazy_pattern
from twinform.passes import PassInstrumentation, Pipeline
from twinform.passes.plugins.release_names import ReleaseName
from twinform.request_options import Language
from twinform.schemas import XmlElement

PLACEHOLDERS: Mapping[str, str] = {
    "description": "TODO: Package description",
    "maintainer": "TODO",
    "email": "todo@todo.todo",
    "license": "TODO: License declaration",
}
"""The words for details that are not given; tools for packages of ROS know them."""
_FIRST_VERSION = "0.1.0"


@dataclass(frozen=True, slots=True, kw_only=True)
class PackageDetails:
    """The description, version, people and license of a package; empty where they are not given."""

    description: str = ""
    version: str = ""
    author: str = ""
    maintainer: str = ""
    email: str = ""
    license: str = ""

    @property
    def missing(self) -> tuple[str, ...]:
        """The names of the fields that a package needs and that are empty."""
        return tuple(name for name in PLACEHOLDERS if not getattr(self, name))

    def or_else(self, others: Self) -> Self:
        """Fill empty details from others; name and address come from one person and are never mixed."""
        person = self if self.maintainer or self.email else others
        told = {each.name: getattr(self, each.name) or getattr(others, each.name) for each in fields(self)}
        return replace(self, **told | {"maintainer": person.maintainer, "email": person.email})

    def with_placeholders(self) -> Self:
        """Return the details with placeholders for missing ones."""
        told = {name: PLACEHOLDERS[name] for name in self.missing}
        return replace(self, **told, version=self.version or _FIRST_VERSION)


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """A model, and the package that it is to be put into.

    `name` is the name of the package and `folder` that of its folder: Gazebo finds its files by `model://FOLDER/...`,
    and ROS by `package://NAME/...`. `conversion` is the request without target and version; `sdf_versions` are the
    versions that are written, the newest first. `release` is the release of Gazebo that runs the model, and `beside`
    are the files that another kind of package has in the same folder.
    """

    source: Input
    source_name: str
    name: str
    folder: str
    conversion: ConversionRequest
    load_options: LoadOptions
    sdf_versions: tuple[str, ...] = ()
    details: PackageDetails = field(default_factory=PackageDetails)
    allow_missing: bool = False
    thumbnail: bool = True
    release: ReleaseName = "harmonic"
    beside: tuple[str, ...] = ()

    def collection(self) -> Collection:
        """Make an empty collection for the files of the package."""
        return Collection(PackageLayout({"model": self.folder, "package": self.name}), self.allow_missing)

    def convert(
        self,
        collection: Collection,
        to: Language,
        sdf_version: str | None = None,
        instrumentation: PassInstrumentation | None = None,
    ) -> Conversion:
        """Convert the model, collect its files, and write their URIs in the package.

        Raises:
            CompileError: the model or a file of it has an error.
        """
        passes = Pipeline((*self.conversion.passes, CollectFiles.into(collection)))
        prefix = {"urdf": f"package://{self.name}", "sdf": f"model://{self.folder}"}.get(to)
        request = replace(
            self.conversion,
            to=to,
            sdf_version=sdf_version,
            mesh_prefix=prefix,
            mesh_folder=collection.layout.meshes,
            passes=passes,
        )
        made = run_conversion(
            request, self.source, self.load_options, name=self.source_name, instrumentation=instrumentation
        )
        try:
            for path, data in MadeFiles.of(made.side_files).files.items():
                collection.put(path, data)
        except UncollectedError as error:
            wrong = Diagnostic(UNPACKAGED_FILE, error.message, Location(self.source_name), Severity.ERROR)
            raise CompileError((*made.diagnostics, wrong)) from error
        return made


@dataclass(frozen=True, slots=True)
class Built:
    """A package, its diagnostics, and the ledger of each text in it by its path."""

    package: Package
    diagnostics: tuple[Diagnostic, ...] = ()
    ledgers: dict[str, Ledger] = field(default_factory=dict[str, Ledger])


_TEXTS = etree.Element
"""Only texts of elements count, and not those of comments and unresolved entities."""
_UNSAID = frozenset(PLACEHOLDERS.values())
_VERSION = lazy_pattern(r"(\d+\.\d+)(\.\d+)?")


def details_around(file: Path) -> PackageDetails:
    """Read the details in the nearest package.xml or model.config, in the folder of a file or upwards.

    Of several maintainers the first is taken, several licenses are joined by commas, and a version of two numbers gets
    a third one, which packages of ROS need (REP 149).
    """
    for folder in file.absolute().parents[:HIGHEST]:
        if (package := read_manifest(folder / MANIFEST)) is not None:
            return _read_package_xml(package)
        if (model := read_manifest(folder / MODEL_CONFIG)) is not None:
            return _read_model_config(model)
    return PackageDetails()


def _read_package_xml(root: XmlElement) -> PackageDetails:
    maintainer = root.find("maintainer")
    return PackageDetails(
        description=_text(root.find("description")),
        version=_version(root),
        author=_text(root.find("author")),
        maintainer=_text(maintainer),
        email=_email(maintainer),
        license=", ".join(filter(None, map(_text, root.findall("license")))),
    )


def _read_model_config(root: XmlElement) -> PackageDetails:
    name = _text(root.find("author/name"))
    return PackageDetails(
        description=_text(root.find("description")),
        version=_version(root),
        maintainer=name,
        email=_text(root.find("author/email")),
    )


def _email(maintainer: XmlElement | None) -> str:
    text = "" if maintainer is None else str(maintainer.get("email") or "").strip()
    return "" if text in _UNSAID else text


def _version(root: XmlElement) -> str:
    found = _VERSION.fullmatch(_text(root.find("version")))
    return "" if found is None else f"{found[1]}{found[2] or '.0'}"


def _text(element: XmlElement | None) -> str:
    """Return the text of an element, with one space between words, or nothing where it is a placeholder."""
    text = "" if element is None else " ".join("".join(element.itertext(_TEXTS)).split())
    return "" if text in _UNSAID else text
