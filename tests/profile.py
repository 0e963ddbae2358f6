"""How deep the tests of this project look: TWINFORM_PROFILE is smoke, default or deep.

The smoke profile of `make test` tries the same examples at every run of the same tree, so that a change fails where it
was made; the others try new ones.
"""

import os

from hypothesis import settings

from twinform.testing.profiles import PROFILES

PROFILE = os.environ.get("TWINFORM_PROFILE", "smoke")
DEEP = PROFILE == "deep"
REPEATED = PROFILE == "smoke"
# New examples at each run could fail for a fault that was there for months, in the way of a change that has
# nothing to do with it. A fault that the deep profile finds becomes a case.
_CHEAP = 50 if REPEATED else 100
"""How many examples a property is tried with that does not ask for `examples`."""

settings.register_profile(
    "tests", settings.get_profile(f"twinform-{PROFILE}"), derandomize=REPEATED, max_examples=_CHEAP
)
settings.load_profile("tests")


def examples(share: float = 1.0) -> settings:
    """The settings of the profile for a property that costs so much more than others, or less."""
    return settings(max_examples=max(3, round(PROFILES[PROFILE] * share)))
