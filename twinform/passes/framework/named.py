"""Pipelines that have a name. Whoever reads a configuration knows them; the text of a pipeline says `@NAME`."""

from collections.abc import Callable

from twinform.passes.framework.pipeline import Pipeline


class UnknownPipelineError(LookupError):
    """No pipeline has this name; the message is for users."""


Names = Callable[[str], Pipeline]
"""The pipeline of a name. Raises `UnknownPipelineError` where there is none."""


def no_names(name: str) -> Pipeline:
    """Knows no names."""
    raise UnknownPipelineError(f"no pipeline is called {name}: no configuration names any")
