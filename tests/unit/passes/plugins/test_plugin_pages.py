from pathlib import Path

from twinform.passes.plugins.catalog import sensors, systems
from twinform.passes.plugins.plugins_page import plugins_page

PAGE = Path(__file__).parents[4] / "docs/reference/plugins.md"


def test_the_page_is_what_the_catalog_makes() -> None:
    assert PAGE.read_text(encoding="utf-8") == plugins_page()


def test_everything_in_the_catalog_is_on_the_page() -> None:
    page = plugins_page()
    assert all(f"\n## system {name}\n" in page for name in systems())
    assert all(f"\n| `{type_}`" in page for type_ in sensors())
