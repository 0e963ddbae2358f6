"""Makes the table of built-in rules: `python -m twinform.diagnostics.built_in_table FILE [--check]`."""

import sys

from twinform.diagnostics.catalog import defined_rules
from twinform.diagnostics.generated_files import main

_HEAD = '''\
"""The built-in rules by name, each with its module in `twinform.diagnostics.rules`.

Made by `make generate` from these modules; do not edit it.
"""

from collections.abc import Mapping

BUILT_IN: Mapping[str, str] = {
'''


def built_in_table() -> str:
    """The module with the table."""
    homes = sorted((rule.name, module) for module, rules in defined_rules().items() for rule in rules)
    return "".join([_HEAD, *(f'    "{name}": "{module}",\n' for name, module in homes), "}\n"])


if __name__ == "__main__":
    sys.exit(main(built_in_table(), sys.argv[1:]))
