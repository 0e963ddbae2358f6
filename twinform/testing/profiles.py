"""Hypothesis profiles by how deep they search, such as `settings.load_profile("twinform-deep")`."""

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

PROFILES = {"smoke": 15, "default": 100, "deep": 1000}
"""The number of examples for each property."""


def register() -> None:
    """Register the profiles with Hypothesis and, if the IR is imported already, the strategies for its types."""
    # Hypothesis calls this when it is imported; importing the IR here would take longer than all of Hypothesis.
    from hypothesis import HealthCheck, settings  # noqa: PLC0415 - whoever calls this imports it

    quiet = (HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large)
    for name, examples in PROFILES.items():
        settings.register_profile(
            f"twinform-{name}", max_examples=examples, deadline=None, suppress_health_check=quiet, print_blob=True
        )
    if "twinform.ir" in sys.modules:
        register_types()


def register_types() -> None:
    """Let `st.from_type(Document)` and the like draw valid models."""
    from hypothesis import strategies as st  # noqa: PLC0415 - few programs test

    from twinform.ir import Document, Inertial, Joint, Link, Pose  # noqa: PLC0415 - as above

    st.register_type_strategy(Document, lambda _: _strategy("robots") | _strategy("sdf_models"))
    st.register_type_strategy(Inertial, lambda _: _strategy("inertials"))
    st.register_type_strategy(Joint, lambda _: _strategy("joints"))
    st.register_type_strategy(Link, lambda _: _strategy("links"))
    st.register_type_strategy(Pose, lambda _: _strategy("poses"))


def _strategy(name: str) -> "SearchStrategy[Any]":
    # imported when it is drawn from: the strategies may be what imports Hypothesis, and are not ready yet
    return getattr(import_module("twinform.testing.strategies"), name)()
