"""Passes: steps from IR to IR, pipelines of them, and the registry that finds them."""

from twinform.passes.assets import NO_ASSETS, AssetError, AssetPass, Assets
from twinform.passes.base import Pass
from twinform.passes.companions import CompanionPass, CompanionPath
from twinform.passes.errors import BrokenPassError, FailedPassError, PassError
from twinform.passes.named import Names, UnknownPipelineError
from twinform.passes.other_documents import DocumentPass, DocumentReader
from twinform.passes.pipeline import Pipeline, Verifier
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
from twinform.passes.text import parse_pipeline
from twinform.passes.watch import Watch, Watches

__all__ = [
    "GROUP",
    "NO_ASSETS",
    "AssetError",
    "AssetPass",
    "Assets",
    "BrokenPassError",
    "CompanionPass",
    "CompanionPath",
    "DocumentPass",
    "DocumentReader",
    "FailedPassError",
    "Names",
    "Pass",
    "PassError",
    "Pipeline",
    "PipelineError",
    "Registered",
    "RegistryError",
    "UnknownPassError",
    "UnknownPipelineError",
    "Verifier",
    "Watch",
    "Watches",
    "collect",
    "find_pass",
    "parse_pipeline",
    "registered_passes",
]
