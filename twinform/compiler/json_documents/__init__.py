"""Documents as JSON: the same parts under the names of their fields. `docs/reference/json.md` describes the format."""

from twinform.compiler.json_documents.comparing import compare_documents
from twinform.compiler.json_documents.reading import JsonSource, read_json
from twinform.compiler.json_documents.writing import json_data, json_text

__all__ = ["JsonSource", "compare_documents", "json_data", "json_text", "read_json"]
