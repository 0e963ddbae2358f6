"""Writes the files that are made from tables: `python -m generators [TARGET ...] [--check]`; all of them by default."""

import argparse
import subprocess
import sys
from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path

from testbed.generated_files import marked, out_of_date, write

ROOT = Path(__file__).parents[1]
_CODE = {
    "twinform/schemas": "generators.schemas:schemas",
    "twinform/diagnostics/rules/__init__.py": "generators.rule_table:rule_table",
    "twinform/passes/framework/built_in.py": "generators.built_in_table:built_in_table",
    "twinform/passes/sdf_versions/lacking.py": "generators.lacking_table:lacking_table",
    "twinform": "generators.options:docstrings",
}
"""What the makers of other targets import, so that each is written in a process of its own."""
MADE: Mapping[str, str] = {
    **_CODE,
    "docs/reference/rules.md": "generators.rules_page:rules_page",
    "docs/reference/passes.md": "generators.passes_page:passes_page",
    "docs/explanation/pipeline.md": "generators.pipeline_page:pipeline_page",
    "docs/reference/plugins.md": "generators.plugins_page:plugins_page",
    "twinform/profiles/data/shown_by.json": "generators.shown_by:table",
    "docs/reference/profiles": "generators.profile_pages:pages",
    "docs/reference/who_reads_what": "reports.who_reads_it.feature_pages:measured_pages",
    "docs/reference/not_compared.md": "generators.not_compared_page:page",
    "docs/reference/commands.md": "generators.commands_page:commands_page",
    "docs/reference/options.md": "generators.options:options_page",
    "docs/reference": "generators.mapping.elements:pages",
    "docs/reference/libsdformat_codes.md": "generators.libsdformat_codes:page",
    "docs/explanation/mapping.md": "generators.mapping.page:page",
    "twinform/server/destinations.json": "generators.mapping.destinations:destinations_table",
}
"""The files and folders, each with the function that returns the text of the file, or texts by names in the folder."""


def texts_of(target: str) -> dict[Path, str]:
    """Return the files of a target as they should be."""
    module, _, name = MADE[target].partition(":")
    made: str | Mapping[str, str] = getattr(import_module(module), name)()
    return marked({ROOT / target: made} if isinstance(made, str) else {ROOT / target / at: made[at] for at in made})


def main(arguments: Sequence[str]) -> int:
    """Write targets, or compare them.

    Returns:
        The exit code: 1 where a file is out of date.
    """
    parser = argparse.ArgumentParser(prog="python -m generators")
    parser.add_argument("targets", nargs="*", help=", ".join(MADE))
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 where a file is out of date")
    given = parser.parse_args(arguments)
    targets: list[str] = given.targets or [*MADE]
    if unknown := [each for each in targets if each not in MADE]:
        parser.error(f"nothing makes {unknown[0]}")
    if given.check:
        return 1 if [file for each in targets for file in out_of_date(texts_of(each))] else 0
    for target in targets:
        if target in _CODE and len(targets) > 1:
            subprocess.run([sys.executable, "-m", "generators", target], check=True)
        else:
            write(texts_of(target))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
