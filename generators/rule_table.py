"""Makes the table of built-in rules from the heads of their files."""

from twinform.diagnostics.built_in_rule import read_head, rule_names
from twinform.diagnostics.diagnostic import GROUPS, Safety, Severity

_BEGINNING = '''\
"""The built-in rules. The page of each is in the file beside this one that has its name.

Made by `make generate` from the heads of these files; do not edit it.
"""

from twinform.diagnostics.built_in_rule import rule
from twinform.diagnostics.diagnostic import Safety, Severity

'''
_SEVERITIES = {str(each): f"Severity.{each.name}" for each in Severity}
_VALUES = {
    "severity": _SEVERITIES,
    "strict": _SEVERITIES,
    "fix": {str(each): f"Safety.{each.name}" for each in Safety},
    "fatal": {"true": "True"},
    "unsound": {"true": "True"},
    "group": {each: f'"{each}"' for each in GROUPS},
}
"""What a head may have, and what that is in Python."""


_USUAL = ("group", "structure")
_LONGEST = 121
"""Of a line, with its end."""


def rule_table() -> str:
    """The module with all built-in rules.

    Raises:
        ValueError: the file of a rule is not as it should be.
    """
    return _BEGINNING + "".join(rule_line(name, read_head(name)) for name in rule_names())


def rule_line(name: str, head: dict[str, str]) -> str:
    """The line of a rule.

    Raises:
        ValueError: its head lacks the severity, or has something else than fields of `Rule`.
    """
    for key, value in head.items():
        if value not in _VALUES.get(key, {}):
            raise ValueError(f"{name}.md has `{key}: {value}`; a head has {_VALUES}")
    if "severity" not in head:
        raise ValueError(f"{name}.md has no severity")
    keys = (key for key in _VALUES if key in head and key != "severity" and (key, head[key]) != _USUAL)
    options = "".join(f", {key}={_VALUES[key][head[key]]}" for key in keys)
    start, inside = f"{name.upper().replace('-', '_')} = rule(", f'"{name}", {_SEVERITIES[head["severity"]]}{options}'
    line = f"{start}{inside})\n"
    return line if len(line) <= _LONGEST else f"{start}\n    {inside}\n)\n"
