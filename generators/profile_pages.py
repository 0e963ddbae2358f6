"""Makes the reference pages of profiles from their tables."""

from collections.abc import Iterator

from twinform.profiles.features import shown_by
from twinform.profiles.profile import PORTABLE, Profile, ProfileRow, all_rows, load, names, releases_of
from twinform.profiles.reads_tables import Demand, PlaceStep, demands_by_release
from twinform.profiles.releases import Release
from twinform.profiles.remedies import REMEDIES

_INTRODUCTION = """\
# Profiles

What programs that read models refuse, drop, read otherwise or warn about: `twinform check --for NAME` reports it about
a file, `twinform convert --for NAME` runs the passes that help, and `twinform advise` compares all programs. `portable`
is all that are tested. [Write a model for several consumers](../../how-to/write-for-several-consumers.md) says how to
use them, and whether they are right is
[measured](../../evidence/who_reads_it.md#what-loaders-do-and-what-their-profiles-say).

*Refuses* is an error under `--for`, *drops* and *misreads* are warnings, *warns* is a note.

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
    known = releases_of(profile.name)
    lines = [f"# {profile.name}\n", f"{_sentence(profile.about)} It reads {_formats(profile)}.\n"]
    lines += ["| release | also called | tested in | SDF | URDF |", "| --- | --- | --- | --- | --- |"]
    lines += [*map(_release_row, known), ""]
    if len(known) > 1:
        lines.append(f"Without a release, {profile.release.name} is meant.\n")
    if rows := all_rows(profile.name):
        lines += [
            "| what is found | format | releases | effect | what it does | passes that help | shown by |",
            "| --- | --- | --- | --- | --- | --- | --- |",
        ]
        lines += [_format_row(each) for each in rows] + [""]
    if profile.reads:
        lines += [
            "| what it reads of URDF | releases | effect otherwise | what it does | passes that help | shown by |",
            "| --- | --- | --- | --- | --- | --- |",
        ]
        lines += [*_demand_rows(profile.name, known), ""]
    return "\n".join(lines).rstrip("\n") + "\n"


def _release_row(release: Release) -> str:
    """A release, and the version that was tested or the source that was read."""
    seen = release.seen or (f"read in {release.source}" if release.source else "")
    return f"| {release.name} | {', '.join(release.also)} | {seen} | {release.sdf} | {release.urdf or ''} |"


def _format_row(row: ProfileRow) -> str:
    narrowed = f", `{row.message}`" if row.message else ""
    format_ = row.format.upper() if row.format else ""
    passes = f"`{row.pipeline}`" if row.pipeline else ""
    rule = f"[{row.rule}](../../../twinform/diagnostics/rules/{row.rule}.md){_escape(narrowed)}"
    feature = _link_feature(shown_by(row.about, "", row.rule))
    about = _cited(row.about, row.source)
    cells = (rule, format_, _format_span(row.since, row.until), row.effect, about, passes, feature)
    return f"| {' | '.join(cells)} |"


def _demand_rows(name: str, known: tuple[Release, ...]) -> Iterator[str]:
    for each, releases in demands_by_release(name).items():
        passes = f"`{each.pipeline}`" if each.pipeline else ""
        first, last = releases[0], releases[-1]
        since, until = ("" if first is known[0] else first.name), ("" if last is known[-1] else last.name)
        about = _escape(_cited(each.about, each.source))
        span, feature = _format_span(since, until), _link_feature(shown_by(each.about, _path(each)))
        yield f"| {_escape(_format_place(each))} | {span} | {each.effect} | {about} | {passes} | {feature} |"


def _format_span(since: str, until: str) -> str:
    """The first and the last release; nothing where that is all of them."""
    if since == until:
        return since
    return f"{since} to {until}" if since and until else f"since {since}" if since else f"until {until}"


def _cited(about: str, source: str) -> str:
    return f"{about} (read in {source})" if source else about


def _path(demand: Demand) -> str:
    """The XPath to what a demand is about, as findings have it."""
    below = [demand.item] if demand.item.startswith("@") else []
    return "/".join(["/robot", *(step.tag for step in demand.place), *below])


def _link_feature(name: str) -> str:
    group, _, stem = name.partition("/")
    return f"[{stem}](../who_reads_what/{group}.md#{stem})" if name else ""


def _format_place(demand: Demand) -> str:
    """A demand such as `link/inertial/mass` `@value`: a number, needed."""
    path = "/".join(["robot", *map(_format_step, demand.place)])
    needed = ", needed" if demand.needed else ""
    since, until = demand.versions
    version = f" in URDF {_format_span(since, until)}" if since or until else ""
    form = f": {demand.form}" if demand.form else ""
    return f"`{path}` `{demand.item}`{form}{needed}{version}"


def _format_step(step: PlaceStep) -> str:
    types = f"[{'!' if step.other else ''}{','.join(sorted(step.types))}]" if step.types else ""
    return f"{step.tag}{types}"


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:].rstrip('.')}."


def _escape(text: str) -> str:
    return text.replace("|", "\\|")
