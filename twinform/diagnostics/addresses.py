"""Where the project and its pages are to be found; the only place that says so."""

HOME = "https://github.com/twinform/twinform"
RULE_PAGES = f"{HOME}/blob/main/twinform/diagnostics/rules"


def rule_address(name: str) -> str:
    """The address of the page of a built-in rule."""
    return f"{RULE_PAGES}/{name}.md"
