"""The front ends: from the XML tree of a URDF or SDF file to the IR.

Poses of URDF get the frames that they are in: a joint's origin is in the frame of its parent link, and the frame of the
child link is that of the joint. Trees of large files are freed while they are read, so that a tree and its document are
never in memory together.
"""

import sys
from collections import defaultdict
from collections.abc import Callable, Iterator
from functools import cache
from itertools import count
from typing import Any, cast

from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Document, Format, Model, Pose
from twinform.ir.foreign_joints import foreign_joints
from twinform.ir.record import amend, maker
from twinform.schemas import (
    Context,
    Version,
    XmlElement,
    declared_namespaces,
    has_prefixed_attributes,
    known_version,
    print_version,
    reader,
    refusals,
    undeclared_prefix,
    validate,
    version_read,
    versions_of,
)

_make_model = maker(Model)
_make_pose = maker(Pose)
_make_document = maker(Document)


def build_urdf(root: XmlElement, context: Context) -> Document:
    """Build the document of a `<robot>` without its namespaces."""
    data = reader("urdf", context.version).read(root, context)
    model = _make_model(data)
    _relate_poses(model)
    values = {"format": Format.URDF, "models": (model,), "source": model.source, **context.header}
    return _make_document(values)


def _relate_poses(model: Model) -> None:
    """Set the frames that the poses of joints and links are in; the nodes are new, so they may be changed."""
    children: dict[str, str] = {}
    for joint in model.joints:
        parent, child, pose = joint.parent, joint.child, joint.pose
        if parent is not None:
            if pose is None:
                amend(joint, "pose", _make_pose({"relative_to": parent}))
            else:
                amend(pose, "relative_to", parent)
        if child is not None:
            children.setdefault(child, joint.name)
    for link in model.links:
        name = children.get(link.name)
        if name is not None:
            amend(link, "pose", _make_pose({"relative_to": name}))


def build_sdf(root: XmlElement, context: Context) -> Document:
    """Build the document of an `<sdf>` without its namespaces."""
    data = reader("sdf", context.version).read(root, context)
    return _make_document({"format": Format.SDF, **data})


def check_extensions(document: Document, sink: DiagnosticSink) -> None:
    """Check the `<gazebo>` and `<drake:joint>` elements of a URDF file by reading them as a conversion would."""
    if any(each.form is None for model in document.models for each in foreign_joints(model)):
        from twinform.passes.legalise.drake_joints import ReadDrakeJoints  # noqa: PLC0415 - as below

        found = DiagnosticSink(file=sink.file, strict=sink.strict)
        ReadDrakeJoints.unchecked().run(document, found)
        # that SDF lacks a joint of Drake is no fault of the file
        sink.extend_new(each for each in found.diagnostics if each.rule is not rules.JOINT_TYPE_UNSUPPORTED)
    if not any(model.extensions for model in document.models):
        return
    from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - most files have none

    # What a tag means depends on what it refers to, and most of the content is SDF at the place of
    # the reference. One piece of code knows all this, the pass; `check` runs it and keeps only what
    # it reports.
    found = DiagnosticSink(file=sink.file, strict=sink.strict)
    FoldGazebo.unchecked().run(document, found)
    sink.extend_new(found.diagnostics)


LARGE = 16 * 2**20
"""The size of a text, in bytes, above which its tree is freed while it is read."""
_HOLDERS = frozenset({"world", "model"})
"""Elements that may hold most of a file."""
_NAMED = frozenset({"link", "joint"})
"""Elements that make up most of a file. They all have names, so that no path counts them."""
_MANY = 4096
"""After so many parts memory is returned to the system."""


def used_up(root: XmlElement) -> XmlElement:
    """Return a root from which links and joints are removed once the reader has gone past them."""
    return cast("XmlElement", _UsedUp(root))


class _UsedUp:
    """An element from which links and joints are removed as they are read."""

    def __init__(self, element: XmlElement) -> None:
        self._element = element

    def __getattr__(self, name: str) -> Any:
        return getattr(self._element, name)

    def __len__(self) -> int:
        return len(self._element)

    def __iter__(self) -> Iterator[XmlElement]:
        for number, child in enumerate(self._element, 1):
            yield used_up(child) if child.tag in _HOLDERS else child
            if child.tag in _NAMED:
                # Per link of a generated robot, the tree takes 14 kB as URDF and 18 kB as SDF, and
                # the document 10 kB. Emptying links instead of removing them freed half as much,
                # since what stays of each pins its page. 100,000 links now take 2.0 GB at most to
                # become SDF, and 2.3 GB to become URDF.
                self._element.remove(child)
            if number % _MANY == 0:
                return_memory()


def return_memory() -> None:
    """Return memory that libxml2 has freed to the system: the C library would keep it, and Python cannot use it."""
    trim = _trimmer()
    if trim is not None:
        trim(0)


@cache
def _trimmer() -> Callable[[int], int] | None:
    """Return the function of glibc that does it; other C libraries have none."""
    import ctypes  # noqa: PLC0415 - only large files

    return getattr(ctypes.CDLL(None), "malloc_trim", None) if sys.platform == "linux" else None


def build_mjcf(root: XmlElement, context: Context) -> Document:
    """Build the document of a `<mujoco>` in the terms of MJCF: all its elements are untyped."""
    data = reader("mjcf", context.version).read(root, context)
    return _make_document({"format": Format.MJCF, **data})


def build_checked_mjcf(root: XmlElement, context: Context) -> Document:
    """Build the document of a `<mujoco>` in the terms of MJCF, of which everything was reported before."""
    quiet = Context(DiagnosticSink(), context.file, context.format, context.version, simple=context.simple)
    return build_mjcf(root, quiet)


ROOTS: dict[str, tuple[str, Callable[[XmlElement, Context], Document]]] = {
    "robot": ("urdf", build_urdf),
    "sdf": ("sdf", build_sdf),
    "mujoco": ("mjcf", build_mjcf),
}
"""The format and the front end for each root element."""


def lower_tree(
    root: XmlElement,
    sink: DiagnosticSink,
) -> Document | None:
    """Build the document of a tree that we have written ourselves, and report where it is not valid after all."""
    format_, build = ROOTS[str(root.tag)]
    context = Context(sink, sink.file, format_, declared_version(root, format_, sink))
    errors = refusals(root, context, "libxml2")
    context.simple = not errors and not has_prefixed_attributes(root)
    document = build_document(build, root, context)
    if errors:
        validate(root, context, "libxml2", errors)
    amend(document, "namespaces", namespaces_of(root, None))
    return None if context.broken else document


def build_document(build: Callable[[XmlElement, Context], Document], root: XmlElement, context: Context) -> Document:
    """Build the document of a tree with a front end; where the context is `broken` then, it is good for checks only."""
    document = build(root, context)
    if context.broken and not context.sink.has_errors:
        raise ValueError(f"{context.file}: some part lacks what it needs, and nothing was reported")
    return document


def declared_version(root: XmlElement, format_: str, sink: DiagnosticSink) -> Version:
    """Return the version to read a file by, and report one that the format does not have."""
    known, declared = versions_of(format_), root.get("version")
    version = version_read(format_, declared)
    if declared is not None and declared not in known:
        where = Location(line=root.sourceline or 0, path=f"/{root.tag}/@version")
        message = f"{format_.upper()} has no version {declared!r}; read as {print_version(version)}"
        expected, refused = ", ".join(known), known_version(format_, declared) is None
        sink.report(rules.UNKNOWN_VERSION, message, where, found=declared, expected=expected, refused=refused)
    return version


def namespaces_of(root: XmlElement, default: str | None, *, inside: bool = True) -> tuple[tuple[str, str], ...]:
    """Return the prefixes of a document with their namespaces; a prefix that has a second meaning gets a new name."""
    own = [(prefix, uri) for prefix, uri in root.nsmap.items() if prefix]
    others = sorted(declared_namespaces(root).difference(own)) if inside else []
    found: dict[str, str] = {}
    known: set[str] = set()
    numbers: defaultdict[str, count[int]] = defaultdict(lambda: count(2))
    for prefix, uri in (*own, *others):
        wanted = undeclared_prefix(uri) or prefix
        if found.setdefault(wanted, uri) != uri and uri not in known:
            found[next(name for n in numbers[wanted] if (name := f"{wanted}{n}") not in found)] = uri
        known.add(uri)
    return (*((("", default),) if default else ()), *sorted(found.items()))
