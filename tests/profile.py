"""How deep the tests of this project look: TWINFORM_PROFILE is smoke, default or deep."""

import os

from hypothesis import settings

from twinform.testing.profiles import PROFILES

PROFILE = os.environ.get("TWINFORM_PROFILE", "smoke")
DEEP = PROFILE == "deep"


def examples(share: float = 1.0) -> settings:
    """The settings of the profile for a property that costs so much more than others, or less."""
    base = settings.get_profile(f"twinform-{PROFILE}")
    return settings(base, max_examples=max(3, round(PROFILES[PROFILE] * share)))
