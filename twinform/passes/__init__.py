"""Passes: steps from IR to IR, pipelines of them, and the registry that finds them."""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.passes.framework.assets import NO_ASSETS, AssetError, Assets
    from twinform.passes.framework.pass_base import AssetPass, DocumentPass, DocumentReader, FilesPass, Pass
    from twinform.passes.framework.pass_errors import BrokenPassError, FailedPassError, PassError
    from twinform.passes.framework.pass_registry import (
        GROUP,
        Registered,
        RegistryError,
        UnknownPassError,
        collect,
        find_pass,
        registered_passes,
    )
    from twinform.passes.framework.pipeline import CombinedInstrumentation, PassInstrumentation, Pipeline, Verifier
    from twinform.passes.framework.pipeline_text import Names, UnknownPipelineError, parse_pipeline
    from twinform.passes.framework.side_files import CompanionPath, SideFilePass
    from twinform.passes.framework.syntax import PipelineError
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.passes.framework.pass_base": "AssetPass DocumentPass DocumentReader FilesPass Pass",
            "twinform.passes.framework.pass_errors": "BrokenPassError FailedPassError PassError",
            "twinform.passes.framework.assets": "NO_ASSETS AssetError Assets",
            "twinform.passes.framework.pipeline": "CombinedInstrumentation PassInstrumentation Pipeline Verifier",
            "twinform.passes.framework.pass_registry": "GROUP Registered RegistryError UnknownPassError "
            "collect find_pass registered_passes",
            "twinform.passes.framework.side_files": "CompanionPath SideFilePass",
            "twinform.passes.framework.syntax": "PipelineError",
            "twinform.passes.framework.pipeline_text": "Names UnknownPipelineError parse_pipeline",
        },
    )

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
    "FilesPass",
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
