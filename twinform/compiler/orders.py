"""What a conversion is asked for."""

from dataclasses import dataclass, field, replace
from typing import Literal, get_args

from twinform.ir import Document, Format
from twinform.passes import NO_ASSETS, Assets, Pipeline
from twinform.passes.legalise import Target, legalisation

Language = Literal["sdf", "urdf", "json"]
UrdfVersion = Literal["1.0", "1.1", "1.2"]
URDF_VERSIONS: tuple[UrdfVersion, ...] = get_args(UrdfVersion)
DEFAULT_SDF_VERSION = "1.11"
"""The version of Gazebo Harmonic, the newest long-term release, and the first that can say `mimic`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """What a conversion is asked for; `passes` are the user's, and `assets` the files beside the source."""

    to: Language
    sdf_version: str | None = None
    urdf_version: UrdfVersion | None = None
    passes: Pipeline = field(default_factory=Pipeline)
    carriers: bool = True
    model: str | None = None
    expand_includes: bool = False
    assets: Assets = field(default=NO_ASSETS, compare=False, repr=False)

    def plan(self, source: Document) -> Pipeline:
        """Every pass that a conversion of this document runs, in order: the user's, then those of the target."""
        return Pipeline((*self.passes, *self.legalisation(source)))

    def home(self, version: str) -> "Order":
        """The same for the version that is remembered of the source, as it was tried when that was remembered.

        Of URDF, the version that is asked for goes before it.
        """
        if self.to == "sdf":
            return replace(self, sdf_version=version, carriers=True)
        known = next((each for each in URDF_VERSIONS if each == version), None)
        return replace(self, urdf_version=self.urdf_version or known, carriers=True)

    def legalisation(self, source: Document) -> Pipeline:
        """The passes that the target asks for."""
        if self.to == "json":
            return Pipeline()
        own = source.version if source.format is Format.SDF else None
        version = self.sdf_version or own or DEFAULT_SDF_VERSION
        target = Target(Format(self.to), version, self.urdf_version or "1.0", self.carriers, self.model)
        return Pipeline(legalisation(source.format, source.version, target)).with_files(self.assets)
