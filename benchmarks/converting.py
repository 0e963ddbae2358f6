"""Files of the corpus in the other format, as engines and readers are shown them."""

from pathlib import Path

import twinform
from tests.corpus.files import CorpusFile, Kind

SDF_VERSION = "1.9"
"""The newest one that Gazebo Fortress reads."""


def converted(file: CorpusFile, output: Path) -> Path | None:
    """The file converted, as `output` with the ending of its format; None where it is refused."""
    to_sdf = file.kind is Kind.URDF
    try:
        if to_sdf:
            text = twinform.convert(file.path, to="sdf", sdf_version=SDF_VERSION).text
        else:
            text = twinform.convert(file.path, to="urdf").text
    except twinform.CompileError:
        return None
    path = output.with_name(f"{output.name}.{'sdf' if to_sdf else 'urdf'}")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path
