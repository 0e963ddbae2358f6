"""What each consumer of models makes of a file: profiles, which are data measured on the consumers themselves.

`data/NAME.toml` is the profile of a consumer: a row for each thing that it refuses, drops, misreads or warns about,
with the rule whose findings show that the thing is in a file. Most rules are those of `twinform check`; `detectors.py`
finds what is fine in general but not for some consumer, by rules of its own. `assessment.py` compares a file with
profiles; `remedies.py` has the one order of the passes that help.

To add a row: find out with the consumer itself what it does, name the rule and the effect. `reports/who_reads_it` asks
all consumers again. To add a detector: a function in `detectors.py` and a line in its table.
"""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.profiles.assessment import Assessment, ConsumerVerdict, Judgment, assess, findings
    from twinform.profiles.detectors import ProfiledFile
    from twinform.profiles.profile import (
        Effect,
        Profile,
        ProfileError,
        ProfileRow,
        UnknownProfileError,
        every_release,
        load,
        names,
        parse,
    )
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.profiles.assessment": "Assessment ConsumerVerdict Judgment assess findings",
            "twinform.profiles.profile": (
                "Effect Profile ProfileError ProfileRow UnknownProfileError every_release load names parse"
            ),
            "twinform.profiles.detectors": "ProfiledFile",
        },
    )

__all__ = [
    "Assessment",
    "ConsumerVerdict",
    "Effect",
    "Judgment",
    "Profile",
    "ProfileError",
    "ProfileRow",
    "ProfiledFile",
    "UnknownProfileError",
    "assess",
    "every_release",
    "findings",
    "load",
    "names",
    "parse",
]
