"""The models of a file, of which one becomes the robot of a URDF."""

from collections.abc import Callable, Iterator

from twinform.dataclass import dataclass
from twinform.ir import Document, Include, Model, World
from twinform.ir.scopes import nested_includes
from twinform.passes.carriers.annotations import MADE_NAME, WORLDBODY, find_annotation


@dataclass(frozen=True, slots=True)
class ModelCandidate:
    """A model at the root or in a world, or an include of one."""

    model: Model | Include
    world: World | None = None

    @property
    def full_name(self) -> str:
        """The name, with that of the world before it; an include without a name goes by its URI."""
        name = self.model.name or self.model.uri if isinstance(self.model, Include) else self.model.name
        return f"{self.world.name}::{name}" if self.world else name or ""

    def answers_to(self, name: str | None) -> bool:
        """Whether a name means this model; None means any."""
        return name is None or name in (self.model.name, self.full_name)


def candidates(document: Document) -> Iterator[ModelCandidate]:
    """All candidates of a document, those at the root first.

    The floor and the walls of an MJCF file are none, where there is anything else: they are no robot, and have no name.
    """
    found = [*_all_candidates(document)]
    return iter([one for one in found if not _is_scenery(one.model)] or found)


def _is_scenery(model: Model | Include) -> bool:
    """Whether a model has the shapes of MJCF that belong to no body: it is static, and its name was made."""
    if not isinstance(model, Model) or not model.static or model.name != WORLDBODY:
        return False
    return find_annotation(model, MADE_NAME) is not None


def _all_candidates(document: Document) -> Iterator[ModelCandidate]:
    for one in (*document.models, *document.includes):
        yield ModelCandidate(one)
    for world in document.worlds:
        for one in (*world.models, *world.includes):
            yield ModelCandidate(one, world)


def name_once_expanded(before: Document | None, after: Document | None, name: str | None) -> str | None:
    """The name, in the expanded document, of a model that was chosen by the URI of its include."""
    among = candidates(before) if before and after and name else ()
    nameless = [one.model for one in among if isinstance(one.model, Include) and one.answers_to(name)]
    if not after or len(nameless) != 1:
        return name
    place = nameless[0].source
    # An expanded include keeps its place in the file, which no other model has.
    return next((one.full_name for one in candidates(after) if place and one.model.source is place), name)


def wanted_includes(document: Document | None, name: str | None) -> Callable[[Include], bool]:
    """Whether an include has to be read to convert the model of a name to URDF.

    It has to if it is in that model, or is that model; where no candidate has the name, all includes without a name
    are read. Without a name, nothing is read unless there is only one candidate.
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
