"""Results of conversions as files below `out/`, as engines and readers are shown them."""

from pathlib import Path

import twinform
from testbed.corpus.files import ROOT, CorpusFile, Kind

OUT = ROOT / "out"
SDF_VERSION = "1.9"
"""The newest one that Gazebo Fortress reads, and with it libsdformat 12."""


def kept(path: Path, text: str | bytes) -> Path:
    """The path, with the text in it; a file that has it already keeps its time."""
    data = text.encode() if isinstance(text, str) else text
    if not path.is_file() or path.read_bytes() != data:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    return path


def converted(file: CorpusFile, output: Path) -> Path | None:
    """A file of the corpus in the other format, as `output` with its ending; None where it is refused."""
    to_sdf = file.kind is Kind.URDF
    try:
        if to_sdf:
            text = twinform.convert(file.path, to="sdf", sdf_version=SDF_VERSION, paths=file.paths).text
        else:
            text = twinform.convert(file.path, to="urdf", paths=file.paths).text
    except twinform.CompileError:
        return None
    return kept(output.with_name(f"{output.name}.{'sdf' if to_sdf else 'urdf'}"), text)
