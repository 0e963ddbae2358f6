"""From the IR to the text of a file, without a tree in between: the generated writers."""

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from functools import cache
from importlib import import_module
from typing import Any, cast

from twinform.schemas.facts import Version
from twinform.schemas.text_output import NEW_LINE, Arrange, NeedsTree, TextOutput, Write


def root_text(
    format: str,
    version: Version,
    root: Any,
    namespaces: Mapping[str | None, str],
    *,
    root_attributes: str = "",
    arrange: Arrange | None = None,
    refused: AbstractSet[str] = frozenset(),
) -> str | None:
    """The text of a file with this root; nothing where only `writer.py` can write it.

    `root_attributes` are the text of attributes behind the root's own. `arrange` puts parts of a node in another order
    than the file's; where an untyped element has one of the names that are `refused`, nothing is written.
    """
    try:
        out = TextOutput(format, version, namespaces, root_attributes, arrange, refused)
        return f'<?xml version="1.0"?>{_write_root(format)(root, out, NEW_LINE)}\n'
    except (NeedsTree, RecursionError):
        return None


@cache
def _write_root(format: str) -> Write:
    """The writer of the root of a format, which is not imported before something is written."""
    return cast("Write", import_module(f"twinform.schemas.generated.{format}_text").write_root)
