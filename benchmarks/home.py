"""What does not come home from the other format: `python -m benchmarks.home [FILE...]`, all of the corpus without one.

Every robot is taken there and back, and what its normal form lacks, or has too much, is counted by direction, kind and
place, the names left out of it, with a file for example.
"""

import argparse
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import twinform
from benchmarks.astray import COLUMNS, by_place, place_of
from benchmarks.markdown import table
from tests.corpus.files import CORPUS, MISSING, CorpusFile, Kind, models
from tests.corpus.there_and_back import taken_there
from twinform.testing.round_trips import Astray
from twinform.testing.workers import Failure, run


@dataclass(frozen=True, slots=True)
class Return:
    """How one robot came home."""

    name: str
    format: Kind
    astray: tuple[Astray, ...] = ()


def main(arguments: list[str] | None = None) -> int:
    """Go there and back, and print what is not back."""
    parser = argparse.ArgumentParser(prog="benchmarks.home", description=__doc__)
    parser.add_argument("files", nargs="*", help="files, or words in the names of files of the corpus")
    parser.add_argument("--limit", type=int, default=40, help="so many lines for each direction")
    parser.add_argument("--every", type=int, default=1, help="one of so many files of the corpus")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument(
        "--show", metavar="WORDS", default="", help="print each finding whose kind and place have these"
    )
    options = parser.parse_args(arguments)
    chosen = list(_chosen(options.files))[:: options.every]
    if not chosen:
        print(MISSING if not CORPUS.is_dir() else "no such file", file=sys.stderr)
        return 2
    found = list(_returns(run(come_home, chosen, processes=options.jobs)))
    for format in (Kind.URDF, Kind.SDF):
        _report([one for one in found if one.format is format], format, options.limit)
    for one in found:
        for each in one.astray:
            if options.show and options.show in f"{each.kind} {place_of(each)}":
                print(f"{one.name}: {each.kind}: {each.message}")
    return 0


def come_home(file: CorpusFile) -> tuple[Return, ...]:
    """Take every robot of a file there and back; no exception comes out of it."""
    return tuple(_tried(file))


def _tried(file: CorpusFile) -> Iterator[Return]:
    checked = twinform.check(file.path)
    if not checked.accepted or checked.document is None:
        return
    try:
        for there in taken_there(file, checked.document):
            name = f"{file.name} {there.name or ''}".strip()
            yield Return(name, file.kind, tuple(there.astray(there.made.text)))
    except twinform.CompileError:
        return  # `make corpus` tells of what is not converted
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        yield Return(file.name, file.kind, (Astray(f"crash: {type(error).__name__}", "", str(error)),))


def _chosen(files: list[str]) -> Iterator[CorpusFile]:
    """The files of the corpus whose names have one of the words, and the files that lie elsewhere."""
    elsewhere = [Path(each).resolve() for each in files if Path(each).is_file()]
    words = [each for each in files if not Path(each).is_file()]
    for path in elsewhere:
        kind = Kind.URDF if path.suffix == ".urdf" else Kind.SDF
        yield CorpusFile(str(path), kind, {})
    for file in models():
        if not files or any(word in file.name for word in words):
            yield file


def _returns(results: Iterable[tuple[CorpusFile, tuple[Return, ...] | Failure]]) -> Iterator[Return]:
    for file, found in results:
        if isinstance(found, Failure):
            yield Return(file.name, file.kind, (Astray(f"crash: {found.cause}", "", ""),))
        else:
            yield from found


def _report(found: list[Return], format: Kind, limit: int) -> None:
    home = sum(not one.astray for one in found)
    rows = by_place((one.name, one.astray) for one in found)
    print(f"\n## {format} to the other format and back\n\n{len(found)} robots; {home} are home.\n")
    print(table(COLUMNS, rows[:limit]))
    print(f"{len(rows) - limit} more kinds of place." if len(rows) > limit else "")


if __name__ == "__main__":
    sys.exit(main())
