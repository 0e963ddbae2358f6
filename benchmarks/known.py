"""What is known of the corpus, and why it is right as it is: `corpus_known.toml`."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

_FILE = Path(__file__).with_name("corpus_known.toml")


@dataclass(frozen=True, slots=True)
class Known:
    """Reasons by file or by rule."""

    refused: dict[str, str]
    not_converted: dict[str, str]
    not_converted_rules: dict[str, str]

    def why_refused(self, name: str) -> str:
        """Why it is right to refuse a file that another reader accepts; empty where nobody has looked at it."""
        return self.refused.get(name, "")

    def why_not_converted(self, name: str, rules: tuple[str, ...]) -> str:
        """Why it is right not to convert a file; empty where it, and one of the rules, is not explained."""
        if name in self.not_converted:
            return self.not_converted[name]
        reasons = [self.not_converted_rules.get(rule, "") for rule in rules]
        return "; ".join(reasons) if all(reasons) else ""


@cache
def known() -> Known:
    """The tables of the file."""
    tables: dict[str, dict[str, str]] = tomllib.loads(_FILE.read_text(encoding="utf-8"))
    return Known(tables["refused"], tables["not_converted"], tables["not_converted_rules"])
