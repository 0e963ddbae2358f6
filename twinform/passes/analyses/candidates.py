"""The models of a file that may become the robot."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from twinform.ir import Document, Include, Model, World
from twinform.ir.scopes import nested_includes


@dataclass(frozen=True, slots=True)
class ModelCandidate:
    """A model of the root or of a world, or an include that stands for one."""

    model: Model | Include
    world: World | None = None

    @property
    def full_name(self) -> str:
        """Its name with its world's; an include without a name is called by its URI."""
        name = self.model.name or self.model.uri if isinstance(self.model, Include) else self.model.name
        return f"{self.world.name}::{name}" if self.world else name or ""

    def answers_to(self, name: str | None) -> bool:
        """Whether it may be meant by a name; no name may mean any."""
        return name is None or name in (self.model.name, self.full_name)


def candidates(document: Document) -> Iterator[ModelCandidate]:
    """All of them, those of the root first."""
    for one in (*document.models, *document.includes):
        yield ModelCandidate(one)
    for world in document.worlds:
        for one in (*world.models, *world.includes):
            yield ModelCandidate(one, world)


def name_once_expanded(before: Document | None, after: Document | None, name: str | None) -> str | None:
    """The name of a model that was chosen by the URI of its include, now that the include is expanded."""
    among = candidates(before) if before and after and name else ()
    nameless = [one.model for one in among if isinstance(one.model, Include) and one.answers_to(name)]
    if not after or len(nameless) != 1:
        return name
    place = nameless[0].source
    # What an include becomes keeps the include's place in the file, which no other model has.
    return next((one.full_name for one in candidates(after) if place and one.model.source is place), name)


def wanted_includes(document: Document | None, name: str | None) -> Callable[[Include], bool]:
    """Which includes have to be read to make URDF of the model of this name.

    Those in the model, or the one that stands for it; where nothing answers to the name, all that have no name before
    they are read. Without a name there must be one candidate only.
    """
    among = list(candidates(document)) if document else []
    found = [one for one in among if one.answers_to(name)]
    if name is None:
        # With several candidates the conversion asks for a name, and must not open files for models
        # that nobody chose.
        found = found if len(found) == 1 else []
    elif not found:
        found = [one for one in among if one.model.name is None]
    wanted = {id(include) for one in found for include in _includes_of(one.model)}
    return lambda include: id(include) in wanted


def _includes_of(model: Model | Include) -> Iterator[Include]:
    return iter((model,)) if isinstance(model, Include) else nested_includes(model)
