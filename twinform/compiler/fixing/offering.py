"""Offers fixes: the findings of a file that was read, each with the fix that its rule has for it."""

import re
from collections.abc import Callable
from dataclasses import replace

from twinform.compiler.fixing.fixer_registry import fixer_of, text_fixer_of
from twinform.compiler.fixing.site import FindingSite, FixableFile, touches_expressions
from twinform.compiler.input.loading import LoadResult
from twinform.diagnostics import Diagnostic, Fix, rules

# Rules whose path may lead to an element that is not written: in URDF a <limit> implies its axis.
_ABOUT_WHAT_IS_NOT_THERE = frozenset({rules.UNUSED_AXIS.name})
# A fix with more edits is offered at the first of its findings only.
_MANY_EDITS = 100
_ATTRIBUTE = re.compile(r"/@[^/\]']+$")


def with_fixes(loaded: LoadResult, wanted: Callable[[Diagnostic], bool] = lambda _: True) -> tuple[Diagnostic, ...]:
    """The findings of a file, those that are wanted with their fix; offsets are in `SourceText.of(content).text`.

    There is none for what stands in another file than the one that was read, or is made by xacro.
    """
    if not any(each.rule.fix and wanted(each) for each in loaded.diagnostics):
        return loaded.diagnostics
    file = FixableFile.of(loaded)
    if file is None:
        return loaded.diagnostics
    return tuple(replace(each, fix=_fix(each, file)) if wanted(each) else each for each in loaded.diagnostics)


def _fix(finding: Diagnostic, file: FixableFile) -> Fix | None:
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
