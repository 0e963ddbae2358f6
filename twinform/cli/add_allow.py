"""`check --add-allow`: writes comments into files that allow what is found in them today."""

import os
from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from twinform.cli.inputs import InputSource
from twinform.cli.model_files import PARAMETERS
from twinform.cli.outputs import Rewrite
from twinform.cli.printing import print_line
from twinform.diagnostics import Diagnostic, Span, TextEdit, rules
from twinform.diagnostics.suppressions import parse_suppressions
from twinform.diagnostics.wording import plural
from twinform.file_access import Readable
from twinform.text import SourceText, UndecodableError
from twinform.text.comments import CommentPlaces, comments
from twinform.text.source_text import apply

_ABOUT_COMMENTS = frozenset({rules.MALFORMED_SUPPRESSION, rules.UNUSED_SUPPRESSION, rules.WRONG_CONFIGURATION})
"""No comment should allow these: they are about comments, or about no model."""


class Allowed(NamedTuple):
    """The files with their comments, the number of findings that these allow, and the findings that none can."""

    rewrites: Sequence[Rewrite]
    number: int
    left: Sequence[Diagnostic]


def allow_found(sources: Sequence[InputSource], found: Iterable[Diagnostic]) -> Allowed:
    """Make comments for findings in files, in which nothing else changes."""
    known = {os.path.realpath(each.name): each for each in sources if isinstance(each.content, str)}
    by_file: dict[str, list[Diagnostic]] = defaultdict(list)
    for each in found:
        by_file[os.path.realpath(each.location.file)].append(each)
    rewrites: list[Rewrite] = []
    left: list[Diagnostic] = []
    for name, here in by_file.items():
        # who asks for comments in some files has not asked for others that they include
        rewrite, rest = _with_comments(known[name], here) if name in known else (None, here)
        rewrites += [rewrite] if rewrite else []
        left += rest
    return Allowed(rewrites, sum(map(len, by_file.values())) - len(left), left)


def _with_comments(source: InputSource, found: Sequence[Diagnostic]) -> tuple[Rewrite | None, Sequence[Diagnostic]]:
    """Return a file with comments, and the findings that none of these allow."""
    path = Path(source.name)
    if path.name.lower().endswith(PARAMETERS):  # comments are of XML here
        return None, found
    try:
        data = Readable.of(path).read(path)
        before = SourceText.of(data)
    except (OSError, UndecodableError):
        return None, found
    places = CommentPlaces(before.text, before.line_end)
    wanted: dict[int, set[str]] = defaultdict(set)
    for each in found:
        if not (each.rule.fatal or each.rule in _ABOUT_COMMENTS) and each.location.line:
            wanted[each.location.line].add(each.rule.name)
    inserted = {line: place for line in wanted if (place := places.about(line))}
    edits = [
        TextEdit(Span(at, at), f"{before_it}<!-- twinform: allow {', '.join(sorted(wanted[line]))} -->{behind}")
        for line, (at, before_it, behind) in sorted(inserted.items())
    ]
    if not edits:
        return None, found
    after = apply(before.text, edits)
    new_lines = sorted(line for line, place in inserted.items() if place.after)
    kept = parse_suppressions(comments(after))

    def is_covered(each: Diagnostic) -> bool:
        return kept.covers(each.rule.name, each.location.line + bisect_right(new_lines, each.location.line))

    left = [each for each in found if not is_covered(each)]
    return Rewrite(source, data, before.with_text(after).data), left


def print_allowed(allowed: Allowed) -> None:
    """Say how many findings comments allow, and what the settings would have to be for the others."""
    print_line(f"{plural(allowed.number, 'finding')} allowed by comments", err=True)
    names: dict[str, set[str]] = defaultdict(set)
    for each in allowed.left:
        if each.rule not in _ABOUT_COMMENTS:
            names[each.location.file].add(each.rule.name)
    for file, found in sorted(names.items()):
        listed = ", ".join(f'"{each}"' for each in sorted(found))
        print_line(f"{file}: no comment can stand there: put allow = [{listed}] into a table [[files]]", err=True)
