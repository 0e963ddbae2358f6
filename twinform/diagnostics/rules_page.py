"""The list of the rules: `python -m twinform.diagnostics.rules_page FILE [--check]` writes or checks it."""

import sys
from collections.abc import Iterator

from twinform.diagnostics.catalog import catalog
from twinform.diagnostics.diagnostic import GROUPS, Rule, Safety
from twinform.diagnostics.generated_files import main

_INTRODUCTION = """\
# Rules

Every kind of finding. The page of each has an example, what is better, and where the rule comes from;
`twinform explain RULE` prints it. The last column is the option of `twinform check` that fixes what was found, if there
is a fix. `--select`, `--ignore` and `--deny` take a rule or a group, such as `physics`.
"""
_TABLE = """
## {group}

| rule | severity | what it finds | fixed by |
| --- | --- | --- | --- |
"""

FIXES = {
    Safety.SAFE: "`twinform check --fix` fixes what has one meaning only; what is a guess needs `--unsafe-fixes` too.",
    Safety.UNSAFE: "`twinform check --fix --unsafe-fixes` fixes it where it can; another robot may come of it.",
    Safety.DISPLAY: "Editors propose one; something in it has to be filled in.",
}
"""What the page of a rule says of its fixes, by how safe they are at best."""
_OPTIONS = {Safety.SAFE: "`--fix`", Safety.UNSAFE: "`--unsafe-fixes`", Safety.DISPLAY: "editors"}


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


def rules_page() -> str:
    """The list of all rules in Markdown."""
    in_groups = {group: [each for each in catalog().values() if each.group == group] for group in GROUPS}
    tables = (_TABLE.format(group=group) + "".join(map(_row, found)) for group, found in in_groups.items())
    return _INTRODUCTION + "".join(tables)


def rule_page(rule: Rule) -> str:
    """A rule in Markdown, as the site shows it."""
    body = "\n".join(f"## {heading}\n\n{text}\n" for heading, text in sections(rule))
    return f"# {rule.name}\n\nSeverity: {severity_words(rule)}. Group: {rule.group}.\n\n{body}"


def _row(rule: Rule) -> str:
    link = f"[{rule.name}](../../twinform/diagnostics/rules/{rule.name}.md)"
    finds = rule.finds.replace("|", "\\|").replace("\n", " ")
    return f"| {link} | {severity_words(rule)} | {finds} | {_OPTIONS[rule.fix] if rule.fix else ''} |\n"


if __name__ == "__main__":
    sys.exit(main(rules_page(), sys.argv[1:]))
