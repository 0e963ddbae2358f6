"""Makes the reference page of the passes from their classes."""

from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_page import description, options
from twinform.passes.framework.pass_registry import OWN, registered_passes

_INTRODUCTION = """\
# Passes

Steps from IR to IR, sorted by name. `twinform passes NAME` prints one page, and also those of passes from other
packages. A pipeline is text, such as `check-inertia,fill-limits{effort=100}`; quote it, as shells give braces a
meaning.
"""


def passes_page() -> str:
    """The reference page of the built-in passes in Markdown."""
    ours = [each.load() for each in registered_passes().values() if each.owner == OWN]
    return "\n".join([_INTRODUCTION, *map(_chapter, ours)])


def _chapter(kind: type[Pass]) -> str:
    parts = [f"## {kind.name}", description(kind)]
    rows = [f"| `{each.name}` | {each.type} | {each.default} | {each.text} |" for each in options(kind)]
    if rows:
        parts.append("\n".join(["| option | type | default | meaning |", "|---|---|---|---|", *rows]))
    if kind.example:
        parts.append(f"Example: `{kind.example}`")
    return "\n\n".join(parts) + "\n"
