"""Links that have to collide with their own model: every pair that touches has one, and none is needless."""

from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

import twinform
from twinform.compiler.input.mjcf.links_that_touch import LinkBits, links_that_touch
from twinform.ir import Model
from twinform.ir.kinematic_tree import KinematicTree
from twinform.passes.legalise.to_mjcf.contact_plan import Bits, ContactPlan

_COLLISION = '<collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry></collision>'


def _model(parents: list[int | None], fixed: list[bool]) -> Model:
    """A model whose links hang from earlier ones by hinges or fixed joints, from the world (-1), or from nothing."""
    parts = "".join(f'<link name="l{number}">{_COLLISION}</link>' for number in range(len(parents)))
    for number, parent in enumerate(parents):
        if parent is not None:
            above = "world" if parent < 0 else f"l{parent % max(number, 1)}"
            kind = "fixed" if fixed[number] else "revolute"
            axis = "" if fixed[number] else "<axis><xyz>0 0 1</xyz></axis>"
            ends = f"<parent>{above}</parent><child>l{number}</child>"
            parts += f'<joint name="j{number}" type="{kind}">{ends}{axis}</joint>' if above != f"l{number}" else ""
    text = f'<sdf version="1.11"><model name="m">{parts}</model></sdf>'
    return twinform.loads(text).models[0]


_SOME_BITS = st.sampled_from([Bits(1, 1), Bits(0, 0), Bits(2, 1), Bits(1, 2), None])


@given(st.data())
def test_every_pair_that_touches_has_a_link_that_collides(data: st.DataObject) -> None:
    count = data.draw(st.integers(2, 7))
    parents = data.draw(st.lists(st.none() | st.integers(-1, 6), min_size=count, max_size=count))
    fixed = data.draw(st.lists(st.booleans(), min_size=count, max_size=count))
    names = [f"l{number}" for number in range(count)]
    bits: dict[str, LinkBits] = {name: data.draw(st.frozensets(_SOME_BITS, min_size=1, max_size=2)) for name in names}
    excluded = data.draw(st.sets(st.sampled_from([frozenset(pair) for pair in combinations(names, 2)])))
    model = _model(parents, fixed)
    plan = ContactPlan(model, KinematicTree(model), frozenset(), is_of_mjcf=False)

    found = set(links_that_touch(plan, bits, excluded))

    kept_apart = excluded | set(map(frozenset, plan.joints()))
    touching = {
        frozenset(pair)
        for pair in combinations(names, 2)
        if not plan.is_filtered(*pair)
        and frozenset(pair) not in kept_apart
        and any(a.meets(b) for a in bits[pair[0]] if a for b in bits[pair[1]] if b)
    }
    assert all(pair & found for pair in touching)
    needless = {link for link in found if all(pair & (found - {link}) for pair in touching)}
    assert not needless
