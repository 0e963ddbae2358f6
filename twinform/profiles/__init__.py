"""What each consumer of models makes of a file: profiles, which are data measured on the consumers themselves.

`data/NAME.toml` is the profile of a consumer: a row for each thing that it refuses, drops, reads otherwise or warns
about, with the rule whose findings tell that the thing is in a file. Most rules are those of `twinform check`;
`detectors/` find what is fine in general and not for some consumer, by rules of `diagnostics/rules/portability.py`.
`assessment.py` holds a file (`subject.py`) against profiles; `remedies.py` has the one order of the passes that help.

To add a row: find out by the consumer itself what it does, name the rule and the effect. `reports/loaders` asks all
consumers again. To add a detector: a function in `detectors/SUBJECT.py` and its line in the table of `detectors`.
"""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.profiles.assessment import Assessment, ConsumerVerdict, Judgment, assess
    from twinform.profiles.consumer_findings import findings
    from twinform.profiles.profile import (
        Effect,
        Profile,
        ProfileError,
        ProfileRow,
        UnknownProfileError,
        load,
        names,
        parse,
    )
    from twinform.profiles.subject import ProfiledFile
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.profiles.assessment": "Assessment ConsumerVerdict Judgment assess",
            "twinform.profiles.consumer_findings": "findings",
            "twinform.profiles.profile": "Effect Profile ProfileError ProfileRow UnknownProfileError load names parse",
            "twinform.profiles.subject": "ProfiledFile",
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
    "findings",
    "load",
    "names",
    "parse",
]
