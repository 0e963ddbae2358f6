"""JSON input: from JSON to the text of the format that the document is in. See `docs/reference/json.md`."""

from twinform.compiler.input.json.comparing import compare_documents
from twinform.compiler.input.json.json_to_text import JsonSource, read_json

__all__ = ["JsonSource", "compare_documents", "read_json"]
