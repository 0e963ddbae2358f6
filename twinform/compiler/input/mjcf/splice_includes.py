"""Puts the files that MJCF includes in their places: textual, anywhere in the file, each file once.

The result is a text of its own, with one element on each line, and the origin of each element: findings are reported
in the file that an element was written in, as they are for xacro. What stands in an included file may lead no further
than what stands in the main one.
"""

import os
from collections.abc import Iterator
from dataclasses import field
from pathlib import Path

from lxml import etree

from twinform.compiler.input.expansion import Expansion, PartOrigin
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.parsing import UnreadableError, parse, read_bytes, strip_default_namespace
from twinform.compiler.input.size_limits import LIFTED_BY_SIZE, LIFTED_BY_TAGS
from twinform.compiler.input.xacro_needs import shown_name
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, LineOrigins, Location, Rule, rules
from twinform.schemas import XmlElement, path_of

INCLUDE = "include"


def splice_includes(path: Path, text: bytes, sink: DiagnosticSink, load_options: LoadOptions) -> Expansion | None:
    """Return the text of a file with all that it includes, or None for a file that is not MJCF or includes nothing.

    What is wrong with the text itself is left to whoever reads it.

    Raises:
        UnreadableError: something cannot be included; the diagnostics tell what.
    """
    try:
        root = parse(text, DiagnosticSink(sink.file), load_options.limits, keep_comments=True)
    except UnreadableError:
        return None
    strip_default_namespace(root)
    if root.tag != "mujoco" or next(root.iter(INCLUDE), None) is None:
        return None
    splicing = _Splicing(path, sink, load_options)
    splicing.take_in(root, sink.file, text)
    splicing.splice(root)
    if splicing.failed:
        raise UnreadableError
    return splicing.expansion(root)


@dataclass(slots=True)
class _Splicing:
    """The files that were taken in, and where each element was written."""

    main: Path
    sink: DiagnosticSink
    load_options: LoadOptions
    texts: dict[str, bytes] = field(default_factory=dict[str, bytes])
    shown: dict[str, str] = field(default_factory=dict[str, str])
    origins: dict[XmlElement, PartOrigin] = field(default_factory=dict[XmlElement, PartOrigin])
    above: dict[str, tuple[str, ...]] = field(default_factory=dict[str, tuple[str, ...]])
    tags: int = 0
    size: int = 0
    failed: bool = False

    def take_in(self, root: XmlElement, file: str, text: bytes) -> None:
        """Remember where the elements of a file are."""
        self.texts[file] = text
        self.shown[os.path.abspath(file)] = file  # noqa: PTH100 - links are files of their own
        self.above.setdefault(file, (file,))
        for number, element in enumerate(root.iter("*")):
            self.origins[element] = PartOrigin(file, element.sourceline or 0, number, 0)
        self.tags += text.count(b"<")
        self.size += len(text)

    def splice(self, root: XmlElement) -> None:
        """Put all files in the places of the elements that include them, and those that they include."""
        left = list(root.iter(INCLUDE))[::-1]
        while left and not self.failed:
            include = left.pop()
            inner = self._read(include)
            if inner is None:
                self.failed = True
                return
            left += [each for child in inner for each in child.iter(INCLUDE)][::-1]
            self._replace(include, inner)

    def _read(self, include: XmlElement) -> XmlElement | None:
        """Return the root of an included file, or None where it cannot be read, which is reported."""
        name = include.get("file")
        if not name:
            self._report(rules.MISSING_ATTRIBUTE, include, "<include> has no attribute 'file'", expected="@file")
            return None
        if len(include):
            self._report(rules.UNKNOWN_ELEMENT, include[0], "<include> cannot have anything in it")
            return None
        around = self.origins[include].file
        file = self._find(name, around)
        shown = shown_name(file, self.sink.file)
        if self._is_taken(include, name, file, shown, around):
            return None
        text = self._text(include, name, file)
        if text is None:
            return None
        found = DiagnosticSink(shown, self.sink.strict)
        try:
            root = parse(text, found, self.load_options.limits, keep_comments=True)
        except UnreadableError:
            return None
        finally:
            self.sink.extend(found.diagnostics)
        strip_default_namespace(root)
        if next(root.iterchildren("*"), None) is None:
            self._report(rules.EMPTY_INCLUDE, include, f"{name!r} has no element in its root", "@file", found=name)
            return None
        self.above[shown] = (*self.above[around], shown)
        self.take_in(root, shown, text)
        return None if self._is_too_much(include) else root

    def _find(self, name: str, around: str) -> str:
        """Return the path of a file: from the folder of the main file or, where there is none, of the one around."""
        folder = self.main.parent
        found = os.path.normpath(folder / name)
        if os.path.lexists(found):
            return found
        beside = os.path.normpath(Path(around).parent / name)
        return beside if os.path.lexists(beside) else found

    def _is_taken(self, include: XmlElement, name: str, file: str, shown: str, around: str) -> bool:
        """Report a file that was included before, or includes itself."""
        first = self.shown.get(os.path.abspath(file))  # noqa: PTH100 - as above
        if first is None:
            return False
        chain = self.above[around]
        if first in chain:
            names = " includes ".join(repr(each) for each in (*chain[chain.index(first) :], first))
            self._report(rules.INCLUDE_CYCLE, include, names, "@file", found=name)
        else:
            message = f"{shown!r} is included before, and MuJoCo includes each file once"
            self._report(rules.REPEATED_INCLUDE, include, message, "@file", found=name)
        return True

    def _text(self, include: XmlElement, name: str, file: str) -> bytes | None:
        search = self.load_options.search
        unsaved = search.unsaved_of(file)
        if unsaved is not None:
            return unsaved
        if not os.path.lexists(file):
            message = f"{name!r} leads to {file!r}, but there is no such file"
            self._report(rules.UNRESOLVED_URI, include, message, "@file", found=name)
            return None
        search.seen.add(Path(file))
        found = DiagnosticSink()
        try:
            return read_bytes(Path(file), found, self.load_options.limits, search.readable(self.main))
        except UnreadableError:
            problem = found.diagnostics[0]
            self._report(problem.rule, include, f"{name!r}: {problem.message}", "@file", found=name, help=problem.help)
            return None

    def _is_too_much(self, include: XmlElement) -> bool:
        limits = self.load_options.limits
        if self.tags > limits.tags:
            message, help = f"the files have more than {limits.tags:,} tags together", LIFTED_BY_TAGS
        elif self.size > limits.size:
            message, help = f"the files have more than {limits.size:,} bytes together", LIFTED_BY_SIZE
        else:
            return False
        self._report(rules.OVERSIZED_FILE, include, message, help=help)
        return True

    def _replace(self, include: XmlElement, inner: XmlElement) -> None:
        for child in list(inner):
            include.addprevious(child)
        parent = include.getparent()
        if parent is not None:
            parent.remove(include)

    def _report(
        self,
        rule: Rule,
        element: XmlElement,
        message: str,
        step: str = "",
        *,
        found: str | None = None,
        expected: str | None = None,
        help: str | None = None,
    ) -> None:
        origin = self.origins[element]
        path = path_of(element) + (f"/{step}" if step else "")
        self.sink.report(
            rule, message, Location(origin.file, origin.line, path), found=found, expected=expected, help=help
        )

    def expansion(self, root: XmlElement) -> Expansion:
        """Return the text of a tree, and where its elements were written."""
        parts = [self.origins[element] for element in root.iter("*")]
        text = etree.tostring(_one_on_each_line(root), encoding="utf-8") + b"\n"
        parser = etree.XMLParser(remove_comments=True, resolve_entities=False, no_network=True)
        lines = (element.sourceline or 0 for element in etree.fromstring(text, parser).iter())
        pairs = zip(lines, (Location(part.file, part.line) for part in parts), strict=True)
        whole = (0, Location(self.sink.file))  # what is found about all of the text
        return Expansion(text, LineOrigins.of([whole, *pairs]), {}, self.texts, parts)


def _one_on_each_line(root: XmlElement) -> XmlElement:
    """Let each element of a tree begin on a line of its own."""
    for depth, element in _with_depth(root):
        if len(element) and not (element.text or "").strip():
            element.text = "\n" + "  " * (depth + 1)
        if depth and not (element.tail or "").strip():
            element.tail = "\n" + "  " * (depth if element.getnext() is not None else depth - 1)
    return root


def _with_depth(root: XmlElement) -> Iterator[tuple[int, XmlElement]]:
    depth = 0
    for event, element in etree.iterwalk(root, events=("start", "end", "comment")):
        if event == "end":
            depth -= 1
            continue
        yield depth, element
        depth += event == "start"
