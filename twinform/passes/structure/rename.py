"""Give links, joints and frames other names."""

from functools import cached_property
from typing import ClassVar, Literal, NamedTuple

from pydantic import Field, field_validator

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Model, World
from twinform.passes.structure.model_edit import EditContext, ModelEdit
from twinform.passes.structure.rename_parts import (
    Part,
    part_names,
    rename_in_world,
    rename_model,
    report_clashes,
    scope_of,
)

PartName = Literal["link", "joint", "frame", "model"]


class _NameRule(NamedTuple):
    """`head*tail` becomes `new_head*new_tail` with the same text for the star; without a star it is a whole name."""

    head: str
    tail: str | None
    new_head: str
    new_tail: str

    def apply(self, name: str) -> str | None:
        if self.tail is None:
            return self.new_head if name == self.head else None
        if len(name) < len(self.head) + len(self.tail):
            return None
        if not (name.startswith(self.head) and name.endswith(self.tail)):
            return None
        return self.new_head + name[len(self.head) : len(name) - len(self.tail)] + self.new_tail


def _split_rule(text: str) -> tuple[str, str]:
    """The old and the new name of a rule; the new one is empty where the text has none."""
    old, _, new = text.partition("=" if "=" in text else ":")
    return old, new


class Rename(ModelEdit):
    """Give links, joints, frames and nested models other names, one by one or by a pattern.

    Each of `names` is `OLD:NEW`, or `"OLD=NEW"` where a name has a colon in it. A `*` in both stands for any
    characters: `left_*:l_*`. The first that fits counts.

    Changes: 1. the names, also in nested models; 2. all that names them: joints, mimics, poses, frames, axes,
    `<gazebo>`, transmissions, ros2_control, parameters of plugins, other tools' elements, carriers.
    Never touches: the name of the model, `world`, names of sensors, shapes, materials, plugins and topics.
    Diagnostics: `unknown-name` for a name that nothing has; `name-clash`; `unfollowed-name` for a text that may or may
    not mean a part that was renamed.
    """

    name: ClassVar[str] = "rename"
    example: ClassVar[str] = "rename{names=[base_link:base,left_*:l_*]}"

    names: tuple[str, ...] = Field(min_length=1, description="`OLD:NEW`, with one `*` in both or in none.")
    kinds: tuple[PartName, ...] = Field(
        default=("link", "joint", "frame", "model"), description="What is renamed: link, joint, frame, model."
    )

    @field_validator("names")
    @classmethod
    def _check_names(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        for text in names:
            old, new = _split_rule(text)
            if not old or not new:
                raise ValueError(f"{text!r} is not OLD:NEW")
            if old.count("*") != new.count("*") or old.count("*") > 1:
                raise ValueError(f"{text!r} has a * on one side only, or several")
        return names

    @cached_property
    def _rules(self) -> tuple[_NameRule, ...]:
        made: list[_NameRule] = []
        for text in self.names:
            old, new = _split_rule(text)
            head, star, tail = old.partition("*")
            new_head, _, new_tail = new.partition("*")
            made.append(_NameRule(head, tail if star else None, new_head, new_tail))
        return tuple(made)

    def edit(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with the new names."""
        known = [name for part, name in part_names(document) if part in self.kinds]
        for text, rule in zip(self.names, self._rules, strict=True):
            if not any(rule.apply(name) is not None for name in known):
                message = f"nothing is called {_split_rule(text)[0]!r}"
                sink.report(rules.UNKNOWN_NAME, message, document.location, found=text)
        return document if sink.has_errors else super().edit(document, sink)

    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model with the new names."""
        scope = scope_of(model, self.new_name)
        if not scope.changes or report_clashes(model, scope, place.format, place.sink):
            return model
        return rename_model(model, scope, place.format, place.sink)

    def update_world(self, before: World, after: World) -> World:
        """The world, whose joints and frames follow the new names."""
        return rename_in_world(before, after, lambda model: scope_of(model, self.new_name), self.model)

    def new_name(self, part: Part, name: str) -> str:
        """Return the name that a part has afterwards."""
        if part not in self.kinds:
            return name
        return next((new for rule in self._rules if (new := rule.apply(name)) is not None), name)
