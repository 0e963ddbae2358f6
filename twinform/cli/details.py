"""Options for what a package says about itself: version, description, author, maintainer, license."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypedDict, TypeVar

import click

from twinform.compiler.packaging.order import Details
from twinform.compiler.packaging.source_details import details_around

Command = TypeVar("Command", bound=Callable[..., Any])

_OPTIONS = (
    click.option("--package-version", metavar="X.Y.Z", default="", help="The version of the package; else 0.1.0."),
    click.option("--description", metavar="TEXT", default="", help="What the package is, in a sentence."),
    click.option("--author", metavar="NAME", default="", help="Who made the model; else the maintainer."),
    click.option("--maintainer", metavar="NAME", default="", help="Who looks after the package."),
    click.option("--email", metavar="ADDRESS", default="", help="The address of the maintainer."),
    click.option("--license", metavar="LICENSE", default="", help="The license, such as Apache-2.0."),
)


class DetailOptions(TypedDict):
    """What these options give a command."""

    package_version: str
    description: str
    author: str
    maintainer: str
    email: str
    license: str


def detail_options(command: Command) -> Command:
    """Give a command the options for what a package says about itself."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def details_of(options: DetailOptions, source: str | bytes) -> Details:
    """The options as the compiler takes them; what is not given is as the package or model around a file has it."""
    given = Details(
        description=options["description"].strip(),
        version=options["package_version"].strip(),
        author=options["author"].strip(),
        maintainer=options["maintainer"].strip(),
        email=options["email"].strip(),
        license=options["license"].strip(),
    )
    return given if isinstance(source, bytes) else given.or_else(details_around(Path(source)))
