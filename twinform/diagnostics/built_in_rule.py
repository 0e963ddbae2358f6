"""Built-in rules: what a finding needs of them is in a generated table; their pages are read when somebody asks."""

from collections.abc import Mapping

from twinform.diagnostics.diagnostic import Rule, Safety, Severity


def rule(
    name: str,
    severity: Severity,
    *,
    strict: Severity | None = None,
    fix: Safety | None = None,
    fatal: bool = False,
    unsound: bool = False,
    group: str = "structure",
) -> Rule:
    """Make a rule whose page is a file of `rules/`."""
    made = _BuiltInRule.__new__(_BuiltInRule)
    levels = {"severity": severity, "strict": strict, "fix": fix}
    _fill(made, {"name": name, **levels, "fatal": fatal, "unsound": unsound, "group": group})
    return made


class _BuiltInRule(Rule):
    """A rule whose page is read when one of its texts is first asked for."""

    __slots__ = ()
    __module__ = "twinform.diagnostics.rules"  # where pickle looks for the constant

    def __getattr__(self, field: str) -> str:
        # Python calls this where a slot is unset
        from twinform.diagnostics.rule_files import read_page  # noqa: PLC0415 - most runs show no page

        page = read_page(self.name)
        if field not in page:
            raise AttributeError(f"a rule has no {field}")
        _fill(self, page)
        return page[field]

    def __reduce__(self) -> str:
        # findings travel between processes: pickle writes the name of the constant, which the other process has too
        return self.name.upper().replace("-", "_")


def _fill(rule: Rule, values: Mapping[str, object]) -> None:
    for field, value in values.items():
        object.__setattr__(rule, field, value)
