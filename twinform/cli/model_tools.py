"""The tools that `twinform mcp` offers: each takes paths below one folder, and returns what can be written as JSON."""

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

import click
from pydantic import Field

from twinform.cli.check_plan import CheckPlan
from twinform.cli.checked_file import CheckedFile, CheckTask, Reporting
from twinform.cli.editor_settings import settings_of
from twinform.cli.fix import Fixing, fix_source, merged
from twinform.cli.inputs import InputSource, read_model
from twinform.cli.outputs import Outputs, text_difference, write_back
from twinform.compiler import CompileError, ConversionRequest, LoadResult, run_conversion
from twinform.compiler.compare import compare_files
from twinform.compiler.compare.comparison_reporters import REPORTERS as COMPARISON_REPORTERS
from twinform.compiler.statistics import measure
from twinform.compiler.statistics_reporters import REPORTERS as STATISTICS_REPORTERS
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Severity, did_you_mean
from twinform.diagnostics.reporters import REPORTERS
from twinform.diagnostics.rule_page import sections, severity_words
from twinform.diagnostics.rule_registry import RuleRegistryError, find_rule, rules
from twinform.file_access import Readable
from twinform.passes import FilesPass, PassError
from twinform.request_options import RequestOptions
from twinform.server.checking import EditorSettings
from twinform.server.element_facts import element_facts

Answer = dict[str, Any]
ModelPath = Annotated[
    str, Field(description="A URDF, SDF, MJCF or xacro file below the root, such as urdf/robot.urdf.")
]


@dataclass(frozen=True, slots=True)
class ModelTools:
    """The tools for the files below a folder, which is the current one; paths in answers are relative to it."""

    root: Path

    def check(
        self,
        path: Annotated[
            str, Field(description="URDF, SDF, MJCF, xacro, or SRDF and YAML that name the parts of a robot.")
        ],
    ) -> Answer:
        """Find all that is wrong with a model file: rule, line, column, what was found and expected, and a fix."""
        name, settings = self._named(path)
        return _with_problem(_findings(_task(InputSource(name, name), settings).do()), settings)

    def explain(self, rule: Annotated[str, Field(description="The name of a rule, as findings have it.")]) -> Answer:
        """Say what a rule finds, why it matters, and what to write instead."""
        found = find_rule(rule)
        if found is None:
            raise ValueError(f"no rule is called {rule!r}; {did_you_mean(rule, rules()) or 'findings name theirs'}")
        return {"rule": found.rule.name, "severity": severity_words(found.rule), **dict(sections(found.rule))}

    def fix(
        self,
        path: ModelPath,
        unsafe: Annotated[bool, Field(description="Also apply what is a guess, or may make another robot.")] = False,
        write: Annotated[bool, Field(description="Write the files; else nothing is changed.")] = False,
    ) -> Answer:
        """Fix what can be fixed in a model file and in the xacro files that it includes, as a preview or on the disk.

        Nothing else in a file is changed. The answer has the difference, and the findings that are left.
        """
        name, settings = self._named(path)
        source = InputSource(name, name)

        def look(content: str | bytes, name: str, unsaved: Mapping[str, bytes]) -> LoadResult:
            return _task(InputSource(content, name), settings).with_unsaved(unsaved).look()

        fixing = Fixing(look, settings.load_options, settings.policy, unsafe=unsafe)
        fixed = fix_source(source, fixing)
        outside = [each.source.name for each in fixed.included if not self._readable.allows(each.source.name)]
        if outside:
            fixed = fix_source(source, fixing, closed=outside)
        rewrites = merged(each for each in (fixed.rewrite, *fixed.included) if each and each.is_change)
        if write:
            write_back(rewrites)
        left = CheckedFile.of(fixed.loaded, _reporting(settings), named=True)
        return {
            **_findings(left),
            "difference": "".join(map(text_difference, rewrites)),
            "written": [each.source.name for each in rewrites] if write else [],
            "messages": fixed.news,
        }

    def convert(
        self,
        path: ModelPath,
        to: Annotated[Literal["urdf", "sdf", "mjcf"], Field(description="The format of the result.")],
        output: Annotated[str, Field(description="Where to write the result; else the answer has its text.")] = "",
        sdf_version: Annotated[str, Field(description="The version of SDF to write, such as 1.9.")] = "",
        passes: Annotated[str, Field(description="Passes to run before, such as 'fill-limits{effort=100}'.")] = "",
    ) -> Answer:
        """Convert a model file to URDF, SDF or MJCF, and list what the result does not express as the source did."""
        name, settings = self._named(path)
        place = self._place_of(output, to) if output else None
        asked: RequestOptions = {
            "sdf_version": sdf_version or None,
            "passes": passes or None,
            "side_files": place is not None,
        }
        request, load_options = ConversionRequest.of(to, asked), settings.load_options
        if any(isinstance(step, FilesPass) for step in request.passes):
            raise ValueError("a pass makes files beside the result: run `twinform convert`")
        try:
            made = run_conversion(request, name, load_options)
        except CompileError as error:
            return _rows(name, error.diagnostics, settings)
        outputs = Outputs([Path(name)])
        if place:
            outputs.add("output", place, made.text)
            outputs.add_beside(place, made.side_files)
            outputs.write(load_options.search.seen)
        return {
            **_rows(name, made.diagnostics, settings),
            "ledger": json.loads(made.ledger.to_json()),
            **({"written": [str(each.path) for each, _ in outputs.texts]} if place else {"text": made.text}),
        }

    def diff(
        self, a: ModelPath, b: Annotated[str, Field(description="The file to compare it with, in any format.")]
    ) -> Answer:
        """Say whether two files describe the same robot, and what differs, where and by how much."""
        (one, settings), (other, _) = self._named(a), self._named(b)
        try:
            found = compare_files(one, other, settings.load_options)
        except CompileError as error:
            return _rows(one, error.diagnostics, settings)
        return json.loads(COMPARISON_REPORTERS["json"](found))

    def stats(self, path: ModelPath) -> Answer:
        """Count what a model is made of: links, joints, masses, shapes, triangles, sensors, plugins, and their cost."""
        name, settings = self._named(path)
        loaded = read_model(InputSource(name, name), settings.load_options, {})
        if loaded.document is None or not loaded.accepted:
            return _rows(name, loaded.diagnostics, settings)
        found = measure(loaded, loaded.document, settings.load_options.search)
        return json.loads(STATISTICS_REPORTERS["json"]([found]))

    def schema(
        self,
        format: Annotated[Literal["urdf", "sdf", "mjcf"], Field(description="The format.")],
        element: Annotated[str, Field(description="An element, such as joint or axis/limit.")],
        version: Annotated[str, Field(description="A version of the format; the newest if it is not given.")] = "",
    ) -> Answer:
        """Say where an element may stand, and what it may have: attributes and elements, types, units, defaults."""
        return element_facts(format, element, version)

    @property
    def _readable(self) -> Readable:
        return Readable(around=(os.path.realpath(self.root),))

    def _named(self, path: str) -> tuple[str, EditorSettings]:
        """Return the name of a file, relative to the root, and the settings for it.

        Raises:
            ValueError: it is not below the root, or hidden.
        """
        name = self._below(path)
        return name, settings_of(self.root / name)

    def _below(self, path: str) -> str:
        """Return a path without links, relative to the root.

        Raises:
            ValueError: it is not below the root, or hidden.
        """
        real = os.path.realpath(self.root / path)
        if not self._readable.allows(real):
            raise ValueError(f"{path!r} is hidden or not below the root, {str(self.root)!r}")
        return os.path.relpath(real, self.root)

    def _place_of(self, output: str, to: str) -> Path:
        """Return where a result may be written.

        Raises:
            ValueError: it is not below the root, or hidden, or not called like a model.
        """
        place = Path(self._below(output))
        endings = _ENDINGS[to]
        if place.suffix not in endings:
            raise ValueError(f"{output} has to end in {' or '.join(endings)}")
        return place


_ENDINGS = {"urdf": (".urdf",), "sdf": (".sdf", ".world"), "mjcf": (".xml", ".mjcf")}
"""The endings of files in a format."""
TOOLS: Mapping[str, Callable[..., Answer]] = {
    each.__name__: each
    for each in (
        ModelTools.check,
        ModelTools.explain,
        ModelTools.fix,
        ModelTools.convert,
        ModelTools.diff,
        ModelTools.stats,
        ModelTools.schema,
    )
}
"""Every tool by its name, with the tools as its first argument."""
WRITERS = frozenset({"fix", "convert"})
"""The tools that write files where they are asked to."""


def answer(tools: ModelTools, name: str, given: Mapping[str, Any]) -> Answer | str:
    """Run a tool; return a text with the reason where it has no answer."""
    try:
        return TOOLS[name](tools, **given)
    except (OSError, ValueError, PassError, RuleRegistryError) as error:
        return str(error)
    except click.ClickException as error:
        return error.format_message()


def _task(source: InputSource, settings: EditorSettings) -> CheckTask:
    role = CheckPlan.of([source], [source.name], settings.load_options).roles.get(source.name, "robot")
    return CheckTask(source, settings.load_options, None, False, _reporting(settings), role)


def _reporting(settings: EditorSettings) -> Reporting:
    return Reporting(settings.policy, fixed=Severity.WARNING, shown=Severity.INFO)


def _findings(checked: CheckedFile) -> Answer:
    """Return the findings of a file as `--format json` prints them."""
    return json.loads(REPORTERS["json"]([checked.findings]))


def _rows(name: str, found: tuple[Diagnostic, ...], settings: EditorSettings) -> Answer:
    """Return what was found where a model was read for another purpose than a check."""
    return _findings(CheckedFile.of(LoadResult(name, None, found), _reporting(settings), named=False))


def _with_problem(answer: Answer, settings: EditorSettings) -> Answer:
    """Add why the settings of the project were ignored, if they were."""
    return {**answer, "ignored_settings": settings.problem} if settings.problem else answer
