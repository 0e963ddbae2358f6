"""The fixers by rule: ours, and those that other packages bring through the entry-point group `twinform.fixes`.

The name of an entry point is that of the rule; what it names is a function that makes a `Fix` of a `Site`.
"""

from functools import cache
from importlib import import_module
from typing import cast

from twinform.compiler.fixing.site import Fixer, Fixers, TextFixer, TextFixers
from twinform.diagnostics import catalog

GROUP = "twinform.fixes"
SUBJECTS = (
    "fix_joints",
    "fix_limits",
    "materials",
    "fix_names",
    "numbers",
    "plugins",
    "structure",
)
"""The modules of `subjects`; each has a table `FIXERS`."""
TEXT_SUBJECTS = ("file_paths", "xml_syntax")
"""Those whose table `TEXT_FIXERS` has fixers of text."""


class FixRegistryError(Exception):
    """What a package registers as a fixer is none; the message names the package to correct."""


@cache
def fixers() -> Fixers:
    """Our own fixers."""
    found: dict[str, Fixer] = {}
    for subject in SUBJECTS:
        own = cast("Fixers", import_module(f"twinform.compiler.fixing.subjects.{subject}").FIXERS)
        found |= own
    return found


@cache
def text_fixers() -> TextFixers:
    """Return the fixers that work on the text of a file, by the names of their rules."""
    found: dict[str, TextFixer] = {}
    for subject in TEXT_SUBJECTS:
        own = cast("TextFixers", import_module(f"twinform.compiler.fixing.subjects.{subject}").TEXT_FIXERS)
        found |= own
    return found


def fixer_of(rule: str) -> Fixer | None:
    """The fixer of a rule, if it has one that works on elements.

    Raises:
        FixRegistryError: what is registered for it is none.
    """
    return fixers().get(rule) if rule in catalog() else strangers().get(rule)


def text_fixer_of(rule: str) -> TextFixer | None:
    """The fixer of a rule about texts, if it is one."""
    return text_fixers().get(rule)


@cache
def strangers() -> Fixers:
    """The fixers that other packages bring."""
    from importlib.metadata import entry_points  # noqa: PLC0415 - few rules are those of other packages

    found: dict[str, Fixer] = {}
    for entry in sorted(entry_points(group=GROUP), key=lambda each: each.name):
        owner = entry.dist.name if entry.dist else "an unknown distribution"
        try:
            fixer = entry.load()
        except (ImportError, AttributeError) as error:
            raise FixRegistryError(f"{owner} registers a fixer of {entry.name} that cannot be imported") from error
        if entry.name in catalog() or entry.name in found or not callable(fixer):
            raise FixRegistryError(f"{owner} registers a fixer of {entry.name}, which has one already or is none")
        found[entry.name] = cast("Fixer", fixer)
    return found
