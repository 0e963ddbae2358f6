"""Generator of the reference pages of profiles: `python -m twinform.profiles.profile_pages FOLDER [--check]`."""

import sys
from collections.abc import Iterator

from twinform.diagnostics.generated_files import main_of_folder
from twinform.profiles.profile import PORTABLE, Profile, ProfileRow, load, names
from twinform.profiles.remedies import REMEDIES
from twinform.profiles.walking import Demand, PlaceStep, reads

_INTRODUCTION = """\
# Profiles

What programs that read models refuse, drop, read otherwise or warn about: `twinform check --for NAME` reports it about
a file, `twinform convert --for NAME` runs the passes that help, and `twinform advise` compares all programs. `portable`
is all that are tested. [Write a model for several consumers](../../how-to/write-for-several-consumers.md) says how to
use them, and whether they are right is
[measured](../../evidence/who_reads_it.md#what-loaders-do-and-what-their-profiles-say).

*Refuses* is an error under `--for`, *drops* and *misreads* are warnings, *warns* is a note. This file is made by
`python -m twinform.profiles.profile_pages docs/reference/profiles`; do not edit it.

| profile | reads | what it is |
| --- | --- | --- |
"""
_REMEDIES = """\
## Passes that help

In the order in which they run. Those with a star change the physics; each change is in the ledger, and `--keep-physics`
refuses them.
"""


def pages() -> dict[str, str]:
    """A page for each profile, and one that lists them, by the names of their files."""
    profiles = [each for name in names() if name != PORTABLE for each in load(name)]
    return {"README.md": _list_page(profiles), **{f"{each.name}.md": _profile_page(each) for each in profiles}}


def _list_page(profiles: list[Profile]) -> str:
    rows = "".join(f"| [{each.name}]({each.name}.md) | {_formats(each)} | {each.about} |\n" for each in profiles)
    physics = {each.name: "\\*" if each.physics else "" for each in REMEDIES}
    steps = "\n".join(f"1. [{name}](../passes.md#{name}){star}" for name, star in physics.items())
    return f"{_INTRODUCTION}{rows}\n{_REMEDIES}\n{steps}\n"


def _formats(profile: Profile) -> str:
    return " and ".join(each.upper() for each in profile.formats)


def _profile_page(profile: Profile) -> str:
    seen = f"Seen in {profile.seen}." if profile.tested else "Not tested: read in its sources and documentation."
    lines = [f"# {profile.name}\n", f"{_sentence(profile.about)} It reads {_formats(profile)}. {seen}\n"]
    if profile.rows:
        lines += [
            "| what is found | format | effect | what it does | passes that help |",
            "| --- | --- | --- | --- | --- |",
        ]
        lines += [_format_row(each) for each in profile.rows] + [""]
    if profile.reads:
        lines += [
            "| what it reads of URDF | effect otherwise | what it does | passes that help |",
            "| --- | --- | --- | --- |",
        ]
        lines += [*_demand_rows(profile.reads), ""]
    return "\n".join(lines).rstrip("\n") + "\n"


def _format_row(row: ProfileRow) -> str:
    narrowed = f", `{row.message}`" if row.message else ""
    format_ = row.format.upper() if row.format else ""
    passes = f"`{row.pipeline}`" if row.pipeline else ""
    rule = f"[{row.rule}](../../../twinform/diagnostics/rules/{row.rule}.md){_escape(narrowed)}"
    cells = (rule, format_, row.effect, row.about, passes)
    return f"| {' | '.join(cells)} |"


def _demand_rows(name: str) -> Iterator[str]:
    for each in reads(name).demands:
        passes = f"`{each.pipeline}`" if each.pipeline else ""
        yield f"| {_escape(_format_place(each))} | {each.effect} | {_escape(each.about)} | {passes} |"


def _format_place(demand: Demand) -> str:
    """A demand such as `link/inertial/mass` `@value`: a number, needed."""
    path = "/".join(["robot", *map(_format_step, demand.place)])
    needed = ", needed" if demand.needed else ""
    return f"`{path}` `{demand.item}`: {demand.form}{needed}" if demand.form else f"`{path}` `{demand.item}`{needed}"


def _format_step(step: PlaceStep) -> str:
    types = f"[{'!' if step.other else ''}{','.join(sorted(step.types))}]" if step.types else ""
    return f"{step.tag}{types}"


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:].rstrip('.')}."


def _escape(text: str) -> str:
    return text.replace("|", "\\|")


if __name__ == "__main__":
    sys.exit(main_of_folder(pages(), sys.argv[1:]))
