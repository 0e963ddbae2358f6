"""Options for what a package says about itself: version, description, author, maintainer, license."""

from collections.abc import Callable
from typing import Any, TypedDict, TypeVar

import click

from twinform.compiler.packaging.order import Details

Command = TypeVar("Command", bound=Callable[..., Any])

_OPTIONS = (
    click.option("--package-version", metavar="X.Y.Z", default="0.1.0", help="The version of the package."),
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


def details_of(options: DetailOptions) -> Details:
    """The options as the compiler takes them."""
    return Details(
        description=options["description"].strip(),
        version=options["package_version"].strip(),
        author=options["author"].strip(),
        maintainer=options["maintainer"].strip(),
        email=options["email"].strip(),
        license=options["license"].strip(),
    )
