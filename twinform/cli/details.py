"""Options for what a package says about itself: version, description, author, maintainer, license."""

from pathlib import Path

import click

from twinform.cli.flags import group
from twinform.compiler.packaging.order import PackageDetails
from twinform.compiler.packaging.source_details import details_around

_OPTIONS = (
    click.option("--package-version", metavar="X.Y.Z", default="", help="The version of the package; else 0.1.0."),
    click.option("--description", metavar="TEXT", default="", help="What the package is, in a sentence."),
    click.option("--author", metavar="NAME", default="", help="Who made the model; else the maintainer."),
    click.option("--maintainer", metavar="NAME", default="", help="Who looks after the package."),
    click.option("--email", metavar="ADDRESS", default="", help="The address of the maintainer."),
    click.option("--license", metavar="LICENSE", default="", help="The license, such as Apache-2.0."),
)


def _details(package_version: str, **words: str) -> PackageDetails:
    return PackageDetails(version=package_version.strip(), **{name: word.strip() for name, word in words.items()})


detail_options = group("details", _details, *_OPTIONS)
"""Gives a command the options for what a package says about itself."""


def details_of(given: PackageDetails, source: str | bytes) -> PackageDetails:
    """The details; what is not given is as the package or model around a file has it."""
    return given if isinstance(source, bytes) else given.or_else(details_around(Path(source)))
