"""The order of a package: what is put into it, what it is called, and who made it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Self

from twinform.compiler.conversion import Conversion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.input.loading import Input, LoadOptions
from twinform.compiler.packaging.collect_files import CollectFiles
from twinform.compiler.packaging.collecting import Collection, UncollectedError
from twinform.compiler.packaging.layout import PackageLayout
from twinform.compiler.packaging.made_files import MadeFiles
from twinform.compiler.packaging.package import Package
from twinform.compiler.request import ConversionRequest
from twinform.compiler.request_options import Language
from twinform.diagnostics import Diagnostic, Ledger, Location, Severity
from twinform.diagnostics.rules import UNPACKAGED_FILE
from twinform.passes import PassInstrumentation, Pipeline
from twinform.passes.plugins.release_names import ReleaseName

PLACEHOLDERS: Mapping[str, str] = {
    "description": "TODO: Package description",
    "maintainer": "TODO",
    "email": "todo@todo.todo",
    "license": "TODO: License declaration",
}
"""What stands where nobody has said it; tools for packages of ROS know these words."""
_FIRST_VERSION = "0.1.0"


@dataclass(frozen=True, slots=True, kw_only=True)
class PackageDetails:
    """What a package says about itself; empty where nobody has said it."""

    description: str = ""
    version: str = ""
    author: str = ""
    maintainer: str = ""
    email: str = ""
    license: str = ""

    @property
    def missing(self) -> tuple[str, ...]:
        """What nobody has said and a package needs, by the names of the fields."""
        return tuple(name for name in PLACEHOLDERS if not getattr(self, name))

    def or_else(self, others: Self) -> Self:
        """Fill empty details from others; name and address are taken from one person, never mixed."""
        person = self if self.maintainer or self.email else others
        told = {each.name: getattr(self, each.name) or getattr(others, each.name) for each in fields(self)}
        return replace(self, **told | {"maintainer": person.maintainer, "email": person.email})

    def with_placeholders(self) -> Self:
        """Return the details with placeholders for what is missing."""
        told = {name: PLACEHOLDERS[name] for name in self.missing}
        return replace(self, **told, version=self.version or _FIRST_VERSION)


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """A model, and the package that is asked for.

    `name` is what the package is called, and `folder` what its folder is: `model://FOLDER/...` is how Gazebo finds its
    files, and `package://NAME/...` how ROS does. `conversion` is what the model becomes, but for its target and
    version; `sdf_versions` are those that are written, the newest first. `release` is the one of Gazebo that runs the
    model, and `beside` are the files that another kind of package has in the same folder.
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
        """An empty collection of files."""
        return Collection(PackageLayout({"model": self.folder, "package": self.name}), self.allow_missing)

    def convert(
        self,
        collection: Collection,
        to: Language,
        sdf_version: str | None = None,
        instrumentation: PassInstrumentation | None = None,
    ) -> Conversion:
        """The model in one format, with the URIs of its files in the package, which go into the collection.

        Raises:
            CompileError: the model or a file of it has an error.
        """
        passes = Pipeline((*self.conversion.passes, CollectFiles.into(collection)))
        request = replace(self.conversion, to=to, sdf_version=sdf_version, passes=passes)
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
    """A package, what was found while it was made, and the ledger of each text in it by its path."""

    package: Package
    diagnostics: tuple[Diagnostic, ...] = ()
    ledgers: dict[str, Ledger] = field(default_factory=dict[str, Ledger])
