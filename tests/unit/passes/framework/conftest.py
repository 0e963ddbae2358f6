import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Protocol

import pytest

from twinform.passes import GROUP, registered_passes


class Install(Protocol):
    def __call__(self, distribution: str, passes: Mapping[str, str]) -> None: ...


@pytest.fixture(scope="module")
def install(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Install]:
    """Put a distribution with these passes on the path, as pip would; all are gone at the end of the file."""
    with pytest.MonkeyPatch.context() as patch:

        def put(distribution: str, passes: Mapping[str, str]) -> None:
            folder = tmp_path_factory.mktemp("site")
            write_distribution(folder, distribution, passes)
            patch.setattr("sys.path", [str(folder), *sys.path])
            registered_passes.cache_clear()

        yield put
    registered_passes.cache_clear()


def write_distribution(folder: Path, distribution: str, entries: Mapping[str, str], group: str = GROUP) -> None:
    """Put the metadata of a distribution with these entry points into a folder."""
    info = folder / f"{distribution}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {distribution}\nVersion: 1.0\n")
    lines = [f"{name} = {value}" for name, value in entries.items()]
    (info / "entry_points.txt").write_text("\n".join([f"[{group}]", *lines]) + "\n")
