"""Static models in a model: SDF holds all that is in them where it is."""

from collections.abc import Iterator

from twinform.ir import Joint, Model
from twinform.ir.frames import WORLD
from twinform.ir.kinematic_tree import KinematicTree
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import annotate_synthesized
from twinform.passes.transforms.nodes import unique_name


def with_static_models_fixed(model: Model) -> Model:
    """The model with a joint to the world for each root in a static model in it, before its own joints.

    A model that is static itself stays as it is: so is all that is in it (`SdfEntityCreator.cc`, `CreateEntities`).

    Raises:
        FrameError: an end of a joint is not known, or frames go round in a circle.
    """
    # gz-sim hands <static> down: links of models in a static model are held whatever these say
    # themselves (SdfEntityCreator.cc, CreateEntities: `_model->Static() || _staticParent`). Drake
    # holds those of the nested model and leaves models in it free.
    roots = [] if model.static else [*_static_roots(model, "")]
    if not roots:
        return model
    taken = {node.name for node in (*model.links, *model.joints, *model.frames, *model.models)}
    welds: list[Joint] = []
    for root, nested in roots:
        name = unique_name(f"{root.replace(SCOPE, '__')}_fixed_joint", taken)
        taken.add(name)
        weld = Joint(name=name, type="fixed", parent=WORLD, child=root, source=nested.source)
        welds.append(annotate_synthesized(weld))
    # Joints between the links stay, as in a model that is static as a whole: URDF is a tree, and
    # they place the links.
    return model.copy(joints=(*welds, *model.joints))


def _static_roots(model: Model, scope: str) -> Iterator[tuple[str, Model]]:
    """The links of static models in a model that no joint in these holds, by their scoped names."""
    for nested in model.models:
        inside = f"{scope}{nested.name}{SCOPE}"
        if not nested.static:
            yield from _static_roots(nested, inside)
            continue
        tree = KinematicTree(nested)
        yield from ((inside + name, nested) for name in tree.links if tree.joint_above(name) is None)
