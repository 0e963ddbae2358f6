"""Do two files describe the same robot?"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Unpack

from twinform.compiler.compare.canonical_sdf import Robots, read_robots
from twinform.compiler.compare.collect_differences import ComparedSubject, ComparisonFindings, Terms
from twinform.compiler.compare.compare_robots import RobotComparison
from twinform.compiler.compare.compared_robot import ComparedRobot
from twinform.compiler.compare.comparison import TOLERANCE, USUAL, Comparison, ComparisonOptions, Difference
from twinform.compiler.compare.memo import Memo
from twinform.compiler.compare.readers import ComparingReader, reconcile
from twinform.compiler.compare.surroundings import compare_surroundings
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.load_options import FileOptions
from twinform.compiler.input.loading import Input, LoadOptions, LoadResult, garbage_collection_paused, name_of_input
from twinform.compiler.option import require_options


def diff(
    a: Input,
    b: Input,
    *,
    model: str | None = None,
    tolerance: float = TOLERANCE,
    carriers: bool = False,
    **options: Unpack[FileOptions],
) -> Comparison:
    """Compare the robots in two files or documents, of either format; `model` names one where a file has several.

    Without it the models of two worlds are compared by their names. What only a carrier or `<gazebo>` says is
    `carried`; with `carriers` it counts as if it were written where every reader looks. The other
    options are those of `check`; includes are always expanded.

    Raises:
        CompileError: a file has an error; what was found is in its diagnostics.
        TypeError: there is no such option.
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
    """`diff`, with all that it needs to know in one place.

    Raises:
        CompileError: a file has an error; where both have, the diagnostics are those of both.
    """
    names = (names[0] or _name(a, "a"), names[1] or _name(b, "b"))
    with garbage_collection_paused():
        readers = (ComparingReader.TWINFORM,) if options.carriers else tuple(ComparingReader)
        robots: list[dict[ComparingReader, Robots]] = []
        errors: list[CompileError] = []
        for source, name in zip((a, b), names, strict=True):
            try:
                robots.append(read_robots(source, load_options, name=name, model=model, readers=readers))
            except CompileError as error:
                errors.append(error)
        if errors:
            found = tuple(diagnostic for error in errors for diagnostic in error.diagnostics)
            raise CompileError(found, unreadable=any(error.unreadable for error in errors))
        one, other = robots
        names = (one[readers[0]].path, other[readers[0]].path)
        return Comparison(*names, options.tolerance, tuple(_seen_by_all(one, other, options.tolerance)))


def _name(source: Input | LoadResult, default: str) -> str:
    name = name_of_input(source)
    return f"<{default}>" if name in {"<bytes>", "<document>"} else name


def _seen_by_all(
    a: Mapping[ComparingReader, Robots], b: Mapping[ComparingReader, Robots], tolerance: float
) -> Iterable[Difference]:
    """What every reader finds, and what only some of them do."""
    first, *more = a
    pair = a[first], b[first]
    memos = defaultdict[str, Memo](Memo)
    found = list(_compared(*pair, tolerance, memos))
    for reader in more:
        seen = a[reader], b[reader]
        # What two readers see alike is built and compared once: asking for every reader costs
        # little where carriers touch little.
        if seen[0] is not pair[0] or seen[1] is not pair[1]:
            files = pair[0].path, pair[1].path
            found = reconcile(found, list(_compared(*seen, tolerance, memos)), reader, files)
        pair = seen
    return found


def _compared(a: Robots, b: Robots, tolerance: float, memos: Mapping[str, Memo]) -> Iterator[Difference]:
    """What one reader finds; `memos` have what the reader before it found in each pair of robots."""
    terms = Terms(a.path, b.path, a.format, b.format, tolerance, {**a.origins, **b.origins})
    yield from compare_surroundings(a.around, b.around, terms)
    if len(a.by_name) == len(b.by_name) == 1:
        (one,), (other,) = a.by_name.values(), b.by_name.values()
        yield from _compared_robots(one, other, terms, memos[""])
        return
    for name, robot in a.by_name.items():
        if name in b.by_name:
            yield from _compared_robots(robot, b.by_name[name], terms, memos[name], several=True)
        else:
            yield from _missing(robot, terms, in_a=True)
    for name, robot in b.by_name.items():
        if name not in a.by_name:
            yield from _missing(robot, terms, in_a=False)


def _compared_robots(
    a: ComparedRobot, b: ComparedRobot, terms: Terms, memo: Memo, *, several: bool = False
) -> Iterable[Difference]:
    return memo.once("robot", (a, b), lambda: RobotComparison(a, b, terms, memo, several=several).run())


def _missing(robot: ComparedRobot, terms: Terms, *, in_a: bool) -> list[Difference]:
    found = ComparisonFindings(terms)
    found.only_in_one(ComparedSubject("model", robot.name), "", "model", robot.where, in_a=in_a)
    return found.items
