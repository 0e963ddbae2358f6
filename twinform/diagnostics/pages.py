"""The pages of the rules: `python -m twinform.diagnostics.pages FILE [--check]` writes or checks them."""

import sys
from collections.abc import Iterator

from twinform.diagnostics.catalog import catalog
from twinform.diagnostics.generated_files import main
from twinform.diagnostics.rule import Rule

_INTRODUCTION = """\
# Rules

Every kind of finding, sorted by name. `twinform explain RULE` prints one page.
This file is made by `python -m twinform.diagnostics.pages docs/reference/rules.md`; do not edit it.
"""


def severity_words(rule: Rule) -> str:
    """How bad it is, and how bad under `--strict` where that differs."""
    if rule.fatal:
        return f"{rule.severity}, which cannot be allowed"
    if rule.strict in {None, rule.severity}:
        return str(rule.severity)
    return f"{rule.severity}, {rule.strict} under --strict"


def sections(rule: Rule) -> Iterator[tuple[str, str]]:
    """The page of a rule: headings and what stands below them."""
    yield "What it finds", rule.finds
    yield "Why it matters", rule.matters
    yield "Example", rule.example
    yield "Better", rule.better
    yield "References", rule.references or "None."


def rules_page() -> str:
    """All rules in Markdown."""
    return "\n".join([_INTRODUCTION, *(_chapter(rule) for rule in catalog().values())])


def _chapter(rule: Rule) -> str:
    body = "\n".join(f"**{heading}.** {text}\n" for heading, text in sections(rule))
    return f"## {rule.name}\n\nSeverity: {severity_words(rule)}.\n\n{body}"


if __name__ == "__main__":
    sys.exit(main(rules_page(), sys.argv[1:]))
