"""`LoadOptions` and `LoadResult`: how a file is read, and what was found in it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypedDict

from twinform.compiler.input.allowances import Allowances
from twinform.compiler.input.size_limits import LARGEST, MOST_TAGS, USUAL_LIMITS, Limits, parse_size
from twinform.compiler.option import Option, given
from twinform.compiler.output.source_comments import Comments
from twinform.compiler.search.resolve_uris import SearchPath
from twinform.diagnostics import Diagnostic, LedgerEntry, LineOrigins
from twinform.ir import Document, count_parts
from twinform.schemas import DEFAULT_SDF_VERSION, Engine, XmlElement

if TYPE_CHECKING:
    from twinform.profiles import Profile

Input = str | Path | bytes | Document
"""What is read: the path of a file, the bytes of one, or a document that was read or made."""


class FileOptions(TypedDict, total=False):
    """How a file is read. `arguments` are those of xacro."""

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
        Option(help="Expand all files, or none; by default those called .xacro. It evaluates expressions in them."),
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
    """How a file is read, and whether those that it includes are."""

    expand_includes: Annotated[
        bool, Option(help="Read the files that includes name, and put them in their place.", switch=True)
    ]


class CheckOptions(ReadingOptions, total=False):
    """How a file is read, the rules that are not reported, and the consumers of the model, or their names."""

    allow: Iterable[str]
    profiles: "str | Iterable[Profile]"


@dataclass(frozen=True, slots=True)
class LoadOptions:
    """How files are read.

    `search` are the folders for URIs, `arguments` those of xacro. `xacro` selects which files are expanded: by default
    those whose name ends so, all where it is true, and none where it is false. `limits` say how large files may be.
    Without `keep_tree` the result has no tree, which needs more memory than the document; with `keep_comments` it has
    the comments. Findings of the rules in `allow` are left out, as are those that comments in the files allow; errors
    too where the caller is `tolerant`.
    `profiles` are those of the consumers that the files are for. `variables` are environment variables that xacro files
    may read besides those of ROS and Gazebo; `*` may stand in a name. `sdf_version` is the newest that the reader
    of the files knows: of a folder that has a model in several versions, it takes the newest one up to that.
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

    @classmethod
    def of(
        cls,
        options: FileOptions,
        *,
        allow: Iterable[str] = (),
        profiles: "str | Iterable[Profile]" = (),
        tolerant: bool = False,
    ) -> "LoadOptions":
        """What these options ask for; one that is `None` is not given.

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
        """The options for files that a reader of this version of SDF reads; the same ones where none is asked for."""
        return self if sdf_version is None else replace(self, sdf_version=sdf_version)

    def allowances(self, file: str, origins: Mapping[str, LineOrigins] | None = None) -> Allowances:
        """What may be left out of the findings about a file."""
        return Allowances(file, self.allow, self.limits, self.tolerant, origins or {})


def checking_options(options: CheckOptions) -> LoadOptions:
    """How a file is read whose errors may be allowed."""
    allow, profiles = options.get("allow", ()), options.get("profiles", ())
    return LoadOptions.of(options, allow=allow, profiles=profiles, tolerant=True)


@dataclass(frozen=True, slots=True)
class LoadResult:
    """What `check` found. `unreadable` means that there is no model at all: no file, no XML, or another format.

    The document may be there in spite of errors; `accepted` is whether it has any. `tree` is the XML that it came
    from, parsed from `content` where that was no document in memory, and `tree_size` its size where it was not kept.
    `origins` lead from its lines to where they were written if it was expanded. Where includes were expanded,
    `included` is the size of their files, `entries` what became of parts of them, and `mixed` means that the files may
    have been of several versions. `allowed` are the findings that the caller or a comment in a file allows, and
    `allowances` know of others whether they are. `comments` are those of the file, where they are kept.
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

    @property
    def text_name(self) -> str:
        """What the text that the document was read from is called in locations: a file, or what it expanded to."""
        expanded = expanded_name(self.path)
        return expanded if expanded in self.origins else self.path

    @property
    def size(self) -> int:
        """How many elements and attributes the source has."""
        if self.tree_size is not None:
            return self.included + self.tree_size
        if self.tree is not None:
            return self.included + parts_of(self.tree)
        return count_parts(self.document) if self.document else 0

    @property
    def accepted(self) -> bool:
        """Whether there is no error."""
        return not any(diagnostic.is_error for diagnostic in self.diagnostics)


def expanded_name(file: str) -> str:
    """What the text is called that a xacro file expands to."""
    return f"{file} (expanded)"


def unexpanded_name(name: str) -> str:
    """The file that a text with such a name is of: the xacro file that expanded to it, or itself."""
    return name.removesuffix(expanded_name(""))


def parts_of(tree: XmlElement) -> int:
    """How many elements and attributes a tree has."""
    return sum(1 + len(element.keys()) for element in tree.iter())


def name_of_input(source: Input | LoadResult) -> str:
    """What messages call it: a document is called as the file that it came from."""
    if isinstance(source, LoadResult):
        return source.path
    if isinstance(source, Document):
        return source.location.file or "<document>"
    return "<bytes>" if isinstance(source, bytes) else str(source)


def profiles_of(profiles: "str | Iterable[Profile]") -> "tuple[Profile, ...]":
    """The profiles of consumers, or those of their names.

    Raises:
        UnknownProfileError: there is none of such a name.
    """
    if not isinstance(profiles, str):
        return tuple(profiles)
    from twinform.profiles import parse  # noqa: PLC0415 - most models are for everybody

    return parse(profiles)
