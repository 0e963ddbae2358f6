"""Remedies: the passes that make a model acceptable to its consumers, in the one order in which they run.

What a pass changed in the physics of a model is found value by value: masses, inertias, joints, collisions.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from twinform.diagnostics import Fate, LedgerEntry, PhysicsChange, ValueChange
from twinform.diagnostics.rules import CHANGED_PHYSICS
from twinform.ir import Document, Format, Joint, Link
from twinform.ir.changes import changes
from twinform.ir.scopes import scoped_models
from twinform.passes import Pass, parse_pipeline
from twinform.profiles.assessment import Assessment, Judgment


class Remedy(NamedTuple):
    """A pass that rows of profiles name; `physics` is whether it may change masses, joints, limits or collisions."""

    name: str
    physics: bool


# These passes only take away or turn around. What would need a guess (a sensor that Fortress does
# not know, a color of 200, a kinematic loop) stays a finding.
REMEDIES = (
    Remedy("drop-repeats", physics=False),
    Remedy("tidy-materials", physics=False),
    Remedy("tidy-shapes", physics=True),
    Remedy("tag-shapes", physics=False),
    Remedy("tidy-transmissions", physics=False),
    Remedy("replace-continuous", physics=False),
    Remedy("drop-bare-scripts", physics=False),
    Remedy("drop-flat-shapes", physics=True),
    # libsdformat swaps limits that are the wrong way round where it reads URDF, with a warning.
    Remedy("order-limits", physics=True),
    # Before `balance-inertia`, which then sees the shares of inertia that massless links were
    # given.
    Remedy("split-massless", physics=True),
    Remedy("balance-inertia", physics=True),
    Remedy("convert-meshes", physics=False),
    Remedy("add-root", physics=False),
)
"""Every pass that a row of a profile may name. Later ones see what earlier ones have made."""
_ORDER = {remedy.name: number for number, remedy in enumerate(REMEDIES)}
_PHYSICS = frozenset(remedy.name for remedy in REMEDIES if remedy.physics)


def remedies(assessments: Iterable[Assessment], to: Format | None = None) -> tuple[Pass, ...]:
    """The passes that help with the judgments, each once, in order, without those for another target format."""
    wanted = dict.fromkeys(text for each in assessments for text in _pipelines_for(each.judgments, to))
    return in_order(step for text in wanted for step in parse_pipeline(text))


def in_order(steps: Iterable[Pass]) -> tuple[Pass, ...]:
    """The passes in the order in which they run, each once."""
    return tuple(sorted(dict.fromkeys(steps), key=lambda step: _ORDER[step.name]))


def changes_physics(step: Pass) -> bool:
    """Whether a pass of a profile may change masses, inertias, joints, limits or collisions."""
    return step.name in _PHYSICS


def _pipelines_for(judgments: Iterable[Judgment], to: Format | None) -> Iterator[str]:
    for judgment in judgments:
        row = judgment.row
        if row.pipeline and (row.to is None or to is None or row.to is to):
            yield row.pipeline


Part = Link | Joint
_NO_PHYSICS = frozenset({"name", "visuals", "sensors", "lights", "opaque", "plugins"})
"""Fields of links and joints that physics engines do not use."""
# Another path of a mesh is no change of the physics: a pass for a consumer writes the same surface
# in another format. Nor is another name of a shape.
_NO_VALUES = ("/shape/uri", "]/name")
_Key = tuple[str, str]


def physics_changes(before: Document, after: Document, step: str) -> Iterator[LedgerEntry]:
    """A ledger entry for each link and joint whose physics the pass named `step` changed."""
    # Documents are compared, instead of asking passes what they did: a pass of another package is
    # covered too, and a report can apply the list to the source and ask Drake. The user's own
    # passes are not listed: they were asked for.
    if before is after:
        return
    old, new = dict(_links_and_joints(before)), dict(_links_and_joints(after))
    for key in {**old, **new}:
        values = tuple(_changed_values(old.get(key), new.get(key)))
        if values:
            change, place = PhysicsChange(step, *key, values), (old.get(key) or new[key]).location
            written = sum(bool(each.path) and each.was is not None for each in values)
            yield LedgerEntry(
                Fate.APPROXIMATED, CHANGED_PHYSICS, f"{step}: {describe_change(change)}", place, written, change
            )


def _links_and_joints(document: Document) -> Iterator[tuple[_Key, Part]]:
    """Every link and joint, by its kind and its scoped name."""
    models = [("", model) for model in document.models]
    models += [(f"{world.name}::{model.name}::", model) for world in document.worlds for model in world.models]
    for outside, outer in models:
        for scope, model in scoped_models(outer, outside):
            yield from ((("link", scope + link.name), link) for link in model.links)
            yield from ((("joint", scope + joint.name), joint) for joint in model.joints)


def _changed_values(old: Part | None, new: Part | None) -> Iterator[ValueChange]:
    if old is None or new is None:
        yield ValueChange("", None if old is None else "there", None if new is None else "there")
        return
    for each in changes(old, new):
        path = each.path.removeprefix("/")
        field = path.partition("/")[0].partition("[")[0]
        if not (each.is_node or field in _NO_PHYSICS or path.endswith(_NO_VALUES)):
            yield ValueChange(path, each.old, each.new)


def describe_change(change: PhysicsChange) -> str:
    """A text such as `link 'b': inertial/mass/value was 0, is 0.001`."""
    return f"{change.part} {change.name!r}: {'; '.join(_describe_value(each) for each in change.values)}"


def _describe_value(value: ValueChange) -> str:
    if not value.path:
        return "is gone" if value.now is None else "is new"
    was = "was not written" if value.was is None else f"was {value.was}"
    now = "is not written any more" if value.now is None else f"is {value.now}"
    return f"{value.path} {was}, {now}"


def of_ledger(entries: Iterable[LedgerEntry]) -> tuple[PhysicsChange, ...]:
    """The changes of the physics in a ledger."""
    return tuple(each.change for each in entries if each.change)
