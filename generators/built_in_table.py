"""Makes the table of built-in passes from the entry points of the package."""

from twinform.passes.framework.pass_registry import HOME, OWN, registered_passes

_HEAD = '''\
"""The built-in passes, by their names in a pipeline: modules below `twinform.passes`, and classes.

Made by `make generate` from the entry points of `pyproject.toml`; do not edit it.
"""

from collections.abc import Mapping

BUILT_IN: Mapping[str, str] = {
'''


def built_in_table() -> str:
    """The module with the table, from the entry points of this package as it is installed."""
    ours = [each for each in registered_passes().values() if each.owner == OWN]
    return "".join([_HEAD, *(f'    "{each.name}": "{each.entry.value.removeprefix(HOME)}",\n' for each in ours), "}\n"])
