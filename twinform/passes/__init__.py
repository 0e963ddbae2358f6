"""Passes: steps from IR to IR, pipelines of them, and the registry that finds them."""

from twinform.passes.framework.assets import NO_ASSETS, AssetError, AssetPass, Assets
from twinform.passes.framework.base import Pass
from twinform.passes.framework.errors import BrokenPassError, FailedPassError, PassError
from twinform.passes.framework.instrumentation import CombinedInstrumentation, PassInstrumentation
from twinform.passes.framework.other_documents import DocumentPass, DocumentReader
from twinform.passes.framework.pipeline import Pipeline, Verifier
from twinform.passes.framework.registry import (
    GROUP,
    Registered,
    RegistryError,
    UnknownPassError,
    collect,
    find_pass,
    registered_passes,
)
from twinform.passes.framework.side_files import CompanionPath, SideFilePass
from twinform.passes.framework.syntax import PipelineError
from twinform.passes.framework.text import Names, UnknownPipelineError, parse_pipeline

__all__ = [
    "GROUP",
    "NO_ASSETS",
    "AssetError",
    "AssetPass",
    "Assets",
    "BrokenPassError",
    "CombinedInstrumentation",
    "CompanionPath",
    "DocumentPass",
    "DocumentReader",
    "FailedPassError",
    "Names",
    "Pass",
    "PassError",
    "PassInstrumentation",
    "Pipeline",
    "PipelineError",
    "Registered",
    "RegistryError",
    "SideFilePass",
    "UnknownPassError",
    "UnknownPipelineError",
    "Verifier",
    "collect",
    "find_pass",
    "parse_pipeline",
    "registered_passes",
]
