"""Makes the page on where elements go: how to read the pages of the formats, and what is passed over."""

from collections.abc import Iterator

from generators.mapping.lists import passed_over
from testbed.markdown import paragraphs
from twinform.server.mapping import FORMATS, FormatName, sections

_HEAD = "# Where every element goes"
_ABOUT = """\
The pages of [URDF](../reference/urdf/README.md) and [SDF](../reference/sdf/README.md) say where each element and
attribute goes in the other format, what is kept, changed and refused, and which case file proves it. Their sources are
three: the facts tables (types, versions, places in the IR), the case files under `tests/cases`, each really converted,
and `generators/mapping/notes.toml`. The site's search finds an element by its name.

**How to read them.** There is a page for each element type, with a row for each element and attribute in it; a path
begins at the type, `@` is an attribute. *Where it goes* begins with what an audit of the case files found: *expressed*
in elements of the other format, *carried* in our namespace, *approximated*, or *dropped* (with `--no-carriers`, all
that is carried would be); then comes what fills the same field of the IR in the other format. *Rules* are those that
the ledger names there, and the findings of the case files: what is **refused** stops a conversion.

The reasons for all this stand in the passes (`twinform/passes/legalise/`), the rules in [rules](../reference/rules.md).
"""
_TITLES: dict[FormatName, str] = {"urdf": "From URDF to SDF", "sdf": "From SDF to URDF"}


def page() -> str:
    """The whole page."""
    return paragraphs(_HEAD, _ABOUT, "\n".join([*_contents(), *passed_over()])) + "\n"


def _contents() -> Iterator[str]:
    for name in FORMATS:
        links = ", ".join(f"[{one}](../reference/{name}/{one}.md)" for one in sections(name))
        yield f"**{_TITLES[name]}:** {links}.\n"
