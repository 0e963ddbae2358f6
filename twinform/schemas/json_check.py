"""Checks JSON documents against their published schema, with readable messages: the part of JSON Schema it uses."""

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from difflib import get_close_matches
from functools import cache
from typing import Any, NamedTuple, TypeGuard

from twinform.schemas.packaged import json_schema_text

Schema = Mapping[str, Any]
Json = dict[str, Any]
JsonPath = tuple[str | int, ...]
# A check of our own goes by the published schema, so what is published is what decides; the
# jsonschema package, in the tests, judges that the two agree.
_DEEPEST = 800
"""How deep objects and arrays may be in each other; an element in an element is two levels, and XML may have 256."""


def is_object(value: object) -> TypeGuard[Json]:
    """Whether it is an object of JSON."""
    return isinstance(value, dict)


def is_array(value: object) -> TypeGuard[list[Any]]:
    """Whether it is an array of JSON."""
    return isinstance(value, list)


class Fault(NamedTuple):
    """What the schema does not take, and where."""

    path: JsonPath
    message: str
    found: str | None = None
    expected: str | None = None
    help: str | None = None


def json_faults(data: object) -> Iterator[Fault]:
    """Everything in a document that the schema does not take."""
    schema = _schema()
    yield from _Check(schema["$defs"]).faults(data, schema, ())


@cache
def _schema() -> Schema:
    return json.loads(json_schema_text())


class _Task(NamedTuple):
    """A value that its schema is still to be asked about."""

    value: Any
    schema: Schema
    path: JsonPath


class _Check:
    """One check; each keyword of the schema has its function. Nothing here calls itself for what is deeper inside."""

    def __init__(self, definitions: Mapping[str, Schema]) -> None:
        self.definitions = definitions

    def faults(self, value: Any, schema: Schema, path: JsonPath) -> Iterator[Fault]:
        """What of a value its schema does not take, from the outside in."""
        tasks = [_Task(value, schema, path)]
        while tasks:
            found = list(self._look(tasks.pop()))
            yield from (each for each in found if isinstance(each, Fault))
            tasks += [each for each in reversed(found) if isinstance(each, _Task)]

    def _look(self, task: _Task) -> "Iterator[Fault | _Task]":
        """The faults of a value alone, and what in it is still to be checked; nothing where its type is wrong."""
        value, schema, path = task
        if len(path) > _DEEPEST:
            yield Fault(path, f"is deeper than {_DEEPEST} levels")
            return
        kind = schema.get("type")
        if kind is not None and not _IS[kind](value):
            yield Fault(path, f"is {_shown(value)}; expected {_CALLED[kind]}", _shown(value), _CALLED[kind])
            return
        for keyword, function in _KEYWORDS.items():
            if keyword in schema:
                yield from function(self, task)

    def reference(self, task: _Task) -> Iterator[_Task]:
        yield task._replace(schema=self._resolved(task.schema))

    def constants(self, task: _Task) -> Iterator[Fault]:
        value, schema, path = task
        words = schema.get("enum", [schema.get("const")])
        if not isinstance(value, str) or value not in words:
            expected = f"one of {', '.join(words)}" if len(words) > 1 else repr(words[0])
            hint = _did_you_mean(value, words) if isinstance(value, str) else None
            yield Fault(path, f"is {_shown(value)}; expected {expected}", _shown(value), expected, hint)

    def pattern(self, task: _Task) -> Iterator[Fault]:
        if not re.search(task.schema["pattern"], task.value):
            yield Fault(task.path, f"is {_shown(task.value)}, which XML cannot hold here", _shown(task.value))

    def bounds(self, task: _Task) -> Iterator[Fault]:
        if not task.schema["minimum"] <= task.value <= task.schema.get("maximum", task.value):
            yield Fault(task.path, f"is {_shown(task.value)}, which is out of range", _shown(task.value))

    def fields(self, task: _Task) -> "Iterator[Fault | _Task]":
        value, schema, path = task
        known: Mapping[str, Schema] = schema["properties"]
        for name, inner in value.items():
            if name in known:
                yield _Task(inner, known[name], (*path, name))
                continue
            yield Fault((*path, name), "is no field of this object", name, None, _did_you_mean(name, known))
        for name in schema.get("required", ()):
            if name not in value:
                yield Fault(path, f"has no {name!r}", None, name)

    def items(self, task: _Task) -> Iterator[_Task]:
        value, schema, path = task
        places: list[Schema] = schema.get("prefixItems") or [schema["items"]] * len(value)
        for index, (inner, its) in enumerate(zip(value, places, strict=False)):
            yield _Task(inner, its, (*path, index))

    def counts(self, task: _Task) -> Iterator[Fault]:
        value, schema, path = task
        least, most = schema["minItems"], schema.get("maxItems")
        if len(value) < least or (most is not None and len(value) > most):
            expected = f"{least} or more" if most is None else str(least) if least == most else f"{least} to {most}"
            yield Fault(path, f"has {len(value)} items; expected {expected}", str(len(value)), expected)

    def any_of(self, task: _Task) -> Iterator[Fault]:
        tries = [list(self.faults(task.value, each, task.path)) for each in task.schema["anyOf"]]
        if all(tries):
            yield tries[0][0]

    def one_of(self, task: _Task) -> "Iterator[Fault | _Task]":
        """Branches are objects, distinguished by a field with one value, or by which field is there."""
        value, schema, path = task
        branches = [self._resolved(each) for each in schema["oneOf"]]
        if not is_object(value):
            yield Fault(path, f"is {_shown(value)}; expected {_CALLED['object']}", _shown(value), _CALLED["object"])
            return
        tag = next(iter(_constants(branches[0])), None)
        if tag is None:
            yield from self._by_field(task, branches)
        elif tag not in value:
            yield Fault(path, f"has no {tag!r}", None, tag)
        else:
            # The branch is chosen by its tag before it is checked, so the findings are about the
            # shape that was meant, and not about each of nine that were not.
            known = {_constants(each)[tag]: each for each in branches}
            word = value[tag]
            if isinstance(word, str) and word in known:
                yield task._replace(schema=known[word])
            else:
                yield from self.constants(_Task(word, {"enum": list(known)}, (*path, tag)))

    def _by_field(self, task: _Task, branches: list[Schema]) -> Iterator[Fault | _Task]:
        names = [str(each["required"][0]) for each in branches]
        there = [each for each, name in zip(branches, names, strict=True) if name in task.value]
        if len(there) == 1:
            yield task._replace(schema=there[0])
        else:
            needed = " or ".join(names)
            yield Fault(task.path, f"has {len(there)} of {needed}; expected one", None, needed)

    def _resolved(self, schema: Schema) -> Schema:
        return self.definitions[schema["$ref"].removeprefix("#/$defs/")] if "$ref" in schema else schema


def _constants(schema: Schema) -> dict[str, str]:
    """The fields that have one value, which tell an object from others; that of the schema's own version does not."""
    return {
        name: each["const"]
        for name, each in schema["properties"].items()
        if "const" in each and name in schema["required"]
    }


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


_IS: Mapping[str, Callable[[object], bool]] = {
    "object": is_object,
    "array": is_array,
    "string": lambda value: isinstance(value, str),
    "boolean": lambda value: isinstance(value, bool),
    "number": _is_number,
    "integer": lambda value: isinstance(value, int | float) and _is_number(value) and value == value // 1,
}
_CALLED = {
    "object": "an object",
    "array": "an array",
    "string": "text",
    "boolean": "true or false",
    "number": "a number",
    "integer": "a whole number",
}
_KEYWORDS: Mapping[str, Callable[[_Check, _Task], Iterator[Fault | _Task]]] = {
    "$ref": _Check.reference,
    "enum": _Check.constants,
    "const": _Check.constants,
    "pattern": _Check.pattern,
    "minimum": _Check.bounds,
    "properties": _Check.fields,
    "items": _Check.items,
    "prefixItems": _Check.items,
    "minItems": _Check.counts,
    "anyOf": _Check.any_of,
    "oneOf": _Check.one_of,
}


def _did_you_mean(word: str, known: Iterable[str]) -> str | None:
    close = get_close_matches(word, list(known), n=1)
    return f"did you mean {close[0]!r}?" if close else None


def _shown(value: object) -> str:
    """A value as JSON has it, shortened."""
    if is_object(value) or is_array(value):
        return "an object" if is_object(value) else "an array"
    text = json.dumps(value)
    return text if len(text) <= 60 else text[:57] + "..."
