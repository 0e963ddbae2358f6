"""Hypothesis profiles, by how deep they search: `settings.load_profile("twinform-deep")`."""

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

PROFILES = {"smoke": 15, "default": 100, "deep": 1000}
"""How many examples each property is tried with."""


def register() -> None:
    """Tell Hypothesis of the profiles and, where the IR is there already, of the strategies for its types.

    Hypothesis calls this when it is imported; importing the IR for it would take longer than all of Hypothesis.
    """
    from hypothesis import HealthCheck, settings  # noqa: PLC0415 - it is imported by whoever calls this

    quiet = (HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large)
    for name, examples in PROFILES.items():
        settings.register_profile(
            f"twinform-{name}", max_examples=examples, deadline=None, suppress_health_check=quiet, print_blob=True
        )
    if "twinform.ir" in sys.modules:
        register_types()


def register_types() -> None:
    """Let `st.from_type(Document)` and the like draw models that are valid.

    The strategies are imported when one is drawn from: it may be they who import Hypothesis, and are not ready yet.
    """
    from hypothesis import strategies as st  # noqa: PLC0415 - few programs test

    from twinform.ir import Document, Inertial, Joint, Link, Pose  # noqa: PLC0415 - as above

    st.register_type_strategy(Document, lambda _: _strategy("robots") | _strategy("sdf_models"))
    st.register_type_strategy(Inertial, lambda _: _strategy("inertials"))
    st.register_type_strategy(Joint, lambda _: _strategy("joints"))
    st.register_type_strategy(Link, lambda _: _strategy("links"))
    st.register_type_strategy(Pose, lambda _: _strategy("poses"))


def _strategy(name: str) -> "SearchStrategy[Any]":
    return getattr(import_module("twinform.testing.strategies"), name)()
