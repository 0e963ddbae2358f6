"""Passes: steps from IR to IR, pipelines of them, and the registry that finds them."""

from twinform.passes.assets import NO_ASSETS, AssetError, AssetPass, Assets
from twinform.passes.base import Pass
from twinform.passes.pipeline import BrokenPassError, Pipeline, Verifier, Watch, parse_pipeline, print_pipeline
from twinform.passes.registry import (
    GROUP,
    Registered,
    RegistryError,
    UnknownPassError,
    collect,
    find_pass,
    registered_passes,
)
from twinform.passes.syntax import PipelineError

__all__ = [
    "GROUP",
    "NO_ASSETS",
    "AssetError",
    "AssetPass",
    "Assets",
    "BrokenPassError",
    "Pass",
    "Pipeline",
    "PipelineError",
    "Registered",
    "RegistryError",
    "UnknownPassError",
    "Verifier",
    "Watch",
    "collect",
    "find_pass",
    "parse_pipeline",
    "print_pipeline",
    "registered_passes",
]
