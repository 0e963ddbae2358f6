"""The pipelines that a configuration names; each is parsed when it is asked for."""

from collections.abc import Mapping
from pathlib import Path

from twinform.cli.config.config_error import ConfigError
from twinform.passes import Pipeline, PipelineError, UnknownPipelineError, parse_pipeline
from twinform.passes.framework.pass_options import nearest
from twinform.passes.framework.pipeline_text import TableError, parse_tables
from twinform.passes.framework.syntax import KEY

_DEEPEST = 32
"""Pipelines that may stand for each other, one in the other."""
# A pipeline that names another one twice has twice as many passes: 26 such pipelines stand for 33
# million.
_MOST_PASSES = 1000


class NamedPipelines:
    """Called with a name, gives its pipeline. A pipeline may name others, but not itself."""

    def __init__(self, path: Path, raw: Mapping[str, object]) -> None:
        """`raw` has the text of each in the file at `path`.

        Raises:
            ConfigError: a name cannot be written as `@NAME`.
        """
        self.path, self.raw = path, raw
        self._open: list[str] = []
        self._known: dict[str, Pipeline] = {}
        for name in raw:
            if not KEY.fullmatch(name):
                problem = "the name of a pipeline takes letters, digits, _ and -"
                raise ConfigError(path, problem, key=f'pipelines."{name}"')

    def __call__(self, name: str) -> Pipeline:
        """The pipeline of this name.

        Raises:
            UnknownPipelineError: there is none, or it is needed for itself.
            ConfigError: the text in the file is no pipeline.
        """
        if name not in self.raw:
            raise UnknownPipelineError(f"no pipeline is called {name} in {self.path}{nearest(name, list(self.raw))}")
        if name in self._open:
            raise UnknownPipelineError(f"a pipeline stands for itself: {' -> '.join((*self._open, name))}")
        if len(self._open) >= _DEEPEST:
            raise UnknownPipelineError(f"more than {_DEEPEST} pipelines stand for each other: {name} is one too many")
        if name not in self._known:
            self._open.append(name)
            try:
                self._known[name] = self._parsed(name)
            finally:
                self._open.pop()
        return self._known[name]

    def _parsed(self, name: str) -> Pipeline:
        raw, key = self.raw[name], f"pipelines.{name}"
        try:
            found = parse_pipeline(raw, names=self) if isinstance(raw, str) else parse_tables(raw, names=self)
        except PipelineError as error:
            raise ConfigError(self.path, str(error), key=key) from error
        except TableError as error:
            raise ConfigError(self.path, error.problem, key=key + error.key) from error
        if len(found.passes) > _MOST_PASSES:
            raise ConfigError(self.path, f"it stands for more than {_MOST_PASSES:,} passes", key=key)
        return found
