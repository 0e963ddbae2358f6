"""What `twinform check` does with each file: whether it is a robot, part of one or a companion, and who named it."""

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from twinform.cli.model_files import PARAMETERS, SRDF, is_companion_file
from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.root_names import may_be_mjcf
from twinform.dataclass import dataclass
from twinform.diagnostics import Severity, is_typo, rules
from twinform.file_access import may_be_root

if TYPE_CHECKING:
    from twinform.cli.inputs import InputSource, Remember
    from twinform.compiler import LoadOptions, LoadResult
    from twinform.diagnostics import Diagnostic


OUTSIDE = frozenset({rules.MISSING_ARGUMENT, rules.MISSING_PACKAGE})
"""Faults that are not in the file."""


@dataclass(frozen=True, slots=True)
class CheckPlan:
    """The roles of files as the include graph calls them, by name; others are robots. `named` files were typed."""

    roles: Mapping[str, str]
    named: frozenset[str]

    def shared(self, arguments: Iterable[str], files: int) -> Iterable[str]:
        """Return the arguments that some of so many files may have no use for, since it was found in a folder."""
        return arguments if len(self.named) < files else ()

    @classmethod
    def of(
        cls,
        sources: "Sequence[InputSource]",
        words: Sequence[str],
        load_options: "LoadOptions",
        remember: "Remember" = lambda _, make: make(),
    ) -> "CheckPlan":
        """Read how the files include each other, unless nothing of xacro is to be looked at and none is MJCF.

        `remember` may know it from an earlier run.
        """
        typed = {os.path.abspath(word) for word in words}  # noqa: PTH100 - links stay links
        named = frozenset(each.name for each in sources if os.path.abspath(each.name) in typed)  # noqa: PTH100 - as above
        names = [each.content for each in sources if isinstance(each.content, str)]
        companions = {name: "companion" for name in names if _is_companion(name)}
        files = [name for name in names if _may_be_part(name)]
        if load_options.xacro is False:
            files = [name for name in files if may_be_mjcf(name)]
        if not files:
            return cls(companions, named)

        def read() -> list[str]:
            from twinform.compiler.input.include_graph import IncludeGraph  # noqa: PLC0415 - few files are xacro

            return list(IncludeGraph(load_options.search).roles(files).values())

        roles = remember(("roles", files, load_options.search), read)
        return cls({**companions, **dict(zip(files, roles, strict=True))}, named)


def with_outside_faults(loaded: "LoadResult", *, named: bool) -> "LoadResult":
    """Return what was read, with warnings where arguments or packages are missing, which is no fault of the file.

    They stay errors where somebody has named the file and nothing in it could be checked. A file of a folder that has
    another root, and so is no model at all, is a note.
    """
    if named and loaded.document is None:
        return loaded
    return replace(loaded, diagnostics=tuple(map(_as_warning, loaded.diagnostics)))


def _as_warning(finding: "Diagnostic") -> "Diagnostic":
    if finding.rule is rules.UNKNOWN_ROOT and not _is_near_model(finding.found or ""):
        return replace(finding, severity=Severity.INFO)
    return replace(finding, severity=Severity.WARNING) if finding.rule in OUTSIDE else finding


_PARTS_OF_MODELS = frozenset({"actor", "gazebo", "joint", "light", "link", "model", "world"})


def _is_near_model(root: str) -> bool:
    """Whether somebody means a model by a root element, and no template or data of another program."""
    return root in _PARTS_OF_MODELS or any(is_typo(root, each) for each in ("robot", "sdf", "mujoco"))


def folders_asked(words: Sequence[str]) -> tuple[Path, ...]:
    """Return the folders of a command line, in which packages are looked for as in a workspace."""
    return tuple(Path(word) for word in words if os.path.isdir(word) and may_be_root(Path(word).absolute()))  # noqa: PTH112 - is_dir raises where a name is too long


def _is_companion(name: str) -> bool:
    return name.lower().endswith((SRDF, *PARAMETERS)) and is_companion_file(Path(name))


def _may_be_part(name: str) -> bool:
    return name.lower().endswith((*XACRO, ".urdf")) or may_be_mjcf(name)
