"""Texts of files in Markdown that editors show, where they are nothing but texts: no links, pictures or commands."""

import re

_TICKS = re.compile("`+")


def code(text: str) -> str:
    """A text as code within a line."""
    line = " ".join(text.split())
    ticks = "`" * (_longest_run(line) + 1)
    # a blank keeps ticks at the ends apart, and is not shown
    return f"{ticks} {line} {ticks}" if "`" in line else f"{ticks}{line}{ticks}"


def code_block(text: str, language: str) -> str:
    """A text as a block of code in a language."""
    fence = "`" * max(3, _longest_run(text) + 1)
    return f"{fence}{language}\n{text}\n{fence}"


def _longest_run(text: str) -> int:
    return max((len(run) for run in _TICKS.findall(text)), default=0)
