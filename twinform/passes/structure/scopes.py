"""Name scopes of models, for renaming by SDF lookup rules."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Document, Format, Model, ReferenceKind
from twinform.ir.frames import MODEL, WORLD
from twinform.ir.scopes import nested_models, outer_models

Part = str
"""`link`, `joint`, `frame` or `model`."""
Choose = Callable[[Part, str], str]
"""The new name of a part of this kind by its old one."""
PARTS: tuple[tuple[Part, str], ...] = (
    ("link", "links"), ("joint", "joints"), ("frame", "frames"), ("model", "models"), ("model", "includes"),
)  # fmt: skip
"""The fields of a model with what has a name in its scope."""
RESERVED = frozenset({WORLD, MODEL, "__root__"})
"""Names of SDF that nothing can be called by."""


@dataclass(frozen=True, slots=True)
class RenamedScope:
    """The names in a model: `own` has the new ones by kind, `inner` the scopes of nested models by their old names."""

    name: str
    own: Mapping[Part, Mapping[str, str]]
    inner: Mapping[str, "RenamedScope"] = field(default_factory=dict[str, "RenamedScope"])

    @property
    def changes(self) -> bool:
        """Whether any name is another one."""
        own = any(old != new for names in self.own.values() for old, new in names.items())
        return own or any(scope.changes for scope in self.inner.values())

    def find(self, kind: ReferenceKind, name: str) -> str | None:
        """The new name of what a name stands for in this model, which may be in a nested one; None for nothing here."""
        first, separator, rest = name.partition("::")
        whole = self._find_own(kind, name)  # before 1.8, or once it is flattened, a name may have colons in it
        if whole is not None or not separator:
            return whole
        if first in self.inner:
            inside = rest if rest == MODEL else self.inner[first].find(kind, rest)
            return None if inside is None else f"{self.own['model'].get(first, first)}::{inside}"
        if first in self.own["model"]:  # an include, of which only the file knows what is in it
            return f"{self.own['model'][first]}::{rest}"
        if first == self.name:  # Gazebo calls things by the model's name too
            inside = self.find(kind, rest)
            return None if inside is None else f"{first}::{inside}"
        return self._find_own("frame", name.removesuffix(f"::{MODEL}"))  # which stands for a model that was flattened

    def follow(self, kind: ReferenceKind, name: str) -> str:
        """The new name for an old one; what names nothing of this model stays as it is."""
        found = None if name in RESERVED or kind == "material" else self.find(kind, name)
        return name if found is None else found

    def _find_own(self, kind: ReferenceKind, name: str) -> str | None:
        return next((self.own[part][name] for part in LOOKUP_ORDER[kind] if name in self.own[part]), None)


LOOKUP_ORDER: dict[ReferenceKind, tuple[Part, ...]] = {
    "link": ("link", "frame", "model", "joint"),
    "joint": ("joint", "frame", "link", "model"),
    "frame": ("link", "frame", "joint", "model"),
    "any": ("link", "frame", "joint", "model"),
}
"""Which parts a name may mean, the likeliest first."""


def scope_of(model: Model, choose: Choose, *, deep: bool = True) -> RenamedScope:
    """The scope of a model whose parts get new names; those in nested models only with `deep`."""
    own: dict[Part, dict[str, str]] = {part: {} for part, _ in PARTS}
    for part, field_name in PARTS:
        for node in getattr(model, field_name):
            if node.name and node.name not in RESERVED:
                own[part].setdefault(node.name, choose(part, node.name))
    inner = {nested.name: scope_of(nested, choose if deep else _same, deep=deep) for nested in model.models}
    return RenamedScope(model.name, own, inner)


def _same(_: Part, name: str) -> str:
    return name


def report_clashes(model: Model, scope: RenamedScope, format_: Format, sink: DiagnosticSink) -> bool:
    """Report parts that would share a name, in the model and the models in it; whether there are any."""
    seen: dict[tuple[str, str], tuple[str, Location]] = {}
    clash = False
    for part, field_name in PARTS:
        kind = part if format_ is Format.URDF else ""  # SDF has one scope for all, URDF one for each kind
        for node in getattr(model, field_name):
            new = scope.own[part].get(node.name or "")
            if new is None:
                continue
            other = seen.setdefault((kind, new), (node.name, node.location))
            if other[1] != node.location or other[0] != node.name:
                message = f"{part} {node.name!r} and {other[0]!r} would both be called {new!r}"
                sink.report(rules.NAME_CLASH, message, node.location, found=new, related=(other[1],))
                clash = True
            elif format_ is Format.SDF and new != node.name and (new in RESERVED or "::" in new):
                message = f"{part} {node.name!r} cannot be called {new!r} in SDF"
                sink.report(rules.NAME_CLASH, message, node.location, found=new)
                clash = True
    inner = [report_clashes(nested, scope.inner[nested.name], format_, sink) for nested in model.models]
    return clash or any(inner)


def every_name(document: Document) -> set[tuple[Part, str]]:
    """The names of all parts of all models of a document."""
    models = (model for outer in outer_models(document) for model in nested_models(outer))
    return {(part, node.name) for model in models for part, name in PARTS for node in getattr(model, name) if node.name}
