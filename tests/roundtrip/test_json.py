"""Documents as JSON: the published schema, judged by the jsonschema package, takes all that is loaded."""

import copy
import json
from collections.abc import Iterator
from random import Random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from tests.json_judge import complaints
from tests.profile import examples
from tests.schema_documents import document as xml_document
from twinform.compiler import CompileError
from twinform.compiler.output.json import is_array, is_object, json_data
from twinform.ir import Document
from twinform.schemas import table
from twinform.testing import strategies

_VALUES: tuple[Any, ...] = (
    None, True, False, 0, 1, -1, 1.5, 1e300, 10**400, "", "a", "Infinity", "inf", "1", " ", "a\x00", "\ud800", [], {},
    [0, 0], [0, 0, 0], [0, 0, 0, 1], ["a", "b"], {"name": "a"}, {"kind": "box"}, [{"name": "a"}],
)  # fmt: skip
_ASIDE = frozenset({"$schema", "namespaces", "order", "spelling"})
_NAMES = ("name", "links", "joints", "models", "pose", "kind", "opaque", "order", "spelling", "$schema", "text", "odd")


def _containers(data: Any) -> Iterator[dict[str, Any] | list[Any]]:
    if is_object(data) or is_array(data):
        yield data
        for inner in data.values() if is_object(data) else data:
            yield from _containers(inner)


def _changed(data: dict[str, Any], random: Random) -> dict[str, Any]:
    """The same with one field or item lost, added, moved or of another value."""
    made = copy.deepcopy(data)
    every = list(_containers(made))
    holder = random.choice(every)
    if isinstance(holder, list):
        match random.randrange(3):
            case 0 if holder:
                holder.pop(random.randrange(len(holder)))
            case 1 if holder:
                holder[random.randrange(len(holder))] = random.choice(_VALUES)
            case _:
                holder.append(copy.deepcopy(random.choice([*_VALUES, *every])) if random.random() < 0.5 else 7)
        return made
    match random.randrange(4):
        case 0 if holder:
            del holder[random.choice(sorted(holder))]
        case 1 if holder:
            holder[random.choice(sorted(holder))] = copy.deepcopy(random.choice(_VALUES))
        case 2 if holder:
            name = random.choice(sorted(holder))
            holder[random.choice(_NAMES)] = holder.pop(name)
        case _:
            holder[random.choice(_NAMES)] = copy.deepcopy(random.choice(_VALUES))
    return made


@examples()
@given(st.one_of(strategies.robots(), strategies.sdf_models(), strategies.worlds()))
def test_the_schema_takes_what_is_written_and_it_is_loaded_as_it_was(document: Document) -> None:
    data = json_data(document)
    assert complaints(data) == []
    assert twinform.loads(json.dumps(data)) == document


@examples()
@given(st.one_of(strategies.robots(), strategies.worlds()), st.randoms(use_true_random=False))
def test_what_the_schema_takes_is_loaded_as_it_is_or_is_an_error(document: Document, random: Random) -> None:
    data = _changed(json_data(document), random)
    if complaints(data):
        with pytest.raises(CompileError):
            twinform.loads(json.dumps(data))
        return
    try:
        found = json_data(twinform.loads(json.dumps(data)))
    except CompileError:
        return
    assert _content(found) == _content(data)


@examples()
@given(st.sampled_from([(name, version) for name in ("urdf", "sdf") for version in table(name).versions]), st.randoms())
def test_every_accepted_document_has_its_json(version: tuple[str, str], random: Random) -> None:
    text = xml_document(random, *version)
    to = "urdf" if version[0] == "urdf" else "sdf"
    try:
        same = twinform.convert(text, to=to)
    except CompileError:
        return
    made = twinform.convert(text, to="json").text
    assert complaints(json.loads(made)) == []
    assert twinform.convert(made.encode(), to=to).text == same.text


def _content(data: Any) -> Any:
    """The content of a document, without what has no weight: its order, its spellings, and empty fields."""
    if is_array(data):
        return [_content(each) for each in data]
    if not is_object(data):
        return data
    inner = {name: _content(value) for name, value in data.items() if name not in _ASIDE}
    return {name: value for name, value in inner.items() if value not in ({}, [], None)}
