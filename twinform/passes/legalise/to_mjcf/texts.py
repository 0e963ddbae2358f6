"""Carriers in MJCF: what it cannot say, as `<custom><text name="twinform:..." data="..."/></custom>`."""

from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext


def add_texts(context: MjcfContext) -> None:
    """Add a text to the `custom` section for each part that MJCF leaves unsaid. All other sections are complete."""
    del context
