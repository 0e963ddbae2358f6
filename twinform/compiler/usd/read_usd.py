"""Reads a USD file: its layers, the stage that they compose, and the robots in it.

USD would look up on its own what a layer names. Here every layer is read by the rules for files, and is given to a
confined process, which says what else it needs. Only when all is there, that process composes the stage.
"""

import math
import posixpath
from collections.abc import Iterator, Mapping
from dataclasses import field
from pathlib import Path
from typing import Any, NamedTuple, cast

from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.input.loading import bytes_of
from twinform.compiler.input.parsing import UnreadableError
from twinform.compiler.resolve_uris import UriError
from twinform.compiler.usd.build_document import build_document
from twinform.compiler.usd.stage import Stage, stage_of
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, Rule, rules
from twinform.ir import Document
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult

_MOST_LAYERS = 1_000
_KINDS: Mapping[bytes, str] = {b"PXR-USDC": "usdc", b"PK\3\4": "usdz"}
_FINITE = (
    "physics:mass",
    "physics:diagonalInertia",
    "physics:principalAxes",
    "physics:local",
    "size",
    "radius",
    "height",
)
"""How the names of values begin that have no meaning where they are infinite."""


def read_usd(
    source: Path | bytes,
    load_options: LoadOptions,
    *,
    name: str,
    model: str | None,
    known: frozenset[str] | None = None,
) -> LoadResult:
    """Read the robot of a stage that is called `model`, or else the one with the most links.

    `known` are names that those of prims may stand for; without them, each transform is a frame.
    """
    sink = DiagnosticSink(file=name, strict=load_options.strict)
    try:
        stage = _Layers(load_options, sink).stage(source)
        document = _choose(build_document(stage, known, apart=model is not None), model, sink)
    except UnreadableError:
        text = source if isinstance(source, bytes) else None
        return LoadResult(name, None, tuple(sink.diagnostics), unreadable=True, content=text)
    return LoadResult(name, document, tuple(sink.diagnostics))


def _choose(document: Document, model: str | None, sink: DiagnosticSink) -> Document:
    if not document.models:
        sink.report(rules.NO_LINKS, "the stage has no rigid body (PhysicsRigidBodyAPI), so there is no robot in it")
        raise UnreadableError
    named = [each for each in document.models if each.name == model]
    return document.copy(models=tuple(named[:1] or document.models[:1]))


class _Place(NamedTuple):
    """Where a layer is: in a file, or as a member of a package."""

    file: Path | None
    member: str = ""

    def __str__(self) -> str:
        return f"{self.file}[{self.member}]" if self.member else str(self.file or "")


@dataclass(slots=True)
class _Layers:
    """The layers of one stage; `links` are triples: a layer, an asset that it names, and the layer that this is."""

    load_options: LoadOptions
    sink: DiagnosticSink
    texts: list[bytes] = field(default_factory=list[bytes])
    originals: list[bytes] = field(default_factory=list[bytes])
    links: list[int | str] = field(default_factory=list[int | str])
    numbers: dict[_Place, int] = field(default_factory=dict["_Place", int])
    waiting: list[tuple[_Place, list[str]]] = field(default_factory=list[tuple["_Place", list[str]]])
    packages: dict[Path | None, Mapping[str, bytes]] = field(default_factory=dict["Path | None", Mapping[str, bytes]])
    left: int = 0

    def stage(self, source: Path | bytes) -> Stage:
        """Read the stage of a file, or of the bytes of one.

        Raises:
            UnreadableError: the stage is broken, or names a file that is nowhere or must not be read.
        """
        self.left = self.load_options.limits.size
        path = None if isinstance(source, bytes) else source
        self._add(_Place(path), source if isinstance(source, bytes) else bytes_of(source, self.sink, self.load_options))
        for number, (place, assets) in enumerate(self.waiting):
            for asset in assets:
                found = self._find(place, asset, number)
                if found is not None:
                    self.links += (number, asset, found)
        if self.sink.has_errors:
            raise UnreadableError
        first, *others = self.texts
        companions = {str(number): text for number, text in enumerate(others, 1)}
        found = self._ask(MeshJob("stage", {"links": self.links}, "usda", first, companions), _Place(path))
        stage = stage_of(found.facts, self.sink.file)
        self._check(stage, found.facts)
        return stage

    def _add(self, place: _Place, content: bytes) -> int:
        """Read a layer, and return its number."""
        self.left -= len(content)
        if self.left < 0 or len(self.texts) >= _MOST_LAYERS:
            limits = self.load_options.limits
            message = f"the layers of the stage have more than {limits.size:,} bytes, or are more than {_MOST_LAYERS:,}"
            self._refuse(rules.OVERSIZED_FILE, message, place)
        if not content.strip():
            self._refuse(rules.UNREADABLE_FILE, "the file is empty", place)
        kind = next((kind for mark, kind in _KINDS.items() if content.startswith(mark)), "usda")
        found = self._ask(MeshJob("layer", {}, kind, content), place)
        if kind == "usdz":
            return self._unpack(place, found.files)
        number = self.numbers[place] = len(self.texts)
        self.texts.append(found.files["text"])
        self.originals.append(content)
        self.waiting.append((place, list(map(str, _items(found.facts["assets"])))))
        return number

    def _unpack(self, place: _Place, members: Mapping[str, bytes]) -> int:
        if place.member or not members:
            self._refuse(rules.UNREADABLE_FILE, "the package is in another one, or empty", place)
        self.packages[place.file] = members
        name = next(iter(members))  # the root of the stage, by the format
        number = self._add(place._replace(member=name), members[name])
        self.numbers[place] = number
        return number

    def _find(self, place: _Place, asset: str, number: int) -> int | None:
        """Return the number of the layer that another one names; None, with a finding, for what cannot be read."""
        try:
            there, content = self._content(place, asset)
        except UriError as error:
            rule, why, hint = error.rule, str(error), error.help
        except (OSError, ValueError) as error:
            rule, hint = rules.UNREADABLE_FILE, None
            why = str((isinstance(error, OSError) and error.strerror) or error)
        else:
            return self.numbers[there] if there in self.numbers else self._add(there, content)
        where = Location(str(place) or self.sink.file, _line_of(self.originals[number], asset))
        self.sink.report(rule, f"the layer names {asset!r}: {why}", where, help=hint)
        return None

    def _content(self, place: _Place, asset: str) -> tuple[_Place, bytes]:
        """Find the layer that another one names, and read it.

        Raises:
            UriError: it is nowhere, or must not be read.
            OSError: it cannot be read.
            ValueError: no file has such a name.
        """
        file, _, inner = asset.partition("[")
        if place.member:  # a package holds all that is in it
            name = posixpath.normpath(posixpath.join(posixpath.dirname(place.member), file))
            if name not in self.packages[place.file]:
                raise UriError(rules.UNRESOLVED_URI, f"{name!r} is not in the package")
            return place._replace(member=name), self.packages[place.file][name]
        if place.file is None:
            raise UriError(rules.UNRESOLVED_URI, "nothing is looked up for a text that came from no file")
        search = self.load_options.search
        found = search.find(file, place.file)
        there = _Place(Path(search.readable(place.file).require(found)))
        if there in self.numbers:
            return there, b""
        if inner:
            raise UriError(rules.UNRESOLVED_URI, f"one layer of a package is named; name {file!r}")
        return there, search.readable(place.file).read(found, self.load_options.limits.size)

    def _ask(self, job: MeshJob, place: _Place) -> MeshResult:
        found = _process().do(job)
        if found.trouble == "missing":
            from twinform.installation import install_command  # noqa: PLC0415 - most have what they need

            message = "USD is read with usd-core, which is not installed"
            self._refuse(rules.USD_READER_MISSING, message, place, f"run: {install_command('usd')}")
        if found.trouble:
            self._refuse(rules.UNREADABLE_FILE, f"cannot read it as USD: {found.message}", place)
        return found

    def _refuse(self, rule: Rule, message: str, place: _Place, help: str | None = None) -> None:
        self.sink.report(rule, message, Location(str(place) or self.sink.file), help=help)
        raise UnreadableError

    def _check(self, stage: Stage, facts: Mapping[str, object]) -> None:
        for error in _items(facts["errors"]):
            self.sink.report(rules.UNREADABLE_FILE, f"the stage cannot be composed: {error}")
        for prim in stage.prims.values():
            where = prim.source.location if prim.source else Location()
            for name in _not_finite(prim.values):
                self.sink.report(
                    rules.INVALID_VALUE, f"{name} is no finite number", where, found=str(prim.values[name])
                )
            if not all(map(math.isfinite, (*prim.place.translation, *prim.place.rotation, *prim.scale))):
                self.sink.report(rules.INVALID_VALUE, "the transform is not finite", where)
            for name, targets in prim.targets.items():
                lost = [each for each in targets if name.startswith("physics:body") and each not in stage.prims]
                for target in lost:
                    self.sink.report(rules.DANGLING_LINK, f"{name} names {target}, which is not there", where)
        if self.sink.has_errors:
            raise UnreadableError


def _process() -> Any:
    from twinform.passes.mesh_jobs.child_process import usd  # noqa: PLC0415 - few files are USD

    return usd()


def _items(value: object) -> list[Any]:
    return cast("list[Any]", value) if isinstance(value, list) else []


def _line_of(text: bytes, asset: str) -> int:
    """Return the line of the text in which an asset is named; 0 where it is written in another way."""
    at = text.find(f"@{asset}@".encode())
    return text.count(b"\n", 0, at) + 1 if at >= 0 else 0


def _not_finite(values: Mapping[str, object]) -> Iterator[str]:
    for name, value in values.items():
        numbers = [each for each in _items(value) or [value] if isinstance(each, float)]
        if any(map(math.isnan, numbers)) or (name.startswith(_FINITE) and any(map(math.isinf, numbers))):
            yield name
