"""Where the project and its pages are to be found; the only place that says so."""

HOME = "https://github.com/twinform/twinform"
RULES = f"{HOME}/blob/main/docs/reference/rules.md"
"""The pages of the rules; the name of a rule is the anchor."""
