"""`twinform schema`."""

from pathlib import Path
from typing import Literal

import click
from click.core import ParameterSource

from twinform.cli.command import Command, Unusable
from twinform.cli.outputs import Outputs
from twinform.cli.printing import print_document
from twinform.schemas import Version, parse_version, schema_text, table
from twinform.schemas.xacro_xsd import imported_schemas
from twinform.schemas.xsd import generate_schema, lenient_schema_text

_STDOUT = Path("-")


EXAMPLES = {
    "Write an XML schema for an editor": "twinform schema sdf --version 1.9 -o sdf.xsd",
    "One for xacro files, and those that it imports": "twinform schema urdf --xacro -o robot.xsd",
    "The JSON Schema of documents": "twinform schema json",
    "The JSON Schema of twinform.toml": "twinform schema config -o twinform.schema.json",
}


@click.command("schema", cls=Command, examples=EXAMPLES)
@click.argument(
    "language", metavar="urdf|sdf|mjcf|json|config", type=click.Choice(["urdf", "sdf", "mjcf", "json", "config"])
)
@click.option("--version", metavar="V", help="The version of the format; the newest where it is not given.")
@click.option(
    "--xsd",
    type=click.Choice(["1.0", "1.1"]),
    default="1.0",
    help="The version of XML Schema; 1.0 is what editors and libxml2 read, 1.1 checks more.",
)
@click.option("--lenient", is_flag=True, help="Accept elements of dialects and of other versions, and unknown names.")
@click.option(
    "--xacro",
    is_flag=True,
    help="Accept ${...} for any value, and xacro's elements anywhere; lenient besides. It is several files: needs -o.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, allow_dash=True),
    default="-",
    help="Where to write; standard output where it is not given.",
)
@click.pass_context
def command(
    ctx: click.Context,
    language: Literal["urdf", "sdf", "mjcf", "json", "config"],
    version: str | None,
    xsd: Literal["1.0", "1.1"],
    *,
    lenient: bool,
    xacro: bool,
    output: Path,
) -> None:
    """Print the schema of URDF, SDF, MJCF, JSON or the configuration.

    That of URDF, SDF and MJCF is an XML schema, those of documents as JSON and of twinform.toml are JSON Schemas. XML
    schemas are strict: they take the syntax of one version. A lenient one is for editors of files that are not. In XSD
    1.0 it takes no elements that it does not know; in XSD 1.1 it does. For xacro files, the schemas of xacro's own
    elements are written beside it.
    """
    asked = ctx.get_parameter_source("xsd") is ParameterSource.COMMANDLINE
    if language in {"json", "config"}:
        if version is not None or asked or lenient or xacro:
            raise click.UsageError("--version, --xsd, --lenient and --xacro are for urdf, sdf and mjcf")
        _write({output: _json_schema(language)})
        return
    facts = table(language)
    if version is not None and version not in facts.versions:
        raise Unusable(f"{language.upper()} has no version {version!r}; it has {', '.join(facts.versions)}")
    wanted = parse_version(version) if version else facts.newest
    if xacro:
        if language == "mjcf":
            raise click.UsageError("--xacro is for urdf and sdf")
        if xsd == "1.1":
            raise click.UsageError("--xacro has XSD 1.0, which editors read")
        _write(_for_xacro(language, wanted, output))
    else:
        _write({output: (lenient_schema_text if lenient else schema_text)(language, wanted, xsd)})


def _json_schema(language: str) -> str:
    if language == "config":
        from twinform.cli.config_settings import settings_schema_text  # noqa: PLC0415 - most schemas are in XSD

        return settings_schema_text()
    from twinform.compiler.output.json import json_schema_text  # noqa: PLC0415 - as above

    return json_schema_text()


def _for_xacro(language: str, version: Version, output: Path) -> dict[Path, str]:
    """Make the schema for xacro files, and those that it imports."""
    if output == _STDOUT:
        raise click.UsageError("--xacro makes several files: name the first with -o, such as -o robot.xsd")
    others = {output.with_name(name): text for name, text in imported_schemas().items()}
    if output in others:
        raise click.UsageError(f"{output.name} is the name of a schema that is written beside it")
    return {output: generate_schema(table(language), version, "1.0", xacro=True)} | others


def _write(texts: dict[Path, str]) -> None:
    if _STDOUT in texts:
        print_document(texts[_STDOUT])
        return
    outputs = Outputs()
    for path, text in texts.items():
        outputs.add("-o", path, text)
    outputs.write()
