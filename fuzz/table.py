"""The targets by their names: what each holds, where fuzzing begins, which words it tries, and what a run may cost."""

import io
import tarfile
import zipfile
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from time import process_time
from typing import Literal, NamedTuple, get_args

from lsprotocol.types import METHOD_TO_TYPES

from fuzz import targets
from twinform.cli.config_settings import FileSettings, FormatSettings, ProjectSettings
from twinform.compiler import check
from twinform.compiler.companions.name_places import telling_keys
from twinform.compiler.output.json import json_text
from twinform.diagnostics import catalog
from twinform.passes import registered_passes
from twinform.schemas import table
from twinform.schemas.facts import Fact

SECONDS = 3
"""Of processor time, for each input."""
_ROOT = Path(__file__).parents[1]
_CASES = _ROOT / "tests" / "cases"
_Mode = Literal["w", "w:gz", "w:bz2", "w:xz"]


class Target(NamedTuple):
    """A function that raises where it does not hold; `seeds` longer than `longest` are left out."""

    hold: Callable[[bytes], None]
    seeds: Callable[[], Iterable[bytes]]
    words: Callable[[], Iterable[str]]
    longest: int = 4096

    def __call__(self, data: bytes, seconds: int = SECONDS) -> None:
        """Try an input, with so many seconds of the processor.

        Raises:
            AssertionError: what must hold does not, or it takes too long.
        """
        begun = process_time()
        self.hold(data)
        used = process_time() - begun
        assert used < seconds, f"{used:.1f} s of the processor"


def _models() -> Iterator[bytes]:
    yield from _in(_CASES / "check", _CASES / "fix", _CASES / "convert", _ROOT / "examples")
    yield from (path.read_bytes() for path in sorted(_CASES.rglob("*.mjcf")))


def _in(*folders: Path) -> Iterator[bytes]:
    for folder in folders:
        yield from (path.read_bytes() for path in sorted(folder.glob("*.*df")))


def _elements() -> set[str]:
    names = set[str]()
    pending: list[Fact] = [row for format in ("urdf", "sdf", "mjcf") for row in table(format).definitions.values()]
    while pending:
        row = pending.pop()
        names.add(row.name.removeprefix("@"))
        names.update(row.enum)
        pending += row.rows
    return names


def _parameters() -> Iterator[bytes]:
    folder = _CASES / "companions"
    yield from (each.read_bytes() for each in sorted(folder.rglob("*.yaml")))
    yield from (each.read_bytes() for each in sorted(folder.rglob("*.srdf*")))
    yield (
        b"n:\n  ros__parameters:\n    joints: &a [hip, 'hip', \"hip\"]\n    gains.hip.p: 1\n"
        b"    x: *a\n    base_frame_id: base\n"
    )


def _pipelines() -> Iterator[bytes]:
    yield b"fill-limits{effort=10},check-inertia"
    yield b"drop{links=[a,b]},rename{links={a=b}},@name"


def _passes() -> Iterator[str]:
    for name, found in registered_passes().items():
        yield name
        yield from found.load().model_fields


def _patterns() -> Iterator[bytes]:
    yield b"# made\n/out/\n*.tmp.urdf\n!keep.tmp.urdf\ndeep/**/x.urdf\n\\#odd.urdf\n\0out/a.urdf\na/b.tmp.urdf\nb.urdf"
    yield b"*a*a*a*b\n[!a-z]?\0aaaaaaaa\nb"
    yield b"twinform: allow missing-limit, a - reason\ntwinform: allow-file b\0a"


def _configurations() -> Iterator[bytes]:
    yield (_ROOT / "examples" / "project" / "twinform.toml").read_bytes()
    yield (
        b'sdf-version = "1.9"\nmax-size = "1MB"\nmax-tags = 9\nallow = ["missing-limit"]\nexclude = ["*a"]\n'
        b'for = ["gazebo"]\npasses = "fill-limits{effort=1}"\n[format]\nindent = 2\n[[files]]\nmatch = ["*.urdf"]\n'
        b'arguments = {a = 1}\n[pipelines]\nready = [{pass = "fill-limits"}]\n'
    )


def _settings() -> Iterator[str]:
    for kind in (ProjectSettings, FileSettings, FormatSettings):
        yield from (field.alias or name for name, field in kind.model_fields.items())
    yield from catalog()
    yield from registered_passes()


def _archives() -> Iterator[bytes]:
    names = ("a.urdf", "b/c.sdf", "l" * 200 + ".urdf")
    yield _tar("w", tarfile.PAX_FORMAT, ("../d.urdf", "/e.urdf"))
    for mode in get_args(_Mode):
        for format in (tarfile.GNU_FORMAT, tarfile.PAX_FORMAT):
            yield _tar(mode, format, names)
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as file:
        for name in names:
            file.writestr(name, targets.MODEL)
    yield made.getvalue()


def _tar(mode: _Mode, format: int, names: Iterable[str]) -> bytes:
    made = io.BytesIO()
    with tarfile.open(fileobj=made, mode=mode, format=format) as tar:
        for name in names:
            member = tarfile.TarInfo(name)
            member.size = len(targets.MODEL)
            tar.addfile(member, io.BytesIO(targets.MODEL))
        link = tarfile.TarInfo("link")
        link.type, link.linkname = tarfile.SYMTYPE, "/etc/passwd"
        tar.addfile(link)
    return made.getvalue()


def _json() -> Iterator[bytes]:
    yield b'{"twinform-baseline": 1, "findings": [{"file": "a", "rule": "b", "path": "/c", "message": "d"}]}'
    yield (
        b'{"twinform": "0.1", "python": "3.11", "source": "a", "fault": "exception", "error": "b", "traceback": "c", '
        b'"again": true, "pipeline": "check-inertia", "document": {"format": "urdf", "models": [{"name": "a"}]}}'
    )
    for text in _in(_CASES / "convert"):
        document = check(text).document
        if document is not None:
            yield json_text(document).encode()


def _fields() -> Iterator[str]:
    yield from _elements()
    yield from (f'"{name}":' for name in _elements())


def _addresses() -> Iterator[bytes]:
    yield from (
        b"model://crate/away/a.stl", b"package://arm/../arm/a.stl", b"file:///etc/passwd", b"a.stl", b"../away/a.stl",
        b"https://fuel.gazebosim.org/1.0/o/models/crate/1/files/away/a.stl", b"https://[::1]/1.0/o/worlds/%2e%2e",
        b"model://%63rate/%00",
    )  # fmt: skip


def _meshes() -> Iterator[bytes]:
    texts = {
        "dae": b"<COLLADA><image><init_from>a.png</init_from></image><!-- <image> --></COLLADA>",
        "obj": b"mtllib a.mtl b.mtl\nv 0 0 0\n",
        "mtl": b"map_Kd -s 1 1 -o 0 a.png\nbump -bm 1 b c.png\n",
        "gltf": b'{"buffers": [{"uri": "a%20b.bin"}], "images": [{"uri": "data:,"}]}',
        "glb": b'glTF\2\0\0\0\x34\0\0\0\x20\0\0\0JSON{"images": [{"uri": "a.png"}]}  ',
        "material": b'material a\n{\n  texture "a b.png"\n  texture c.png 2d\n}\n',
    }
    for place, kind in enumerate(targets.MESH_KINDS):
        yield bytes([place]) + texts[kind]


def _mesh_words() -> Iterator[str]:
    yield from (
        "init_from",
        "image",
        "<!--",
        "-->",
        "mtllib",
        "map_Kd",
        "-bm",
        "texture",
        "buffers",
        "uri",
        "JSON",
        "glTF",
    )


def _messages() -> Iterator[bytes]:
    folder = _ROOT / "tests" / "fuzz" / "found" / "editor_protocol"
    yield from (path.read_bytes() for path in sorted(folder.iterdir()))


def _nothing() -> Iterator[str]:
    return iter(())


TARGETS = {
    "load": Target(targets.load, _models, _elements),
    "parameters": Target(targets.parameters, _parameters, telling_keys),
    "pipeline": Target(targets.pipeline, _pipelines, _passes),
    "fixers": Target(targets.fixers, _models, _elements, 1536),
    "patterns": Target(targets.patterns, _patterns, _nothing, 512),
    "configurations": Target(targets.configurations, _configurations, _settings, 1024),
    "archives": Target(targets.archives, _archives, _nothing, 16384),
    "json": Target(targets.json, _json, _fields),
    "addresses": Target(targets.addresses, _addresses, _nothing, 512),
    "editor_protocol": Target(targets.editor_protocol, _messages, METHOD_TO_TYPES.keys),
    "meshes": Target(targets.meshes, _meshes, _mesh_words),
}
