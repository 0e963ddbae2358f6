"""What a project says about how its files are checked; who starts the server reads it from the configuration."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.size_limits import Limits
from twinform.diagnostics import Policy
from twinform.text.formatting import FormatOptions

LARGEST = 4 * 2**20
"""The largest text, in bytes, that is followed while somebody types: twice the largest real file."""
MOST_TAGS = 100_000
"""The most tags of one: more than twice those of the largest real file."""
USUAL_LIMITS = Limits(LARGEST, MOST_TAGS)


@dataclass(frozen=True, slots=True)
class EditorSettings:
    """How files are read and laid out, and which findings are shown. `problem` is what is wrong with its file."""

    load_options: LoadOptions = field(default_factory=lambda: LoadOptions(limits=USUAL_LIMITS, tolerant=True))
    policy: Policy = field(default_factory=Policy)
    layout: FormatOptions = field(default_factory=FormatOptions)
    problem: str = ""


SettingsOf = Callable[[Path], EditorSettings]
"""The settings for a file."""


def no_settings(_: Path) -> EditorSettings:
    """Return the settings of a project that has none."""
    return EditorSettings()
