"""Distributions of passes and rules, as pip would install them."""

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from twinform.passes import GROUP


class Install(Protocol):
    """Puts a distribution with these passes on the path."""

    def __call__(self, distribution: str, passes: Mapping[str, str]) -> None: ...


def write_distribution(folder: Path, distribution: str, entries: Mapping[str, str], group: str = GROUP) -> None:
    """Put the metadata of a distribution with these entry points into a folder."""
    info = folder / f"{distribution}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {distribution}\nVersion: 1.0\n")
    lines = [f"{name} = {value}" for name, value in entries.items()]
    (info / "entry_points.txt").write_text("\n".join([f"[{group}]", *lines]) + "\n")
