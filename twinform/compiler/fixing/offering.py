"""Offers fixes: adds to each finding the fix that its rule has for it.

Fixers are functions that make a fix; each of our modules `fix_...` has a table of them by rule. Other packages add
theirs through the entry-point group `twinform.fixes`, where the name of an entry point is that of the rule.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, cached_property
from pathlib import Path, PurePath
from typing import cast

from twinform.compiler.fixing.expanded_editor import ExpandedEditor
from twinform.compiler.fixing.site import (
    FindingSite,
    FixableFile,
    Fixer,
    Fixers,
    TextFixer,
    TextFixers,
    touches_expressions,
)
from twinform.compiler.fixing.xacro_values import ComputedError
from twinform.compiler.input.loading import LoadResult
from twinform.compiler.input.xacro_mistakes import MOST_TAGS
from twinform.diagnostics import Diagnostic, Fix, Location, catalog, rules
from twinform.file_access import Readable
from twinform.lazy import lazy_pattern

# Rules whose path may lead to an element that is not written: in URDF a <limit> implies its axis.
_ABOUT_WHAT_IS_NOT_THERE = frozenset({rules.UNUSED_AXIS.name})
# A fix with more edits is offered at the first of its findings only.
_MANY_EDITS = 100
_IN_MJCF = frozenset(
    {
        rules.DOCTYPE.name,
        rules.NOT_WELL_FORMED.name,
        rules.REPAIRED_XML.name,
        rules.STRAY_TEXT.name,
        rules.UNKNOWN_ATTRIBUTE.name,
        rules.UNKNOWN_ELEMENT.name,
    }
)
"""The rules with a fix that is right in MJCF: other fixers write elements and attributes of URDF and SDF."""
_ATTRIBUTE = lazy_pattern(r"/@[^/\]']+$")


def with_fixes(loaded: LoadResult, wanted: Callable[[Diagnostic], bool] = lambda _: True) -> tuple[Diagnostic, ...]:
    """Return the findings of a file, the wanted ones with their fixes; offsets are in `SourceText.of(content).text`.

    Findings about other files get no fix, unless they are xacro files that the file includes.
    """
    if not any(each.rule.fix and wanted(each) for each in loaded.diagnostics):
        return loaded.diagnostics
    files = _Files(loaded)
    found = tuple(_offer(each, files) if wanted(each) else each for each in loaded.diagnostics)
    editor = files.whole.expanded if files.whole else None
    return found if editor is None else tuple(_only_agreed(each, editor) for each in found)


class _Files:
    """The files that findings are about: what was read, as it was expanded, or a xacro file as it is written."""

    def __init__(self, loaded: LoadResult) -> None:
        self.loaded = loaded
        self._texts = loaded.expansion.texts if loaded.expansion else loaded.texts
        self._sources: dict[str, FixableFile | None] = {}
        around = Readable.of(Path(loaded.path)) if self._texts else Readable()
        # packages beside the robot's own, and those of the system, are somebody else's
        self._own = Readable(around.around, single=around.single)

    @cached_property
    def whole(self) -> FixableFile | None:
        """The file that was read."""
        return FixableFile.of(self.loaded)

    def is_own(self, name: str) -> bool:
        """Tell whether a file is the robot's own: the one that was read, or one in its repository or package."""
        return not name or self._own.allows(name)

    def about(self, finding: Diagnostic) -> FixableFile | None:
        """Return the file that a finding is about; None for one that no fix may change."""
        name = finding.location.file
        if _is_about_expanded(finding, self.loaded) or not self._texts:
            return self.whole if name == self.loaded.path or self.loaded.expansion else None
        if name not in self._sources and self._texts.get(name, b"").count(b"<") in range(1, MOST_TAGS):
            as_it_is = replace(self.loaded, path=name, content=self._texts[name], tree=None, expansion=None, origins={})
            self._sources[name] = FixableFile.of(as_it_is)
        return self._sources.get(name)


def _is_about_expanded(finding: Diagnostic, loaded: LoadResult) -> bool:
    return bool(finding.related and loaded.origins) and finding.related[0].file == loaded.text_name


def _offer(finding: Diagnostic, files: _Files) -> Diagnostic:
    """Return a finding with its fix, or with what stands against one."""
    file = files.about(finding) if finding.rule.fix else None
    if file is None or (files.loaded.is_mjcf and finding.rule.name not in _IN_MJCF and finding.rule.name in catalog()):
        return finding
    about = finding
    if file.expanded:
        about = replace(finding, location=finding.related[0], related=finding.related[1:])
    try:
        fix = _make_fix(about, file)
    except ComputedError as error:
        return _without_fix(finding, str(error))
    kept = _without_idle_edits(fix, file) if fix and fix.edits else None
    if kept and file.expanded:
        kept = _with_place(kept, finding.location, file.expanded)
    if kept and file is not files.whole and file.loaded.path != files.loaded.path:
        kept = replace(kept, edits=tuple(edit._replace(file=file.loaded.path) for edit in kept.edits))
    return replace(finding, fix=kept if kept and all(files.is_own(edit.file) for edit in kept.edits) else None)


def _with_place(fix: Fix, where: Location, editor: ExpandedEditor) -> Fix:
    """Return a fix that says where its edits are, unless they are at the place of the finding."""
    file, line = editor.line_of(fix.edits[0])
    if (file, line) == (where.file, where.line):
        return fix
    return replace(fix, title=f"{fix.title}, in {PurePath(file).name}:{line}")


def _without_fix(finding: Diagnostic, why: str) -> Diagnostic:
    return replace(finding, fix=None, help="; ".join(filter(None, (finding.help, f"no fix is offered: {why}"))))


def _only_agreed(finding: Diagnostic, editor: ExpandedEditor) -> Diagnostic:
    """Return a finding without a fix that changes other parts of the robot too."""
    if finding.fix is None or editor.is_agreed(finding.fix):
        return finding
    return _without_fix(finding, "not all that comes from this text needs it")


def _without_idle_edits(fix: Fix, file: FixableFile) -> Fix | None:
    """Return what is left of a fix without edits that change nothing; None where it must not be made."""
    if len(fix.edits) > _MANY_EDITS:
        # what fixes all places at once is the same for each of a thousand findings
        offered = file.memo.setdefault("offered", set())
        if (fix.title, fix.edits[0].span) in offered:
            return None
        offered.add((fix.title, fix.edits[0].span))
    edits = dict.fromkeys(fix.edits)  # a text of a macro is changed once for all its calls
    changes = tuple(edit for edit in edits if edit.span.of(file.text_of(edit)) != edit.new)
    return (
        replace(fix, edits=changes) if changes and (file.expanded or not touches_expressions(fix, file.text)) else None
    )


def _make_fix(finding: Diagnostic, file: FixableFile) -> Fix | None:
    by_text = text_fixer_of(finding.rule.name)
    if by_text is not None:
        return by_text(finding, file)
    if file.parts is None or finding.location.file != file.loaded.text_name:
        return None
    # Fixes are made here from the finding and its element, and not where something is found: no
    # check is slower for them.
    fixer = fixer_of(finding.rule.name)
    where = finding.location
    element = file.find(where)
    missing = None
    if element is None and finding.rule.name in _ABOUT_WHAT_IS_NOT_THERE:
        path, _, missing = where.path.rpartition("/")
        element = file.find(where._replace(path=path))
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
    from twinform.compiler.fixing import fix_mistakes, fix_names, fix_xacro, fix_xml_syntax  # noqa: PLC0415 - as above

    modules = (fix_mistakes, fix_names, fix_xacro, fix_xml_syntax)
    return {rule: fixer for module in modules for rule, fixer in module.TEXT_FIXERS.items()}


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
