"""Makes the list of the rules from their pages."""

from twinform.diagnostics.catalog import catalog
from twinform.diagnostics.diagnostic import GROUPS, Rule, Safety
from twinform.diagnostics.rule_page import severity_words

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
_OPTIONS = {Safety.SAFE: "`--fix`", Safety.UNSAFE: "`--unsafe-fixes`", Safety.DISPLAY: "editors"}


def rules_page() -> str:
    """The list of all rules in Markdown."""
    in_groups = {group: [each for each in catalog().values() if each.group == group] for group in GROUPS}
    tables = (_TABLE.format(group=group) + "".join(map(_row, found)) for group, found in in_groups.items())
    return _INTRODUCTION + "".join(tables)


def _row(rule: Rule) -> str:
    link = f"[{rule.name}](../../twinform/diagnostics/rules/{rule.name}.md)"
    finds = rule.finds.replace("|", "\\|").replace("\n", " ")
    return f"| {link} | {severity_words(rule)} | {finds} | {_OPTIONS[rule.fix] if rule.fix else ''} |\n"
