"""Rules about suppressions: comments that allow findings."""

from twinform.diagnostics.rule import Rule, Severity

MALFORMED_SUPPRESSION = Rule(
    name="malformed-suppression",
    severity=Severity.WARNING,
    finds="A comment that begins with `twinform:` and allows nothing: it is written in another way than expected, "
    "names a rule that does not exist or is fatal, or stands where no element follows.",
    matters="Whoever wrote it believes that something is allowed.",
    example="`<!-- twinform: allow dangling-lnik -->`",
    better="Write `<!-- twinform: allow RULE, RULE - reason -->` before an element, for it and all in it, or behind "
    "something on its line, for that line; and `allow-file` in the place of `allow` for the whole file.",
)
UNUSED_SUPPRESSION = Rule(
    name="unused-suppression",
    severity=Severity.WARNING,
    finds="A rule in a comment that allows it, where `check` finds nothing of that rule. Rules that only a conversion "
    "or a pass looks for are not reported, nor is anything in files that have errors or were included.",
    matters="What was wrong has been mended; the comment would hide the next mistake of its kind.",
    example="`<!-- twinform: allow zero-limit -->` before a joint whose limits are not zero any more.",
    better="Delete the rule from the comment, or the comment.",
)
