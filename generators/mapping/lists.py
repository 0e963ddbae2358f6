"""The end of the mapping: what is passed over with a finding, kept without one, or special."""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator

from generators.mapping.file_rows import unreachable
from testbed.markdown import rule_links
from twinform.schemas import table
from twinform.server.mapping import FORMATS, FormatName, MappingRow, rows

_WARNED = """\
## What is passed over

### With a finding

* A name that the format does not have, in an element that is not free: unknown-element, unknown-attribute. It is kept
  where it stands, comes back in its own format, and travels in a carrier. Under `--strict` it is an error.
* A part of another version than the file declares: outside-version. It is read and kept.
* A second element where there may be one: repeated-element. The first one counts; the others are kept.
* Text where only elements belong: stray-text.
* `<gazebo>` tags that mean nothing where they stand: gazebo-tag-without-target; and those that would repeat what the
  robot has already: gazebo-conflict. They are carried.
* Elements and values of other readers of URDF, an info (dialect); they are kept, and travel in carriers.
"""
_SPECIAL = """\
### Special

* `gazebo`, `plugin`, `mujoco`, `deformable`, `auto_inertia_params`: free content, kept to the letter with its order.
* `tf:` (`urn:twinform:1`): our own namespace. Carriers are read and folded back; `<tf:source>` of
  early versions of twinform is ignored.
* Elements and attributes of other namespaces: kept where they stand, and carried. `drake:` is known by its prefix; in
  URDF `<drake:joint>` is a joint of SDF, and `<drake:ball_constraint>` one that closes a loop.
* Comments and processing instructions: no part of the document; they do not come through.
* The prolog, the encoding and the spelling of numbers: the text is written anew, in UTF-8; booleans keep theirs.
* `xacro:`: expanded before anything is read, never carried.
* DOCTYPE and entities: refused (doctype).
"""
_PASSES = """\
## The passes

What the notes call a pass is a class in `twinform/passes/legalise` or `twinform/passes/sdf_versions`, whose docstring
describes what it changes. `twinform convert FILE --print-pipeline` lists those that a file goes through, and
`--dump-ir-after PASS` shows what one of them did.
"""
_RULES = (
    "unknown-element", "unknown-attribute", "outside-version", "repeated-element", "stray-text",
    "gazebo-tag-without-target", "gazebo-conflict", "doctype",
)  # fmt: skip


def passed_over() -> Iterator[str]:
    """The sections at the end."""
    yield _linked(_WARNED, (*_RULES, "dialect"))
    yield from (f"  * {dialect}: {_listed(names)}" for dialect, names in sorted(_dialects().items()))
    yield "\n### Without a finding\n\nParts that no pass needs to understand stay as XML at their place: checked by the"
    yield "schema, kept in their own format, and in a carrier or a `<gazebo>` element of the other one.\n"
    yield from (f"* {name.upper()} {section}: {_listed(names)}" for name in FORMATS for section, names in _opaque(name))
    yield f"\n{_linked(_SPECIAL, _RULES)}"
    yield from (f"* {line}" for line in _without_place())
    yield "\n" + _PASSES


def _dialects() -> dict[str, list[str]]:
    found: dict[str, list[str]] = defaultdict(list)
    for row in rows("urdf"):
        if row.fact.dialect:
            found[row.fact.dialect].append(row.path)
        for value, dialect in row.fact.also:
            found[dialect].append(f"{row.path} = {value}")
    return found


def _opaque(format: FormatName) -> Iterator[tuple[str, list[str]]]:
    """The outermost rows without a place in the IR, by definition; what is inside of them has none either."""
    within = _inside_opaque(format)
    for name, fact in table(format).definitions.items():
        untyped = [row for row in rows(format) if row.fact.place is None and not row.fact.dialect]
        own = [row for row in untyped if row.definition == name]
        outer = [row.steps for row in own if name not in within and not _has_parent(row, own)]
        if outer and not fact.any:
            yield name, list(dict.fromkeys(outer))


def _has_parent(row: MappingRow, own: list[MappingRow]) -> bool:
    return any(row.steps.startswith(f"{other.steps}/") for other in own)


def _inside_opaque(format: FormatName) -> set[str]:
    """Definitions that only stand in what is kept as it is."""
    typed = {row.fact.reference for row in rows(format) if row.fact.place is not None}
    return {name for name in table(format).definitions if name not in typed and name != table(format).root}


def _without_place() -> Iterator[str]:
    for name in FORMATS:
        if names := unreachable(name):
            yield f"{name.upper()} {_listed(names)}: the specification describes them and gives them no place."


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _linked(text: str, rules: Iterable[str]) -> str:
    """The text with the names of rules after a colon, a comma or in brackets as links."""
    for rule in rules:
        text = re.sub(rf"(?<=: ){rule}\b|(?<=, ){rule}\b|(?<=\(){rule}(?=\))", rule_links([rule]), text)
    return text
