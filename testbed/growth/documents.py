"""Documents of any size, each of one kind of part many times: `documents.toml`."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

_ENDS = {
    "urdf": ('<robot name="r">', "</robot>"),
    "sdf": ('<sdf version="1.11">', "</sdf>"),
    "mjcf": ("<mujoco>", "</mujoco>"),
}


@dataclass(frozen=True, slots=True)
class GrowingDocument:
    """A document that can have any size."""

    name: str
    format: str
    lines: tuple[str, ...]

    def text(self, size: int, line_end: str = "\n") -> str:
        """Return the document with `size` parts; with an empty line end it is one line."""
        first, last = _ENDS[self.format]
        made = [first]
        for line in self.lines:
            is_repeated = line.startswith("* ")
            made += (
                [line[2:].replace("{i}", str(i)).replace("{j}", str(i + 1)) for i in range(size)]
                if is_repeated
                else [line]
            )
        return line_end.join([*made, last])

    def write(self, folder: Path, size: int, line_end: str = "\n") -> Path:
        """Write the document with `size` parts into a folder."""
        path = folder / f"in{size}.{self.format}"
        path.write_text(self.text(size, line_end), encoding="utf-8")
        return path


def growing_documents() -> list[GrowingDocument]:
    """Return all documents, those of URDF first."""
    table = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    parts: dict[str, str] = table.pop("parts")
    return [
        GrowingDocument(name, format, tuple(_with_parts(line, parts) for line in lines))
        for format, documents in table.items()
        for name, lines in documents.items()
    ]


def _with_parts(line: str, parts: dict[str, str]) -> str:
    for name, part in parts.items():
        line = line.replace(f"{{{name}}}", part)
    return line


def write_folder(folder: Path, size: int) -> Path:
    """Make a folder of files whose meshes are missing, in a package and in the folder."""
    folder.mkdir()
    for number in range(size):
        meshes = "".join(
            f'<visual><geometry><mesh filename="{place}/part{number}.stl"/></geometry></visual>'
            for place in ("package://near", "meshes", ".")
        )
        text = f'<robot name="r"><link name="a">{meshes}</link></robot>'
        (folder / f"robot{number}.urdf").write_text(text, encoding="utf-8")
    return folder
