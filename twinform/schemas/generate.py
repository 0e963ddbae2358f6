"""Writes what is made from the facts, XSDs and Python: `python -m twinform.schemas.generate`.

With `--check` the files are only compared.
"""

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import get_args

from twinform.schemas.facts import parse_version, table
from twinform.schemas.name_usage import generate_name_usage
from twinform.schemas.packaged import XsdVersion, code_file, schema_file
from twinform.schemas.text_generator import generate_text_writer
from twinform.schemas.xsd import generate_schema
from twinform.storage.writing import write_all_atomically

FORMATS = ("urdf", "sdf")


def generated() -> Iterator[tuple[Path, str]]:
    """Every file that is made from the facts, and its text."""
    for name in FORMATS:
        facts = table(name)
        for version in map(parse_version, facts.versions):
            for xsd in get_args(XsdVersion):
                yield Path(str(schema_file(name, version, xsd))), generate_schema(facts, version, xsd)
        yield Path(str(code_file(f"{name}_text"))), generate_text_writer(facts)
    yield Path(str(code_file("name_usage"))), generate_name_usage(map(table, FORMATS))


def stale() -> list[Path]:
    """The files that are not up to date with the facts."""
    return [file for file, text in generated() if not file.is_file() or file.read_text(encoding="utf-8") != text]


def main(arguments: Sequence[str]) -> int:
    """Write all files, or check them; the exit code."""
    if "--check" in arguments:
        for file in (files := stale()):
            sys.stderr.write(f"{file}: not what the facts say; run python -m twinform.schemas.generate\n")
        return 1 if files else 0
    write_all_atomically(dict(generated()))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
