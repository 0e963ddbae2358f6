"""Dropping stale carriers and annotations of the other format."""

from dataclasses import field
from typing import ClassVar, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Document, Format, Inertial, Model, Node, Opaque, census_of, map_children
from twinform.passes.carriers.annotations import came_from, without_provenance
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX, SOURCE, bits_of_ours, has_ours, is_carrier, is_memory
from twinform.passes.carriers.token_mass import UNSAID, is_token
from twinform.passes.framework.pass_base import ModelPass

AnyNode = TypeVar("AnyNode", bound=Node)


_IN_URDF = frozenset(
    {
        "sdf", "offset", "pose", "frame", "axis", "axis2", "ends", "colors", "scripts", "mimic", "continuous", "geared",
        "chain", "part", "computed-mass", "nested", "mixed", "scoped-name", "reversed",
        "own-settings",
    }
)  # fmt: skip
"""What a URDF holds for the reverse conversion; none of it means anything in SDF."""
_IN_SDF = frozenset(
    {
        "urdf",
        "material",
        "shared-material",
        "unnamed",
        "floating",
        "link",
        "unsaid",
        "look",
        "extension",
        "shared",
        "drake",
        "of-world",
    }
)
"""What an SDF file holds for the reverse conversion."""
_OF_MEMORY = ("sdf", "urdf", SOURCE)
"""Elements of which early versions of twinform wrote some that only remembered the source."""

_IGNORED = "what an early version of twinform kept about the source file is ignored; the contents of this file are used"


class DropStale(ModelPass):
    """Drop the carriers and annotations of the other format that fit nothing in the model any more.

    Changes: 1. a carrier whose part was deleted, renamed or contradicted by an edit goes; 2. so does all that early
    versions of twinform kept of the source. The rest of the file stays.
    Never touches: what the reverse conversion of the result will read.
    Diagnostics: `stale-carrier` for each, and one for all that is remembered.
    """

    name: ClassVar[str] = "drop-stale"
    to: Format

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document without stale carriers, and without the prefix of ours where there are none at all."""
        document = super().run(document, sink)
        if (PREFIX, NAMESPACE) not in document.namespaces or any(map(has_ours, document.models)):
            return document
        others = tuple(pair for pair in document.namespaces if pair != (PREFIX, NAMESPACE))
        return document.copy(namespaces=others)

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without stale carriers."""
        if self.to is Format.URDF and came_from(model, self.to):  # for SDF the last pass needs it
            model = without_provenance(model)
        kinds = _IN_URDF if self.to is Format.SDF else _IN_SDF
        having = bits_of_ours(*kinds, *_OF_MEMORY)
        dropping = _Dropping(frozenset(f"{{{NAMESPACE}}}{kind}" for kind in kinds), having)
        model = dropping.without(model)
        dropping.report(sink)
        return model


@dataclass(frozen=True, slots=True)
class _Dropping:
    """One run over one model, `having` what may be stale; `dropped` is what was, and in what."""

    kinds: frozenset[str]
    having: int
    dropped: list[tuple[Opaque, Node]] = field(default_factory=list[tuple[Opaque, Node]])

    def without(self, node: AnyNode) -> AnyNode:
        """The node without stale carriers, on it and in it."""
        if not census_of(node) & self.having:
            return node
        parts = node.opaque
        kept = tuple([part for part in parts if not self._is_stale(part, node)]) if parts else parts
        if len(kept) != len(parts):
            self.dropped.extend((part, node) for part in parts if self._is_stale(part, node))
            node = node.copy(opaque=kept)
        return map_children(node, self.without)

    def _is_stale(self, part: Opaque, node: Node) -> bool:
        if is_carrier(part, UNSAID) and isinstance(node, Inertial) and is_token(node):
            return False  # of a body of MJCF without mass: a link of URDF may have the token too
        return (part.element is not None and part.element.name in self.kinds) or is_memory(part)

    def report(self, sink: DiagnosticSink) -> None:
        """A warning for each, or one for all that an older version wrote, at `<tf:source>` if there is one.

        The ledger has each of them.
        """
        memory = [pair for pair in self.dropped if is_memory(pair[0])]
        first = next((pair for pair in memory if is_carrier(pair[0], SOURCE)), memory[0]) if memory else None
        for part, node in self.dropped:
            message, where = _IGNORED if memory else _message(part, node), part.location_in(node)
            sink.account(Fate.DROPPED, STALE_CARRIER, message, where, part.weight)
            if first is None or part is first[0]:
                sink.report(STALE_CARRIER, message, where, found=part.name)


def _message(part: Opaque, node: Node) -> str:
    kind = part.element.name.partition("}")[2] if part.element else ""
    name = getattr(node, "name", None)
    holder = f"{type(node).__name__.lower()} {name!r}" if name else f"a {type(node).__name__.lower()}"
    children = part.element.children if part.element else ()
    held = ", ".join(f"<{child.name.replace(f'{{{NAMESPACE}}}', 'tf:')}>" for child in children)
    return f"<tf:{kind}> in {holder}{f' holds {held} and' if held else ''} no longer matches the file, so it is dropped"
