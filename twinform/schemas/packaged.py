"""The files of the package that are made from the facts: XSDs and Python."""

from functools import cache
from typing import TYPE_CHECKING, Literal

from twinform.ir.versions import Version, print_version
from twinform.package_files import package_files

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

XsdVersion = Literal["1.0", "1.1"]
"""A version of the schema language."""


def schema_file(format: str, version: Version, xsd: XsdVersion = "1.1") -> "Traversable":
    """Where the schema of a format's version lies."""
    folder = package_files("twinform.schemas").joinpath(format, f"xsd{xsd.replace('.', '')}")
    return folder.joinpath(f"{format}-{print_version(version)}.xsd")


@cache
def schema_text(format: str, version: Version, xsd: XsdVersion = "1.1") -> str:
    """The schema of a format's version, in XSD 1.1 or its projection to XSD 1.0.

    Raises:
        FileNotFoundError: the format has no such version.
    """
    return schema_file(format, version, xsd).read_text(encoding="utf-8")


def code_file(module: str) -> "Traversable":
    """Where a generated module lies."""
    return package_files("twinform.schemas").joinpath("generated", f"{module}.py")
