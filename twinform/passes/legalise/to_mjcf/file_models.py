"""How the file of MJCF that is written will be read: as a model or a world, and which trees of bodies are which model.

A reader makes a model of each tree of bodies, and a static one of the shapes of the world itself. What a document has
otherwise is for its carriers to say.
"""

from functools import cached_property

from twinform.ir import Model, World
from twinform.ir.frames import WORLD
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import WORLDBODY
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext, is_made_name, safe_name
from twinform.passes.shared.nodes import reserve_name

_MOVING = frozenset({"joint", "freejoint"})
UNNAMED_MODEL = "model"
"""The name of a model in a file that has none."""


def is_named_by_file(context: MjcfContext) -> bool:
    """Whether the name of what is written was made when it was read, and is made again.

    The static model of the world's own shapes is called so only while these belong to no body.
    """
    holder = context.holder
    is_scenery = isinstance(holder, Model) and holder.name == WORLDBODY
    return is_made_name(holder) and (not is_scenery or WORLD in context.written_bodies.values())


class FileModels:
    """The models of one file, each by the prefix of the names of its links. The section `worldbody` is complete.

    Attributes:
        ground: the link whose shapes are those of the world itself, if there is one.
    """

    def __init__(self, context: MjcfContext) -> None:
        self._context = context
        worldbody = context.sections.get("worldbody", ())
        self._bodies = {each.get("name") or "": each for each in worldbody if each.name == "body"}
        self._has_ground = any(each.name == "geom" for each in worldbody)
        links = {written: link for link, written in context.written_bodies.items()}
        self._scopes = {name: self._scope_of(links[name]) for name in self._bodies}
        self.ground = links.get(WORLD)

    def _scope_of(self, link: str) -> str:
        """The prefix of the outermost model that a link is in; none for what is in no world."""
        return link.partition(SCOPE)[0] + SCOPE if isinstance(self._context.holder, World) else ""

    @property
    def is_world(self) -> bool:
        """Whether the file is read as a world."""
        return len(self._bodies) != 1 or self._has_ground

    def trees(self, scope: str) -> list[str]:
        """The bodies at the top that are in a model."""
        return [name for name, each in self._scopes.items() if each == scope]

    def is_written(self, scope: str) -> bool:
        """Whether the file has anything that is read as a model."""
        return bool(self.trees(scope)) or (self._has_ground and self._ground_scope == scope)

    def has_part(self, name: str) -> bool:
        """Whether a link or joint, by its scoped name, is of a model that the file has anything of."""
        return isinstance(self._context.holder, Model) or self.is_written(self._scope_of(name))

    @property
    def _ground_scope(self) -> str | None:
        return None if self.ground is None else self._scope_of(self.ground)

    def is_still(self, scope: str) -> bool:
        """Whether nothing in the trees of a model moves."""
        trees = (self._bodies[name] for name in self.trees(scope))
        return all(each.name not in _MOVING for tree in trees for each in tree.walk())

    @cached_property
    def are_said(self) -> bool:
        """Whether each model of a world is read with all that is in it, and with its name."""
        taken, numbers = ({WORLDBODY} if self._has_ground else set[str]()), dict[str, int]()
        scopes = [*self._scopes.values()]
        return len(set(scopes)) == len(scopes) and all(
            reserve_name(safe_name(self._name(name) or UNNAMED_MODEL), taken, numbers) + SCOPE == scope
            for name, scope in self._scopes.items()
        )

    def _name(self, body: str) -> str | None:
        """The name that the tree of a body is called by in the file."""
        if len(self._bodies) == 1:
            return None if is_named_by_file(self._context) else self._context.holder.name
        return None if ("body", body) in self._context.unnamed else body

    def keep_names(self, scope: str) -> list[str]:
        """The bodies at the top that are in a model, which keep their names in the file."""
        trees = self.trees(scope)
        self._context.unnamed.difference_update(("body", name) for name in trees)
        return trees
