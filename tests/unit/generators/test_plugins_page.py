from generators.plugins_page import plugins_page
from twinform.passes.plugins.catalog import sensors, systems


def test_everything_in_the_catalog_is_on_the_page() -> None:
    page = plugins_page()
    assert all(f"\n## system {name}\n" in page for name in systems())
    assert all(f"\n| `{type_}`" in page for type_ in sensors())
