"""The jsonschema package as a judge of documents as JSON: it knows the published schema and nothing of the compiler."""

import json
from functools import cache
from typing import Any

from jsonschema import Draft202012Validator

from twinform.compiler.output.json import json_schema_text


@cache
def _judge() -> Draft202012Validator:
    schema = json.loads(json_schema_text())
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def complaints(data: Any) -> list[str]:
    """What is not valid in a document."""
    found = _judge().iter_errors(data)  # pyright: ignore[reportUnknownMemberType] - types of another package's validator
    return [str(error.message) for error in found]
