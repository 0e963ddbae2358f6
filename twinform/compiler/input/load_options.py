"""`LoadOptions` and `LoadResult`: how a file is read, and what was found in it."""

import os
from collections.abc import Iterable, Mapping
from dataclasses import field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple, TypedDict

from twinform.compiler.conversion_error import CompileError, MissingFileError
from twinform.compiler.input.allowances import Allowances
from twinform.compiler.input.expansion import Expansion
from twinform.compiler.input.root_names import ENOUGH, root_name
from twinform.compiler.input.size_limits import LARGEST, MOST_TAGS, USUAL_LIMITS, Limits, parse_size
from twinform.compiler.output.source_comments import Comments
from twinform.compiler.resolve_uris import SearchPath
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, LedgerEntry, LineOrigins
from twinform.ir import Document, Format, count_parts
from twinform.option import Option, given
from twinform.schemas import DEFAULT_SDF_VERSION, Engine, XmlElement
from twinform.schemas.messages import StandIn

if TYPE_CHECKING:
    from twinform.profiles import Profile

Input = str | Path | bytes | Document
"""The path of a file, the bytes of one, or a document."""
XACRO = (".xacro", ".xacro.urdf", ".xacro.sdf")
"""The endings, in lower case, of the names of files that are expanded before they are read."""


class FileOptions(TypedDict, total=False):
    """How a file is read; `arguments` are those of xacro."""

    strict: Annotated[bool, Option(help="Refuse what readers ignore, such as unknown names.", setting=True)]
    engine: Annotated[Engine, Option(help="The XSD validator; xmlschema is the slow reference.")]
    paths: Annotated[
        Iterable[str | Path],
        Option(
            help="A folder of models or packages, looked in before those that the environment names; repeatable.",
            flag="--path",
            metavar="DIR",
        ),
    ]
    env: Annotated[
        Iterable[str],
        Option(
            help="An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any "
            "letters.",
            metavar="NAME",
        ),
    ]
    xacro: Annotated[
        bool | None,
        Option(help="Expand all files, or none; by default those called .xacro, .xacro.urdf or .xacro.sdf."),
    ]
    max_size: Annotated[
        int,
        Option(
            help="The largest file that is read, such as 200MB or 1GiB; by default 64MiB.",
            metavar="SIZE",
            parse=parse_size,
            most=LARGEST,
            setting=True,
        ),
    ]
    max_tags: Annotated[
        int,
        Option(
            help=f"The most tags of a file, or parts of a JSON document; by default {MOST_TAGS:,}.",
            metavar="N",
            most=MOST_TAGS,
            setting=True,
        ),
    ]
    arguments: Mapping[str, str]


class ReadingOptions(FileOptions, total=False):
    """How a file is read, and whether the files that it includes are read too."""

    expand_includes: Annotated[
        bool, Option(help="Read the files that includes name, and put them in their place.", switch=True)
    ]


class CheckOptions(ReadingOptions, total=False):
    """How a file is read, the rules that are not reported, and the consumers of the model, or their names."""

    allow: Iterable[str]
    profiles: "str | Iterable[Profile]"


class AnyCheckOptions(CheckOptions, total=False):
    """How a model is checked, or a file that names the parts of a `robot`."""

    robot: str | Path


@dataclass(frozen=True, slots=True)
class LoadOptions:
    """How files are read.

    `search` has the folders for URIs, and `arguments` are those of xacro. `xacro` selects which files are expanded: by
    default those whose names end in `.xacro`, `.xacro.urdf` or `.xacro.sdf`, all where it is true, and none where it is
    false. `limits` are the largest sizes of files. Without `keep_tree` the result has no tree, which needs more memory
    than the document; with `keep_comments` it has the comments. Findings of the rules in `allow` are left out, as are
    those that comments in the files allow; allowed errors are left out only if the caller is `tolerant`.
    `profiles` are those of the consumers that the files are for. `variables` are environment variables that xacro files
    may read besides those of ROS and Gazebo; `*` may stand in a name. `sdf_version` is the newest version that the
    reader of the files knows: of a folder with a model in several versions, the newest one up to it is read. `robot` is
    the file of the robot that files which name parts of one are for, where somebody has said so. `as_mjcf` leaves a
    document of MJCF in the terms of MJCF, to be written again.
    """

    strict: bool = False
    engine: Engine = "libxml2"
    search: SearchPath = field(default_factory=SearchPath.of)
    arguments: Mapping[str, str] = field(default_factory=dict[str, str])
    xacro: bool | None = None
    limits: Limits = USUAL_LIMITS
    keep_tree: bool = True
    keep_comments: bool = False
    allow: frozenset[str] = frozenset()
    tolerant: bool = False
    profiles: "tuple[Profile, ...]" = ()
    variables: tuple[str, ...] = ()
    sdf_version: str = DEFAULT_SDF_VERSION
    robot: str = ""
    as_mjcf: bool = False

    @classmethod
    def of(
        cls,
        options: FileOptions,
        *,
        allow: Iterable[str] = (),
        profiles: "str | Iterable[Profile]" = (),
        tolerant: bool = False,
    ) -> "LoadOptions":
        """Make the options from keywords; one that is `None` is not given.

        Raises:
            UnknownProfileError: there is no such consumer.
            ValueError: a limit is no positive whole number.
        """
        return cls(
            options.get("strict") or False,
            options.get("engine") or "libxml2",
            SearchPath.of(options.get("paths") or ()),
            options.get("arguments") or {},
            options.get("xacro"),
            Limits(given(options.get("max_size"), LARGEST), given(options.get("max_tags"), MOST_TAGS)),
            allow=frozenset(allow),
            tolerant=tolerant,
            profiles=profiles_of(profiles),
            variables=tuple(options.get("env") or ()),
        )

    def read_by(self, sdf_version: str | None) -> "LoadOptions":
        """Return the options for a reader that knows SDF up to a version, or unchanged where that is None."""
        return self if sdf_version is None else replace(self, sdf_version=sdf_version)

    def with_unsaved(self, texts: Mapping[str, bytes]) -> "LoadOptions":
        """Return the options for reading files that have other texts than on the disk, by paths without links."""
        return replace(self, search=replace(self.search, unsaved={**self.search.unsaved, **texts})) if texts else self

    def allowances(self, file: str, origins: Mapping[str, LineOrigins] | None = None) -> Allowances:
        """Return what may be left out of the findings about a file."""
        return Allowances(file, self.allow, self.limits, self.tolerant, origins or {})


def checking_options(options: CheckOptions) -> LoadOptions:
    """Make the options to read a file whose errors may be allowed."""
    allow, profiles = options.get("allow", ()), options.get("profiles", ())
    return LoadOptions.of(options, allow=allow, profiles=profiles, tolerant=True)


class Recovered(NamedTuple):
    """A document in which values stand for what could not be read: it can be checked, and nothing else made of it."""

    document: Document
    stand_ins: tuple[StandIn, ...]


@dataclass(frozen=True, slots=True)
class LoadResult:
    """The document of a file, and what was found in it.

    `unreadable` means that there is no model at all: no file, no XML, or another format. The document may be there in
    spite of errors; it is `accepted` where there are none. `tree` is the XML that the document came from, parsed from
    `content` unless it was a document in memory, and `tree_size` is its size where it was not kept. `origins` lead from
    the lines of an expanded text to where they were written. Where includes were expanded, `included` is the size of
    their files, `entries` what became of parts of them, and `mixed` means that the files may be of several versions.
    `allowed` are the findings that the caller or a comment in a file allows, and `allowances` decide about further
    findings. `comments` are those of the file, where they are kept. Where some part lacks what it needs, there is no
    document, and what could be `recovered` of it. `expansion` is that of a xacro file, and `texts` are the files that
    were read of one which cannot be expanded.
    """

    path: str
    document: Document | None
    diagnostics: tuple[Diagnostic, ...]
    unreadable: bool = False
    tree: XmlElement | None = None
    content: bytes | None = field(default=None, repr=False)
    tree_size: int | None = None
    origins: Mapping[str, LineOrigins] = field(default_factory=dict[str, LineOrigins])
    included: int = 0
    entries: tuple[LedgerEntry, ...] = ()
    mixed: bool = False
    allowed: tuple[Diagnostic, ...] = ()
    allowances: Allowances | None = field(default=None, repr=False, compare=False)
    comments: Comments | None = field(default=None, repr=False, compare=False)
    recovered: Recovered | None = field(default=None, repr=False, compare=False)
    expansion: Expansion | None = field(default=None, repr=False, compare=False)
    texts: Mapping[str, bytes] = field(default_factory=dict[str, bytes], repr=False, compare=False)

    @property
    def text_name(self) -> str:
        """The name in locations of the text that the document was read from: the file, or its expansion."""
        expanded = expanded_name(self.path)
        return expanded if expanded in self.origins else self.path

    @property
    def size(self) -> int:
        """The number of elements and attributes in the source."""
        if self.tree_size is not None:
            return self.included + self.tree_size
        if self.tree is not None:
            return self.included + parts_of(self.tree)
        return count_parts(self.document) if self.document else 0

    @property
    def is_mjcf(self) -> bool:
        """Whether the text is MJCF: the document of it is in the terms of SDF."""
        return self.content is not None and root_name(self.content[:ENOUGH]) == b"mujoco"

    @property
    def format(self) -> Format | None:
        """The format of the text; None where there is no document."""
        return Format.MJCF if self.is_mjcf else self.document.format if self.document is not None else None

    def sink(self, *, strict: bool) -> DiagnosticSink:
        """Make a sink with what was found so far, to which a conversion adds."""
        return DiagnosticSink(
            self.path,
            strict,
            list(self.diagnostics),
            list(self.entries),
            origins=dict(self.origins),
            allows=self.allowances and self.allowances.in_conversion,
            allowed=list(self.allowed),
        )

    def error(self) -> CompileError:
        """Return the error to raise where the file is not accepted: another one where there is none."""
        is_missing = self.unreadable and self.content is None and not os.path.lexists(self.path)
        kind = MissingFileError if is_missing else CompileError
        return kind(self.diagnostics, unreadable=self.unreadable)

    @property
    def accepted(self) -> bool:
        """Whether there is a document, and no error."""
        return self.document is not None and not any(diagnostic.is_error for diagnostic in self.diagnostics)


def expanded_name(file: str) -> str:
    """Return the name in locations of the text that a xacro file expands to."""
    return f"{file} (expanded)"


def unexpanded_name(name: str) -> str:
    """Return the name of the xacro file that an expanded text comes from; other names are returned unchanged."""
    return name.removesuffix(expanded_name(""))


def parts_of(tree: XmlElement) -> int:
    """Count the elements and attributes of a tree."""
    return sum(1 + len(element.keys()) for element in tree.iter())


def name_of_input(source: Input | LoadResult) -> str:
    """Return the name of an input in messages; a document has the name of its file."""
    if isinstance(source, LoadResult):
        return source.path
    if isinstance(source, Document):
        return source.location.file or "<document>"
    return "<bytes>" if isinstance(source, bytes) else str(source)


def profiles_of(profiles: "str | Iterable[Profile]") -> "tuple[Profile, ...]":
    """Return profiles, given as such or as names with commas between.

    Raises:
        UnknownProfileError: there is no profile of a name.
    """
    if not isinstance(profiles, str):
        return tuple(profiles)
    from twinform.profiles import parse  # noqa: PLC0415 - most models are for everybody

    return parse(profiles)
