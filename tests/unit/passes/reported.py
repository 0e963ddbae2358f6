"""What a conversion reports, with all that a finding or an entry of the ledger has."""

import twinform


def findings(made: twinform.Conversion) -> list[tuple[str, int, str, str, str | None]]:
    """Rule, line, path, message and what was found."""
    return [
        (each.rule.name, each.location.line, each.location.path, each.message, each.found) for each in made.diagnostics
    ]


def entries(made: twinform.Conversion) -> list[tuple[str, int, str, str, int]]:
    """Rule, line, path, message and weight."""
    return [
        (each.rule.name, each.location.line, each.location.path, each.message, each.weight)
        for each in made.ledger.entries
    ]
