"""`twinform schema`."""

from typing import IO, Literal

import click

from twinform.cli.failure import Unusable
from twinform.schemas import parse_version, schema_text, table


@click.command("schema")
@click.argument("language", metavar="urdf|sdf", type=click.Choice(["urdf", "sdf"]))
@click.option("--version", metavar="V", help="The version of the format; the newest where it is not given.")
@click.option(
    "--xsd",
    type=click.Choice(["1.0", "1.1"]),
    default="1.1",
    help="The version of XML Schema; 1.0 says less, and is what libxml2 and most editors read.",
)
@click.option(
    "-o",
    "--output",
    type=click.File("w", encoding="utf-8", atomic=True),
    default="-",
    help="Where to write; standard output where it is not given.",
)
def command(language: Literal["urdf", "sdf"], version: str | None, xsd: Literal["1.0", "1.1"], output: IO[str]) -> None:
    """Print the XML schema of a format."""
    facts = table(language)
    if version is not None and version not in facts.versions:
        raise Unusable(f"{language.upper()} has no version {version!r}; it has {', '.join(facts.versions)}")
    output.write(schema_text(language, parse_version(version) if version else facts.newest, xsd))
