"""Passes: steps from IR to IR, pipelines of them, and the registry that finds them."""

from twinform.passes.base import Pass
from twinform.passes.other_documents import DocumentPass, DocumentReader
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
    "BrokenPassError",
    "DocumentPass",
    "DocumentReader",
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
