"""Making names of links and joints unique, as they share one scope in SDF."""

from collections.abc import Collection
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Format, Joint, Link, Model, map_references
from twinform.passes.carriers.carriers import Keeper
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import with_old_name
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.structure.rename_parts import follow_references, scope_of

Named = TypeVar("Named", Link, Joint, Model)
_NO_NAME = "robot"
"""The name of a robot without one, since SDF requires a name."""


class UniqueNames(ModelPass):
    """Give joints names that no link has, and links names that SDF does not keep for itself.

    Changes: 1. a joint with a link's name becomes `NAME_joint` (with a number if that is taken too), and mimics and
    poses follow; 2. a link called `world`, or with two underscores at both ends, becomes `NAME_link`, and joints and
    poses follow; 3. names lose the blanks around them, which libsdformat drops where it reads them; 4. a robot without
    a name is called `robot`.
    References follow, also those in frames, sensors and plugins of `<gazebo>`, as in the pass `rename`.
    Never touches: a floating joint, which SDF does not have; a text that may be something else than a reference.
    Diagnostics: `renamed`, and `unfollowed-name` for such a text. The old name is carried.
    """

    name: ClassVar[str] = "unique-names"
    carriers: bool = True
    silent: bool = False
    """For a target that gives the old names back: nothing is reported."""

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with one name for each thing."""
        if not model.name.strip():
            model = self._rename(model, _NO_NAME, sink)
        names = {link.name for link in model.links}
        taken = names | {joint.name for joint in model.joints}
        links = {name: reserve_name(_legal_name(name, "link"), taken) for name in sorted(names) if _is_reserved(name)}
        kept = (joint.name for joint in model.joints if joint.type != "floating")  # SDF has no joint there
        clashes = [name for name in kept if name in names or _is_reserved(name)]
        joints = {name: reserve_name(_legal_name(name, "joint", names), taken) for name in clashes}
        if not links and not joints:
            return model
        new: dict[str, dict[str, str]] = {"link": links, "joint": joints}
        # typed references mean links and joints here, also one called `world`, which means something else in SDF
        followed = map_references(model, lambda kind, name: new.get(kind, {}).get(name, name), Format.URDF)
        scope = scope_of(model, lambda part, name: new.get(part, {}).get(name, name), deep=False)
        followed = follow_references(followed, scope, Format.URDF, sink)
        update = {
            "links": tuple(self._rename_if_new(link, links, sink) for link in followed.links),
            "joints": tuple(self._rename_if_new(joint, joints, sink) for joint in followed.joints),
        }
        return followed.copy(**update)

    def _rename_if_new(self, node: Named, names: dict[str, str], sink: DiagnosticSink) -> Named:
        return self._rename(node, names[node.name], sink) if node.name in names else node

    def _rename(self, node: Named, name: str, sink: DiagnosticSink) -> Named:
        if not self.silent:
            kind = type(node).__name__.lower()
            message = f"{kind} {node.name!r} is called {name!r} in SDF"
            sink.report(rules.RENAMED, message, node.location, found=node.name)
            Keeper(sink, self.carriers).account(rules.RENAMED, message, node.location.at("@name"))
        if self.carriers:
            node = with_old_name(node, name)
        return node.copy(name=name)


def _is_reserved(name: str) -> bool:
    return name == "world" or (name.startswith("__") and name.endswith("__")) or name != name.strip()


def _legal_name(name: str, kind: str, links: Collection[str] = ()) -> str:
    """The name to take instead of one that is reserved or that a link has."""
    bare = name.strip()
    # libsdformat drops blanks around names where it reads them, so a link "a " would lose the
    # joints that name it.
    return f"{bare.strip('_')}_{kind}" if bare == name or bare in links or _is_reserved(bare) else bare
