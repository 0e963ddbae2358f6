"""The page of a rule: its sections, as `explain`, reports and the site show them."""

from collections.abc import Iterator

from twinform.diagnostics.diagnostic import Rule, Safety

FIXES = {
    Safety.SAFE: "`twinform check --fix` fixes what has one meaning only; what is a guess needs `--unsafe-fixes` too.",
    Safety.UNSAFE: "`twinform check --fix --unsafe-fixes` fixes it where it can; another robot may come of it.",
    Safety.DISPLAY: "Editors propose one; something in it has to be filled in.",
}
"""What the page of a rule says of its fixes, by how safe they are at best."""


def severity_words(rule: Rule) -> str:
    """How bad it is, and how bad under `--strict` where that differs."""
    if rule.fatal:
        return f"{rule.severity}, which `check` alone may allow"
    if rule.strict in {None, rule.severity}:
        return str(rule.severity)
    return f"{rule.severity}, {rule.strict} under --strict"


def sections(rule: Rule) -> Iterator[tuple[str, str]]:
    """The page of a rule: headings and what stands below them."""
    yield "What it finds", rule.finds
    yield "Why it matters", rule.matters
    yield "Example", rule.example
    yield "Better", rule.better
    if rule.fix is not None:
        yield "Fix", FIXES[rule.fix]
    yield "References", rule.references or "None."


def rule_page(rule: Rule) -> str:
    """A rule in Markdown, as the site shows it."""
    body = "\n".join(f"## {heading}\n\n{text}\n" for heading, text in sections(rule))
    return f"# {rule.name}\n\nSeverity: {severity_words(rule)}. Group: {rule.group}.\n\n{body}"
