"""Companion files, which follow where a command renames the parts of robots in their files."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from twinform.compiler import LoadOptions, read
from twinform.diagnostics.wording import plural

if TYPE_CHECKING:
    from twinform.compiler.companions.follow_renames import FollowedFile
    from twinform.passes import Pipeline

RENAMING = frozenset({"rename", "prefix-names"})
"""The passes that give parts other names."""


def followed_files(robots: Mapping[Path, bytes], passes: "Pipeline", load_options: LoadOptions) -> "list[FollowedFile]":
    """Return the companion files of robots that change with names that passes change; `robots` are files as read."""
    if not RENAMING.intersection(step.name for step in passes):
        return []
    from twinform.compiler.companions.follow_renames import (  # noqa: PLC0415 - few runs rename
        Renames,
        follow_renames,
        renames_of,
    )

    links: dict[str, str] = {}
    joints: dict[str, str] = {}
    for path, data in robots.items():
        document = read(data, load_options, name=str(path)).document
        if document is not None:
            found = renames_of(document, passes)
            links.update(found.links)
            joints.update(found.joints)
    return list(follow_renames(list(robots), Renames(links, joints), load_options))


def describe_followed(followed: "FollowedFile") -> list[str]:
    """Say what became of a file that follows."""
    lines = [f"{followed.path}: {plural(followed.changed, 'name')} followed"] if followed.changed else []
    if followed.left:
        lines.append(f"{followed.path}: cannot follow {', '.join(map(repr, followed.left))}: change it by hand")
    return lines
