"""How far a configuration is trusted: what it may read and write without `--trust-config`.

A configuration may have come with a download, or lie in a folder that others write into. So it must not name folders or
files outside of its own folder, nor raise a limit. Passes that make files, or that another package brings, may come
from it only if it is the caller's own. `HELD` says it setting by setting.
"""

import os
import stat
from collections.abc import Mapping
from pathlib import Path
from typing import Literal

from twinform.cli.config_file import ConfigError
from twinform.dataclass import dataclass
from twinform.passes import FilesPass, Pass, Pipeline
from twinform.passes.framework.built_in import BUILT_IN
from twinform.storage.writing import is_below

Hold = Literal["nothing to hold", "lowers a limit", "inside its folder", "known passes", "only if trusted"]
HELD: Mapping[str, Hold] = {
    "allow": "nothing to hold",  # it hides findings of `check`, which --no-config shows
    "baseline": "inside its folder",
    "carriers": "nothing to hold",
    "check-passes": "known passes",
    "default-classes": "nothing to hold",
    "deny": "nothing to hold",
    "env": "only if trusted",  # any variable may be a secret
    "exclude": "nothing to hold",  # it hides files of its own folder, which --no-config shows
    "extend-exclude": "nothing to hold",
    "extend-select": "nothing to hold",
    "files.allow": "nothing to hold",
    "files.arguments": "nothing to hold",
    "files.check-passes": "known passes",
    "files.deny": "nothing to hold",
    "files.extend-select": "nothing to hold",
    "files.ignore": "nothing to hold",
    "files.match": "nothing to hold",
    "files.passes": "known passes",
    "files.robot": "inside its folder",
    "files.select": "nothing to hold",
    "files.strict": "nothing to hold",
    "for": "nothing to hold",
    "format.indent": "nothing to hold",
    "format.numbers": "nothing to hold",
    "format.sort-attributes": "nothing to hold",
    "ignore": "nothing to hold",
    "max-size": "lowers a limit",
    "max-tags": "lowers a limit",
    "mesh-prefix": "nothing to hold",  # the beginning of URIs in the result
    "passes": "known passes",
    "paths": "inside its folder",
    "pipelines": "known passes",
    "preset": "nothing to hold",
    "read-carriers": "nothing to hold",
    "sdf-version": "nothing to hold",
    "select": "nothing to hold",
    "shape-error": "nothing to hold",  # meshes are limited, however small it is
    "strict": "nothing to hold",
    "sync": "inside its folder",  # only the command of that name writes these files
    "urdf-version": "nothing to hold",
}
"""What each setting is held to without `--trust-config`; no setting names programs or addresses, or files
to write but `sync`, for the command that is called so."""
_ADMINISTRATOR = 0
_ADVICE = "give --trust-config if this is meant"


def require_inside(config: Path, path: Path, key: str) -> None:
    """Require that a path in a configuration is in the folder of the configuration.

    Raises:
        ConfigError: it is not.
    """
    if not is_below(path, config.parent):
        raise ConfigError(config, f"{str(path)!r} leads out of the folder of the configuration; {_ADVICE}", key=key)


def require_lower(config: Path, key: str, value: int, usual: int) -> None:
    """Require that a configuration does not raise a limit.

    Raises:
        ConfigError: it does.
    """
    if value > usual:
        problem = (
            f"{value:,} is more than the usual {usual:,}; give --{key} yourself, or --trust-config, if this is meant"
        )
        raise ConfigError(config, problem, key=key)


def confined(config: Path, pipeline: Pipeline, key: str) -> Pipeline:
    """Keep the passes of a configuration from reading files outside of its folder.

    Raises:
        ConfigError: a pass makes a file or is of another package, and the configuration is somebody else's.
    """
    for step in pipeline:
        why = _risk(step)
        if why and not is_own(config):
            typed = f"type --passes '{Pipeline((step,))}' yourself"
            problem = f"{step.name} {why}, and the configuration is somebody else's: {typed}, or {_ADVICE}"
            raise ConfigError(config, problem, key=key)
    return pipeline.with_refusal(Outside(config.parent, f"the configuration that names it; {_ADVICE}"))


def _risk(step: Pass) -> str | None:
    """Say what a pass of a configuration could do beyond changing the model; None if nothing."""
    if isinstance(step, FilesPass):
        return "writes a file"
    # we do not know what a pass of another package does with its options
    return None if step.name in BUILT_IN else "comes from another package"


@dataclass(frozen=True, slots=True)
class Outside:
    """Refuses paths that lead out of a folder; URIs are resolved in folders of models and packages only."""

    folder: Path
    whose: str

    def __call__(self, path: str) -> str | None:
        """Say why a pass must not read a file; None if it may."""
        if "://" in path or is_below(Path(path), self.folder):
            return None
        return f"{path!r} leads out of the folder of {self.whose}"


def is_own(path: Path) -> bool:
    """Whether a file belongs to the caller, and nobody else can have put it there.

    The file and its real folder belong to the caller or the administrator, and are not writable for everybody. On a
    system without such owners no file is the caller's.
    """
    real = Path(os.path.realpath(path))
    # The same test as git's `safe.directory`. Groups do not count: on many systems the files of a
    # user are writable for a group of the user's own.
    return hasattr(os, "geteuid") and _belongs_to_caller(real) and _belongs_to_caller(real.parent)


def _belongs_to_caller(path: Path) -> bool:
    try:
        status = path.stat()
    except OSError:
        return False
    sticky = stat.S_ISDIR(status.st_mode) and status.st_mode & stat.S_ISVTX  # others cannot replace what is in it
    return status.st_uid in {os.geteuid(), _ADMINISTRATOR} and (bool(sticky) or not status.st_mode & stat.S_IWOTH)
