"""The pages that are made from the passes say what the passes say now."""

from pathlib import Path

import pytest

from twinform.passes.framework.passes_page import passes_page
from twinform.passes.legalise.pipeline_page import pipeline_page

_DOCS = Path(__file__).parents[4] / "docs"


@pytest.mark.parametrize(
    ("text", "page"), [(pipeline_page, "explanation/pipeline.md"), (passes_page, "reference/passes.md")]
)
def test_the_committed_page_is_what_is_made(text: object, page: str) -> None:
    assert callable(text)
    assert text() == (_DOCS / page).read_text(encoding="utf-8")
