"""What is reported of a change is all of it: something wherever documents differ, nothing where they do not."""

from hypothesis import given

from tests.profile import examples
from twinform.ir import Document, Model
from twinform.ir.changes import ChangeKind, changes, count_changes
from twinform.testing import strategies

_SETTINGS = examples()
_DOCUMENTS = strategies.robots() | strategies.sdf_models()


def _changed(document: Document, **update: object) -> Document:
    model: Model = document.models[0].copy(**update)
    return document.copy(models=(model,))


@_SETTINGS
@given(_DOCUMENTS, _DOCUMENTS)
def test_there_are_changes_where_documents_differ_and_only_there(old: Document, new: Document) -> None:
    assert (not list(changes(old, new))) is (old == new)
    assert not list(changes(old, Document.model_validate_json(old.model_dump_json(exclude_defaults=True))))


@_SETTINGS
@given(_DOCUMENTS, _DOCUMENTS)
def test_the_way_back_has_the_opposite_changes(old: Document, new: Document) -> None:
    there, back = count_changes(old, new), count_changes(new, old)
    assert (there.added, there.removed) == (back.removed, back.added)


@_SETTINGS
@given(_DOCUMENTS)
def test_links_in_another_order_are_one_change(document: Document) -> None:
    links = document.models[0].links
    found = list(changes(document, _changed(document, links=links[::-1])))
    assert [each.how for each in found] == ([ChangeKind.REORDERED] if len(links) > 1 else [])


@_SETTINGS
@given(_DOCUMENTS)
def test_a_link_that_goes_is_what_goes(document: Document) -> None:
    first, *rest = document.models[0].links
    found = list(changes(document, _changed(document, links=tuple(rest))))
    assert {each.how for each in found} == {ChangeKind.REMOVED}
    assert all(each.path.startswith(f"/models[{document.models[0].name!r}]/links[{first.name!r}]") for each in found)
