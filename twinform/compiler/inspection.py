"""Checks of `twinform check` beyond validity: named files, driven joints, mass of moving links, read-only passes.

A conversion does without them; its passes report what becomes of such parts.
"""

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from twinform.compiler.input.allowances import report_unused, without_consequences
from twinform.compiler.input.finding_lines import with_exact_lines
from twinform.compiler.input.load_options import AnyCheckOptions, Input, LoadResult, checking_options
from twinform.compiler.input.loading import LoadOptions, read
from twinform.compiler.mistakes import report_mistakes
from twinform.compiler.mistakes.joined_findings import join_findings
from twinform.compiler.mistakes.launch_comments import report_comments
from twinform.compiler.mistakes.statics_checks import report_statics
from twinform.compiler.named_files import report_named_files
from twinform.diagnostics import (
    Diagnostic,
    DiagnosticSink,
    Location,
    Rule,
    Severity,
    did_you_mean,
    is_typo,
    near_names,
    rules,
)
from twinform.diagnostics.rules import MISSING_INERTIAL, UNKNOWN_COLLISION
from twinform.diagnostics.suppressions import NO_SUPPRESSIONS
from twinform.ir import Document, Element, Format, Link, Model
from twinform.option import require_options
from twinform.passes.carriers.annotations import find_annotation, is_synthesized
from twinform.passes.carriers.joint_chains import PART
from twinform.passes.carriers.lumped_names import mentions_collisions
from twinform.passes.joints.transmission import urdf_elements
from twinform.passes.shared.moving_bodies import ConnectedBodies, moving_bodies, neighbors

if TYPE_CHECKING:
    from twinform.passes import Pipeline


def inspect(loaded: LoadResult, load_options: LoadOptions, passes: "Pipeline | None" = None) -> LoadResult:
    """Add the findings of all inspections to a result of reading, and those of `passes` if there is no error.

    Raises:
        ReadOnlyPassError: a pass would change the document.
        PassError: a pass is at fault.
    """
    document = loaded.document or (loaded.recovered and loaded.recovered.document)
    if document is None:
        return _with_allowed(loaded, load_options)
    file = loaded.text_name
    sink = DiagnosticSink(file, load_options.strict)
    report_driven_joints(document, sink)
    # These checks take a fifth of the time of `check` where the files are there.
    report_contact_sensors(document, sink)
    errors = {each.rule for each in (*loaded.diagnostics, *loaded.allowed) if each.is_error}
    files = report_named_files(document, Path(loaded.path), load_options.search, loaded.tree, sink)
    if rules.TOO_MANY_INCLUDES not in errors:  # what is there of it is a part, and a large one
        if not any(each.unsound for each in errors):
            report_massless(document, sink)
            report_statics(document, sink)
        report_mistakes(document, loaded.tree, files, sink)
    if loaded.recovered:
        sink.diagnostics = without_consequences(sink.diagnostics, loaded.diagnostics, loaded.recovered.stand_ins)
    whole = DiagnosticSink(loaded.path, load_options.strict, list(loaded.diagnostics), origins=dict(loaded.origins))
    whole.allows, whole.allowed = loaded.allowances, list(loaded.allowed)
    worse = {(each.rule, each.location.path) for each in sink.diagnostics}
    whole.diagnostics = [each for each in whole.diagnostics if not _is_note_of(each, worse)]
    whole.extend_new(_with_lines(sink, loaded))
    report_comments(loaded, load_options.search, whole)
    if passes and loaded.accepted:
        from twinform.compiler.read_only_passes import run_read_only  # noqa: PLC0415 - few runs have passes

        found = DiagnosticSink(file, load_options.strict)
        run_read_only(document, passes, found, Path(loaded.path), load_options)
        whole.extend_new(_with_lines(found, loaded))
    if load_options.profiles:
        # few files are for certain consumers
        from twinform.compiler.inspect_for_consumers import report_for_consumers  # noqa: PLC0415 - see above

        report_for_consumers(loaded, load_options, whole)
    if loaded.allowances:
        # what was put back for a conversion may be allowed in a check
        loaded.allowances.checked, loaded.allowances.tolerant = True, load_options.tolerant
        loaded.allowances.settle(whole)
        # Errors keep other findings from being looked for, so a suppression of one of these would
        # seem unused.
        if not whole.has_errors:
            report_unused(loaded.allowances, whole)
    ordered = sorted(join_findings(whole.diagnostics), key=lambda each: each.location.line)
    return replace(loaded, diagnostics=tuple(ordered), allowed=tuple(whole.allowed))


def _with_allowed(loaded: LoadResult, load_options: LoadOptions) -> LoadResult:
    """Leave out what is allowed of the findings about a file that has no model."""
    whole = DiagnosticSink(loaded.path, load_options.strict, list(loaded.diagnostics), allowed=list(loaded.allowed))
    allowances = loaded.allowances or load_options.allowances(loaded.path, loaded.origins)
    if any(each.rule is rules.XACRO_REFUSED for each in loaded.diagnostics):
        allowances.files[loaded.path] = NO_SUPPRESSIONS  # nothing of the file is looked at
    allowances.checked, allowances.tolerant = True, load_options.tolerant
    allowances.settle(whole)
    return replace(loaded, diagnostics=tuple(whole.diagnostics), allowed=tuple(whole.allowed))


def as_refused(loaded: LoadResult) -> LoadResult:
    """Make errors of the findings for which readers that a file is for refuse it; a conversion does not go by them."""
    if not any(each.refused and not each.is_error for each in loaded.diagnostics):
        return loaded
    found = (replace(each, severity=Severity.ERROR) if each.refused else each for each in loaded.diagnostics)
    return replace(loaded, diagnostics=tuple(found))


def _is_note_of(finding: Diagnostic, worse: Collection[tuple[Rule, str]]) -> bool:
    """Whether a finding is a note about what was found to be worse than that, once it was seen what moves."""
    return finding.severity is Severity.INFO and (finding.rule, finding.location.path) in worse


def _with_lines(sink: DiagnosticSink, loaded: LoadResult) -> list[Diagnostic]:
    """Return the findings of a sink, with exact lines where there is a text."""
    found = sink.diagnostics
    return found if loaded.tree is None else list(with_exact_lines(found, loaded.tree, sink.file))


_COMPANIONS = frozenset({".srdf", ".xacro", ".yaml", ".yml"})
"""The suffixes of files that may name parts of a robot in another file."""
_DEFAULT_COLLISION = "__default__"
"""The name in SDF of a collision that is not written."""


def report_contact_sensors(document: Document, sink: DiagnosticSink) -> None:
    """Report contact sensors in `<gazebo>` that name no collision, as we or libsdformat call it.

    In SDF, references to collisions are verified when the file is read.
    """
    for model in document.models if document.format is Format.URDF else ():
        if mentions_collisions(model):
            _report_unknown_collisions(model, sink)


def _report_unknown_collisions(model: Model, sink: DiagnosticSink) -> None:
    from twinform.passes.legalise.lumped_names import (  # noqa: PLC0415 - few robots have such sensors
        names_of_libsdformat,
        own_collisions,
    )

    own = {each.name for each in own_collisions(model).values()}
    known = own | names_of_libsdformat(model).keys() | {_DEFAULT_COLLISION}
    for sensor in (one for each in model.extensions for part in each.content for one in part.walk()):
        contact = sensor.find("contact") if sensor.name == "sensor" and sensor.get("type") == "contact" else None
        for collision in contact.children if contact is not None else ():
            name = (collision.text or "").strip()
            if collision.name == "collision" and name and name.rpartition("::")[2] not in known and "$" not in name:
                _report_unknown_collision(sensor, collision, name, own, sink)


def _report_unknown_collision(
    sensor: Element, collision: Element, name: str, own: set[str], sink: DiagnosticSink
) -> None:
    message = f"contact sensor {sensor.get('name')!r} names the collision {name!r}, which does not exist"
    hint = did_you_mean(name.rpartition("::")[2], own)
    sink.report(UNKNOWN_COLLISION, message, collision.location, found=name, help=hint)


_HOLDERS = ("transmission", "ros2_control")
_JOINTS = ("joint", "passive_joint")
# Elements of a transmission that name the joint that it drives; the last four are those of the PR2.
_WITH_JOINT = frozenset({*_JOINTS, "gap_joint", "simulated_actuated_joint", "flexJoint", "rollJoint"})


def report_driven_joints(document: Document, sink: DiagnosticSink) -> None:
    """Report transmissions and `<ros2_control>` that name a joint which is not there, or no joint at all."""
    for model in document.models:
        _report_unknown_joints(model, document, sink)


def _report_unknown_joints(model: Model, document: Document, sink: DiagnosticSink) -> None:
    joints = {joint.name for joint in model.joints}
    unknown: list[tuple[str, str, Location]] = []
    for holder in _HOLDERS:
        for part, element in urdf_elements(model, document.format, holder):
            called = element.get("name") or ""
            if holder == "transmission" and not any(child.name in _WITH_JOINT for child in element.children):
                message = f"transmission {called!r} has no <joint>: it drives nothing"
                sink.report(rules.TRANSMISSION_WITHOUT_JOINT, message, part.location, expected="<joint name='...'>")
            for name, where in _named_joints(element, part.location):
                if name not in joints and "$" not in name:
                    unknown.append((f"<{holder}> {called!r} names the joint {name!r}", name, where))
    hints = [did_you_mean(name, joints) for _, name, _ in unknown]
    # A hand that the robot does not have, where nothing is misspelt.
    is_misspelt = any(is_typo(name, each) for _, name, _ in unknown for each in near_names(name, joints))
    is_of_another = len(unknown) >= _MANY and not is_misspelt
    rest = f", nor has it {len(unknown) - 1} others that are driven" if is_of_another else ""
    for (message, name, where), hint in list(zip(unknown, hints, strict=True))[: 1 if is_of_another else None]:
        whole = f"{message}, which the robot does not have{rest}"
        sink.report(rules.UNKNOWN_DRIVEN_JOINT, whole, where, found=name, help=hint)


def _named_joints(element: Element, place: Location) -> Iterator[tuple[str, Location]]:
    """Yield the joints that an element names, and where."""
    counts: Counter[str] = Counter()
    for child in element.children:
        counts[child.name] += 1
        name = child.get("name")
        if child.name in _JOINTS and name:
            yield name, place.at(f"{child.name}[@name='{name}']")


_FIX_ROOT = "if it is meant to stay where it is, fix it to the world by a joint of type fixed with the parent world"
_ADD_INERTIAL = "write one, or compute it from the shapes: --passes fill-inertia{density=...}"


def report_massless(document: Document, sink: DiagnosticSink) -> None:
    """Report links that move and have no mass, once where no link has any; in SDF, where they have 1 kg, as an info."""
    if document.format is Format.SDF:
        children = {joint.child for model in document.models for joint in model.joints}
        for link in (link for body in moving_bodies(document) for link in body if link.inertial is None):
            # In SDF the default is often meant. In URDF, Gazebo drops such a link.
            message = f"link {link.name!r} moves but has no <inertial>; simulators take 1 kg and 1 kg m^2"
            sink.report(
                MISSING_INERTIAL,
                message,
                link.location,
                expected="<inertial>",
                help=_ADD_INERTIAL if link.name in children else f"{_ADD_INERTIAL}; {_FIX_ROOT}",
                severity=Severity.INFO,
            )
        return
    weightless = [
        (each, moved)
        for each in neighbors(document)
        if not any(map(_has_mass, each.child)) and (moved := _moved_link(each))
    ]
    if len(weightless) >= _MANY and not any(link.inertial for model in document.models for link in model.links):
        message = f"no link of the robot has an <inertial>, and {len(weightless)} of them move"
        where = weightless[0][1].location
        sink.report(MISSING_INERTIAL, message, where, expected="<inertial>", help=_ADD_INERTIAL)
        return
    for each, moved in weightless:
        others = tuple(link.location for link in each.child if link is not moved)
        joined = f", nor has any of the {len(others)} fixed to it" if others else ""
        if moved.inertial is not None:
            message = f"joint {each.joint.name!r} moves link {moved.name!r}, whose mass is 0{joined}"
            where = moved.inertial.location
            sink.report(rules.NON_POSITIVE_MASS, message, where, found="0", expected="more than 0", related=others)
            continue
        message = f"joint {each.joint.name!r} moves link {moved.name!r}, which has no <inertial>{joined}"
        sink.report(
            MISSING_INERTIAL, message, moved.location, expected="<inertial>", help=_ADD_INERTIAL, related=others
        )


# So many links were not forgotten one by one: the robot was drawn to be planned with and seen.
_MANY = 3


def _moved_link(each: ConnectedBodies) -> Link | None:
    """Return the link that a joint moves; None for one that was made for a joint that URDF does not have."""
    # The joint may name a link that is not there, while something else fixes a body to that name.
    moved = next((link for link in each.child if link.name == each.joint.child), None)
    return None if moved is None or is_synthesized(moved) or find_annotation(moved, PART) else moved


def _has_mass(link: Link) -> bool:
    return link.inertial is not None and link.inertial.mass != 0


def check(
    source: Input, *, name: str = "", passes: "str | Pipeline | None" = None, **options: Unpack[AnyCheckOptions]
) -> LoadResult:
    """Read a file, the bytes of one or a document, and say everything that is wrong with it.

    SRDF, and YAML with parameters that name joints and links, are held against a robot. Findings that are allowed are
    not among the diagnostics of the result, but in `allowed`.

    Example:
        >>> [finding] = twinform.check(b'<robot name="a"><link nam="b"/></robot>').diagnostics
        >>> finding.rule.name, finding.help
        ('unknown-attribute', "did you mean 'name'?")

    Args:
        source: The path of a file, the bytes of one, or a document.
        name: What stands for the source in diagnostics, where it has no path.
        passes: Passes that change nothing, which are run on a model without errors for what they find.

    Keyword Args:
        strict: Refuse what readers ignore, such as unknown names.
        engine: The XSD validator; xmlschema is the slow reference.
        paths: A folder of models or packages, looked in before those that the environment names; repeatable.
        env: An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any letters.
        xacro: Expand all files, or none; by default those called .xacro, .xacro.urdf or .xacro.sdf.
        max_size: The largest file that is read, such as 200MB or 1GiB; by default 64MiB.
        max_tags: The most tags of a file, or parts of a JSON document; by default 1,000,000.
        arguments: The arguments of xacro files, by their names.
        expand_includes: Read the files that includes name, and put them in their place.
        allow: The rules whose findings are left out.
        profiles: The consumers of the model, or their names with commas between.
        robot: The robot that SRDF, and parameters which name joints and links, are for.

    Raises:
        ReadOnlyPassError: a pass would change the model.
        PassError: a pass is at fault.
        PipelineError: `passes` is not a pipeline.
        TypeError: there is no such option.
        ValueError: an option has no such value.
    """
    require_options(options, AnyCheckOptions)
    load_options = replace(checking_options(options), robot=str(options.get("robot", "")))
    if isinstance(passes, str):
        from twinform.passes import parse_pipeline  # noqa: PLC0415 - most checks have no passes

        passes = parse_pipeline(passes)
    if isinstance(source, str | Path) and Path(source).suffix.lower() in _COMPANIONS:
        from twinform.compiler.companions.check_companion import check_if_companion  # noqa: PLC0415 - few files are

        companion = check_if_companion(Path(source), load_options)
        if companion is not None:
            return companion
    loaded = read(source, load_options, name=name)
    if options.get("expand_includes"):
        from twinform.compiler.expand_includes import expand  # noqa: PLC0415 - most checks read one file

        loaded = expand(loaded, load_options)
    return as_refused(inspect(loaded, load_options, passes))
