"""Compares two files, and collects the differences for every reader."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Unpack

from twinform.compiler.compare.compared_robot import ComparedRobot
from twinform.compiler.compare.comparison import (
    TOLERANCE,
    USUAL,
    ComparedSubject,
    Comparison,
    ComparisonFindings,
    ComparisonOptions,
    Difference,
    Terms,
)
from twinform.compiler.compare.read_robots import Robots, read_robots
from twinform.compiler.compare.readers import ComparingReader, Memo, reconcile
from twinform.compiler.compare.surroundings import compare_surroundings
from twinform.compiler.compare.usd_terms import SINGLE_PRECISION
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.load_options import FileOptions
from twinform.compiler.input.loading import (
    Input,
    LoadOptions,
    LoadResult,
    garbage_collection_paused,
    is_usd,
    name_of_input,
)
from twinform.option import require_options


def diff(
    a: Input,
    b: Input,
    *,
    model: str | None = None,
    tolerance: float = TOLERANCE,
    carriers: bool = False,
    **options: Unpack[FileOptions],
) -> Comparison:
    """Compare the robots in two files or documents, of either format or USD. Includes are always expanded.

    Example:
        >>> found = twinform.diff("examples/rover.urdf", "examples/four_wheels.urdf")
        >>> found.same, len(found.differences) > 10
        (False, True)

    Args:
        a: The path of a file, the bytes of one, or a document.
        b: Another one.
        model: The model to compare, where a file has several; without it those of two worlds are paired by their names.
        tolerance: The relative difference that counts as rounding; absolute for positions (m) and angles (rad).
        carriers: What only a carrier or `<gazebo>` says counts as if it were written where every reader looks, and not
            as `carried`.

    Keyword Args:
        strict: Refuse what readers ignore, such as unknown names.
        engine: The XSD validator; xmlschema is the slow reference.
        paths: A folder of models or packages, looked in before those that the environment names; repeatable.
        env: An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any letters.
        xacro: Expand all files, or none; by default those called .xacro, .xacro.urdf or .xacro.sdf.
        max_size: The largest file that is read, such as 200MB or 1GiB; by default 64MiB.
        max_tags: The most tags of a file, or parts of a JSON document; by default 1,000,000.
        arguments: The arguments of xacro files, by their names.

    Raises:
        CompileError: a file has an error; what was found is in its diagnostics.
        FileNotFoundError: there is no such file; this is a CompileError too.
        TypeError: there is no such option.
        ValueError: an option has no such value.
    """
    require_options(options, FileOptions)
    load_options = LoadOptions.of(options)
    return compare_files(a, b, load_options, ComparisonOptions(tolerance, carriers), model=model)


def compare_files(
    a: Input | LoadResult,
    b: Input | LoadResult,
    load_options: LoadOptions,
    options: ComparisonOptions = USUAL,
    *,
    names: tuple[str, str] = ("", ""),
    model: str | None = None,
) -> Comparison:
    """Compare two files as `diff` does, with the options as objects; `names` are used in messages instead of paths.

    Raises:
        CompileError: a file has an error; where both have, the diagnostics are those of both.
    """
    names = (names[0] or _display_name(a, "a"), names[1] or _display_name(b, "b"))
    with garbage_collection_paused():
        readers = (ComparingReader.TWINFORM,) if options.carriers else tuple(ComparingReader)
        robots, alike, files = dict[int, dict[ComparingReader, Robots]](), Memo(), dict[Path, str]()
        errors: dict[int, CompileError] = {}
        inputs, known = (a, b), None
        # What names of USD may stand for is read first.
        for side in sorted(range(2), key=lambda side: is_usd(inputs[side])):
            try:
                robots[side] = read_robots(
                    inputs[side],
                    load_options,
                    name=names[side],
                    model=model,
                    readers=readers,
                    alike=alike,
                    files=files,
                    known=known,
                )
                known = _names_in(robots[side][readers[-1]])
            except CompileError as error:
                errors[side] = error
        if errors:
            found = tuple(diagnostic for side in sorted(errors) for diagnostic in errors[side].diagnostics)
            raise type(errors[min(errors)])(found, unreadable=any(error.unreadable for error in errors.values()))
        one, other = robots[0], robots[1]
        names = (one[readers[0]].path, other[readers[0]].path)
        tolerance = max(options.tolerance, SINGLE_PRECISION) if any(map(is_usd, inputs)) else options.tolerance
        return Comparison(*names, tolerance, tuple(_compare_for_readers(one, other, tolerance)))


def _names_in(robots: Robots) -> frozenset[str]:
    """Return the names of all links, joints and frames."""
    each = robots.by_name.values()
    return frozenset(name for robot in each for part in (robot.bodies, robot.joints, robot.frames) for name in part)


def _display_name(source: Input | LoadResult, default: str) -> str:
    name = name_of_input(source)
    return f"<{default}>" if name in {"<bytes>", "<document>"} else name


def _compare_for_readers(
    a: Mapping[ComparingReader, Robots], b: Mapping[ComparingReader, Robots], tolerance: float
) -> Iterable[Difference]:
    """Return the differences that every reader sees, and those that only some see."""
    first, *more = a
    pair = a[first], b[first]
    memos = defaultdict[str, Memo](Memo)
    found = list(_compare_for_reader(*pair, tolerance, memos))
    for reader in more:
        seen = a[reader], b[reader]
        # What two readers see alike is built and compared once: asking for every reader costs
        # little where carriers touch little.
        if seen[0] is not pair[0] or seen[1] is not pair[1]:
            files = pair[0].path, pair[1].path
            found = reconcile(found, list(_compare_for_reader(*seen, tolerance, memos)), reader, files)
        pair = seen
    return found


def _compare_for_reader(a: Robots, b: Robots, tolerance: float, memos: Mapping[str, Memo]) -> Iterator[Difference]:
    """Yield the differences that one reader sees; `memos` have the last results for each pair of robots."""
    of_mjcf = a.of_mjcf and b.of_mjcf
    terms = Terms(a.path, b.path, a.format, b.format, tolerance, {**a.origins, **b.origins}, of_mjcf)
    yield from compare_surroundings(a.around, b.around, terms)
    if len(a.by_name) == len(b.by_name) == 1:
        (one,), (other,) = a.by_name.values(), b.by_name.values()
        yield from _compare_pair(one, other, terms, memos[""])
        return
    for name, robot in a.by_name.items():
        if name in b.by_name:
            yield from _compare_pair(robot, b.by_name[name], terms, memos[name], several=True)
        else:
            yield from _report_missing(robot, terms, in_a=True)
    for name, robot in b.by_name.items():
        if name not in a.by_name:
            yield from _report_missing(robot, terms, in_a=False)


def _compare_pair(
    a: ComparedRobot, b: ComparedRobot, terms: Terms, memo: Memo, *, several: bool = False
) -> Iterable[Difference]:
    if a.bodies is b.bodies:  # made once for both files
        return ()
    from twinform.compiler.compare.compare_robots import RobotComparison  # noqa: PLC0415 - for robots that differ

    return memo.once("robot", (a, b), lambda: RobotComparison(a, b, terms, memo, several=several).run())


def _report_missing(robot: ComparedRobot, terms: Terms, *, in_a: bool) -> list[Difference]:
    found = ComparisonFindings(terms)
    found.add_one_sided(ComparedSubject("model", robot.name), "", "model", robot.where, in_a=in_a)
    return found.items
