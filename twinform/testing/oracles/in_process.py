"""Reading and comparing files with an engine in this process, which it may crash; `isolated.py` starts one for it."""

from importlib import import_module
from pathlib import Path

from twinform.testing.oracles.engines import required
from twinform.testing.oracles.robot import EngineRobot, View
from twinform.testing.oracles.robot_comparison import chained, judge, renamed
from twinform.testing.oracles.verdict import EngineUnreadableError, Verdict


def read_robot(path: Path, engine: str, view: View | None = None) -> EngineRobot:
    """What an engine sees in a file.

    Raises:
        EngineMissingError: it is not installed.
        UnreadableError: it cannot read the file.
    """
    chosen = required(engine)
    if not chosen.reads(path):
        raise EngineUnreadableError(engine, path, f"it does not read {path.suffix or 'files without a suffix'}")
    try:
        return import_module(chosen.module).read(path, view or View())
    except (Exception, SystemExit) as error:
        raise EngineUnreadableError(engine, path, str(error) or type(error).__name__) from error


def verdict_on(
    first: EngineRobot, files: tuple[Path, Path], engines: tuple[str, str], *, lumped: bool = False
) -> Verdict:
    """The verdict on two files, of which the first has been looked at.

    Raises:
        UnreadableError: an engine cannot read its file.
    """
    (source, result), (before, after) = files, engines
    second = read_robot(result, after, View(reference=first.reference))
    names = renamed(first, second)
    here, there = chained(first, second), chained(second, first)
    if names or here:
        second = read_robot(result, after, View(names, first.reference, here))
    # Both are seen from one link, or the poses of all others would differ by that of the root.
    if second.reference != first.reference or there:
        first = read_robot(source, before, View(reference=second.reference, still=there))
    tolerance = max(required(engine).formats[path.suffix] for engine, path in zip(engines, files, strict=True))
    return judge(first, second, tolerance=tolerance, lumped=lumped, chains=bool(here or there))


def compared(first: Path, second: Path, engines: tuple[str, str], lumped: bool) -> Verdict:
    """The verdict on two files.

    Raises:
        UnreadableError: an engine cannot read its file.
    """
    return verdict_on(read_robot(first, engines[0]), (first, second), engines, lumped=lumped)
