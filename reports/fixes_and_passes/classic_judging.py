"""What libsdformat 12, the reader of Fortress, reports about migrated files and about their sources."""

import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import twinform
from testbed.corpus.files import CorpusFile
from testbed.output_files import SDF_VERSION
from twinform.testing.oracles.libsdformat import available, judge

MIGRATED = "migrate-gazebo-classic{release=fortress controllers=controllers.yaml}"
_LARGEST = 2_000_000
"""In bytes: larger worlds take the library minutes, and are made of includes."""


@dataclass(frozen=True, slots=True)
class Judged:
    """One file: whether it was read before and after, and the errors that only the migrated one has."""

    name: str
    before: bool
    after: bool
    new: tuple[str, ...]


def judged(files: Iterable[CorpusFile]) -> list[Judged]:
    """Each file without and with the migration, as SDF, before the library; nothing where it is not here."""
    if not available():
        return []
    with tempfile.TemporaryDirectory() as folder:
        pairs = dict(_written(files, Path(folder)))
        verdicts = judge(path for pair in pairs.values() for path in pair)
        return [
            Judged(name, verdicts[old].ok, verdicts[new].ok, _new_errors(verdicts[old].errors, verdicts[new].errors))
            for name, (old, new) in pairs.items()
        ]


def _written(files: Iterable[CorpusFile], folder: Path) -> Iterator[tuple[str, tuple[Path, Path]]]:
    for number, file in enumerate(files):
        if file.path.stat().st_size > _LARGEST:
            continue
        paths = (folder / f"{number}_source.sdf", folder / f"{number}_migrated.sdf")
        for path, passes in zip(paths, ("", MIGRATED), strict=True):
            path.write_text(
                twinform.convert(file.path, to="sdf", sdf_version=SDF_VERSION, passes=passes, paths=file.paths).text,
                "utf-8",
            )
        yield file.name, (paths[0].resolve(), paths[1].resolve())


def _new_errors(before: tuple[str, ...], after: tuple[str, ...]) -> tuple[str, ...]:
    """Errors of a kind that the source does not have."""
    known = {error.partition(":")[0] for error in before}
    return tuple(error for error in after if error.partition(":")[0] not in known)
