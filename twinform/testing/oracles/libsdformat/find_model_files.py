"""Where libsdformat 12 finds the files that models name."""

import json
import os
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from twinform.testing.oracles.programs import Program

_PROGRAM = Program(Path(__file__).with_name("sdf_files.cpp"), ("sdformat12",))


@dataclass(frozen=True, slots=True)
class NamedFiles:
    """The errors of loading a file, and the path of each URI in it; None where the library finds nothing."""

    errors: tuple[str, ...]
    paths: dict[str, Path | None]


def named_files(file: Path, folders: Iterable[Path] = ()) -> NamedFiles:
    """The meshes, terrains, scripts and textures of all models, looked for in the folders, and in no others."""
    places = os.pathsep.join(str(folder.resolve()) for folder in folders)
    done = subprocess.run(
        [str(_PROGRAM.built()), str(file.resolve())],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        check=True,
        cwd="/",
        env={**os.environ, "SDF_PATH": places},
    )
    rows: list[dict[str, str]] = [json.loads(line) for line in done.stdout.decode(errors="replace").splitlines()]
    errors = tuple(row["error"] for row in rows if "error" in row)
    paths = {row["uri"]: Path(row["path"]) if row["path"] else None for row in rows if "uri" in row}
    return NamedFiles(errors, paths)
