"""`twinform schema`."""

from typing import IO, Literal

import click
from click.core import ParameterSource

from twinform.cli.failure import Unusable
from twinform.schemas import json_schema_text, parse_version, schema_text, table
from twinform.schemas.xsd import lenient_schema_text


@click.command("schema")
@click.argument("language", metavar="urdf|sdf|json", type=click.Choice(["urdf", "sdf", "json"]))
@click.option("--version", metavar="V", help="The version of the format; the newest where it is not given.")
@click.option(
    "--xsd",
    type=click.Choice(["1.0", "1.1"]),
    default="1.0",
    help="The version of XML Schema; 1.0 is what editors and libxml2 read, 1.1 checks more.",
)
@click.option("--lenient", is_flag=True, help="Accept elements of dialects and of other versions, and unknown names.")
@click.option(
    "-o",
    "--output",
    type=click.File("w", encoding="utf-8", atomic=True),
    default="-",
    help="Where to write; standard output where it is not given.",
)
@click.pass_context
def command(
    ctx: click.Context,
    language: Literal["urdf", "sdf", "json"],
    version: str | None,
    xsd: Literal["1.0", "1.1"],
    *,
    lenient: bool,
    output: IO[str],
) -> None:
    """Print the schema of URDF, SDF or JSON.

    That of URDF and SDF is an XML schema, that of documents as JSON a JSON Schema. XML schemas are strict: they take
    the syntax of one version. A lenient one is for editors of files that are not. In XSD 1.0 it takes no elements that
    it does not know; in XSD 1.1 it does.
    """
    if language == "json":
        asked = ctx.get_parameter_source("xsd") is ParameterSource.COMMANDLINE
        if version is not None or asked or lenient:
            raise click.UsageError("--version, --xsd and --lenient are for urdf and sdf")
        output.write(json_schema_text())
        return
    facts = table(language)
    if version is not None and version not in facts.versions:
        raise Unusable(f"{language.upper()} has no version {version!r}; it has {', '.join(facts.versions)}")
    wanted = parse_version(version) if version else facts.newest
    output.write((lenient_schema_text if lenient else schema_text)(language, wanted, xsd))
