"""Offers fixes: adds to each finding the fix that its rule has for it.

Fixers are functions that make a fix; each of our modules `fix_...` has a table of them by rule. Other packages add
theirs through the entry-point group `twinform.fixes`, where the name of an entry point is that of the rule.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import cast

from twinform.compiler.fixing.site import (
    FindingSite,
    FixableFile,
    Fixer,
    Fixers,
    TextFixer,
    TextFixers,
    touches_expressions,
)
from twinform.compiler.input.loading import LoadResult
from twinform.diagnostics import Diagnostic, Fix, catalog, rules
from twinform.lazy import lazy_pattern

# Rules whose path may lead to an element that is not written: in URDF a <limit> implies its axis.
_ABOUT_WHAT_IS_NOT_THERE = frozenset({rules.UNUSED_AXIS.name})
# A fix with more edits is offered at the first of its findings only.
_MANY_EDITS = 100
_ATTRIBUTE = lazy_pattern(r"/@[^/\]']+$")


def with_fixes(loaded: LoadResult, wanted: Callable[[Diagnostic], bool] = lambda _: True) -> tuple[Diagnostic, ...]:
    """Return the findings of a file, the wanted ones with their fixes; offsets are in `SourceText.of(content).text`.

    Findings about other files, or about what xacro has made, get no fix.
    """
    if not any(each.rule.fix and wanted(each) for each in loaded.diagnostics):
        return loaded.diagnostics
    file = FixableFile.of(loaded)
    if file is None:
        return loaded.diagnostics
    return tuple(replace(each, fix=_offer(each, file)) if wanted(each) else each for each in loaded.diagnostics)


def _offer(finding: Diagnostic, file: FixableFile) -> Fix | None:
    if finding.rule.fix is None or finding.location.file != file.loaded.path:
        return None
    fix = _make_fix(finding, file)
    if fix is None or not fix.edits:
        return None
    if len(fix.edits) > _MANY_EDITS:
        # what fixes all places at once is the same for each of a thousand findings
        offered = file.memo.setdefault("offered", set())
        if (fix.title, fix.edits[0].span) in offered:
            return None
        offered.add((fix.title, fix.edits[0].span))
    changes = tuple(edit for edit in fix.edits if edit.span.of(file.text) != edit.new)
    return replace(fix, edits=changes) if changes and not touches_expressions(fix, file.text) else None


def _make_fix(finding: Diagnostic, file: FixableFile) -> Fix | None:
    by_text = text_fixer_of(finding.rule.name)
    if by_text is not None:
        return by_text(finding, file)
    if file.parts is None:
        return None
    # Fixes are made here from the finding and its element, and not where something is found: no
    # check is slower for them.
    fixer = fixer_of(finding.rule.name)
    where = finding.location
    element = file.parts.find(where)
    missing = None
    if element is None and finding.rule.name in _ABOUT_WHAT_IS_NOT_THERE:
        path, _, missing = where.path.rpartition("/")
        element = file.parts.find(where._replace(path=path))
    if element is None or fixer is None:
        return None
    name = where.path.rpartition("/@")[2] if _ATTRIBUTE.search(where.path) else None
    return fixer(FindingSite(finding, file, element, name, missing))


GROUP = "twinform.fixes"


class FixRegistryError(Exception):
    """A package registers something that is not a fixer; the message names the package."""


@cache
def fixers() -> Fixers:
    """Return our own fixers by the names of their rules."""
    # few files have a finding that can be fixed
    from twinform.compiler.fixing import (  # noqa: PLC0415 - see above
        fix_joints,
        fix_mistakes,
        fix_names,
        fix_numbers,
        fix_structure,
    )

    modules = (fix_joints, fix_mistakes, fix_names, fix_numbers, fix_structure)
    return {rule: fixer for module in modules for rule, fixer in module.FIXERS.items()}


@cache
def text_fixers() -> TextFixers:
    """Return our own fixers that work on the text of a file, by the names of their rules."""
    from twinform.compiler.fixing import fix_names, fix_xml_syntax  # noqa: PLC0415 - as above

    return {**fix_names.TEXT_FIXERS, **fix_xml_syntax.TEXT_FIXERS}


def fixer_of(rule: str) -> Fixer | None:
    """Return the fixer of a rule, if it has one that works on elements.

    Raises:
        FixRegistryError: a package registers something that is not a fixer.
    """
    return fixers().get(rule) if rule in catalog() else strangers().get(rule)


def text_fixer_of(rule: str) -> TextFixer | None:
    """Return the fixer of a rule, if it has one that works on the text of a file."""
    return text_fixers().get(rule)


@cache
def strangers() -> Fixers:
    """Return the fixers of other packages by the names of their rules."""
    from importlib.metadata import entry_points  # noqa: PLC0415 - few rules are those of other packages

    found: dict[str, Fixer] = {}
    for entry in sorted(entry_points(group=GROUP), key=lambda each: each.name):
        owner = entry.dist.name if entry.dist else "an unknown distribution"
        try:
            fixer = entry.load()
        except (ImportError, AttributeError) as error:
            raise FixRegistryError(f"{owner} registers a fixer of {entry.name} that cannot be imported") from error
        if entry.name in catalog() or entry.name in found or not callable(fixer):
            raise FixRegistryError(f"{owner} registers a fixer of {entry.name}, which has one already or is none")
        found[entry.name] = cast("Fixer", fixer)
    return found
