"""What holds for normal forms, tried on models that Hypothesis makes up: nothing that is written gets lost in one."""

from copy import deepcopy

from hypothesis import assume, given
from hypothesis import strategies as st
from lxml import etree

import twinform
from tests.edits.strategies import mutations
from tests.mutations import Mutation
from tests.profile import examples
from twinform.compiler.normal_form import Discrepancy, NormalForm
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.schemas import XmlElement
from twinform.testing import strategies

_SETTINGS = examples(0.5)
_MODELS = strategies.robots(max_links=6) | strategies.sdf_models(max_links=6)
_IN_NO_ORDER = frozenset({"plugin"})
_NEW = "x1y"
"""What no attribute and no text has, and no default is."""


def _tree(document: Document) -> XmlElement:
    return etree.fromstring(emit(document, DiagnosticSink()).encode(), etree.XMLParser(remove_blank_text=True))


def _compared(source: XmlElement, back: XmlElement) -> tuple[Discrepancy, ...]:
    return NormalForm.of(source).compare(NormalForm.of(back))


@_SETTINGS
@given(_MODELS)
def test_the_order_of_unlike_siblings_does_not_count(model: Document) -> None:
    tree = _tree(model)
    sorted_ = deepcopy(tree)
    for element in sorted_.iter():
        if element.tag not in _IN_NO_ORDER:
            element[:] = sorted(element, key=lambda child: str(child.tag))
    assert _compared(tree, sorted_) == ()
    assert _compared(sorted_, tree) == ()


@_SETTINGS
@given(_MODELS, st.data())
def test_any_other_value_is_found(model: Document, data: st.DataObject) -> None:
    tree = _tree(model)
    edited = deepcopy(tree)
    values = [(element, name) for element in edited.iter() for name in element.keys()]  # noqa: SIM118 - lxml iterates children
    texts = [(element, None) for element in edited.iter() if element.text]
    element, name = data.draw(st.sampled_from([one for one in (*values, *texts) if one[1] != "version"]))
    if name is None:
        element.text = _NEW
    else:
        element.set(name, _NEW)
    assert _compared(tree, edited) != ()
    assert _compared(edited, tree) != ()


@_SETTINGS
@given(_MODELS, st.data())
def test_what_may_be_left_out_of_a_normal_form_changes_no_robot(model: Document, data: st.DataObject) -> None:
    tree = _tree(model)
    edited = deepcopy(tree)
    element = data.draw(st.sampled_from([one for one in edited.iter() if one.getparent() is not None]))
    parent = element.getparent()
    assert parent is not None
    parent.remove(element)
    if _compared(tree, edited) == ():
        assert twinform.diff(etree.tostring(tree), etree.tostring(edited)).same


@_SETTINGS
@given(
    st.tuples(strategies.robots(max_links=6), mutations(format="urdf"))
    | st.tuples(strategies.sdf_models(max_links=6), mutations(format="sdf"))
)
def test_another_robot_has_another_normal_form(drawn: tuple[Document, Mutation]) -> None:
    model, mutation = drawn
    mutant = mutation(model)
    assume(mutant is not None)
    assert mutant is not None
    assert _compared(_tree(model), _tree(mutant)) != ()
