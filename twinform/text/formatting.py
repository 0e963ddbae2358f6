"""The formatter: lays the text of a model out anew, and changes nothing that means anything.

It works on the text and not on a tree, so that comments, processing instructions, CDATA sections, entities, quotes and
the spelling of numbers stay as they are, also in xacro files. What it does:

1. One element a line, indented by its depth; a comment at the end of a line stays there.
2. At most two blank lines in a row, no blanks at the end of lines, a line end at the end of the file.
3. One blank before each attribute. What an author has laid out by hand stays: attributes on lines of their own, which
   are aligned, and columns of attributes in neighboring tags.
4. Only where it is asked for: attributes in their usual order, and numbers in their shortest spelling.

Texts are content. An element with text beside elements, or with `xml:space="preserve"`, stays as it is between its
tags. The lines of a comment, and of a text of nothing but numbers, move with the element that they belong to.
"""

import re
from array import array
from functools import cached_property
from types import ModuleType
from typing import Literal

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern
from twinform.schemas.generated import name_usage
from twinform.text.positions import Lines
from twinform.text.source_text import SourceText
from twinform.text.start_tags import TAB, StartTag, all_numbers, name_of, rank, shortest
from twinform.text.tokens import TokenKind, Tokens

_LINE_END = lazy_pattern(r"\r\n|\n|\r")
# 205 of 2,249 real files separate their sections by two blank lines.
_MOST_LINE_ENDS = 3
"""Two blank lines in a row are the most that are kept."""
_PRESERVED = lazy_pattern(r"""\sxml:space\s*=\s*["']preserve["']""")
# Columns are kept where attributes of neighboring rows begin at one column behind more than one
# blank. Both neighbors see that alike, so a second run changes nothing.
_WIDE = lazy_pattern(r"[ \t\r\n]{2}|\t")
_PLAIN = lazy_pattern(r"""<([^\s/>]++)(?: [^\s=<>/"']++=(?:"[^"\r\n]*+"|'[^'\r\n]*+'))*+(?:>| ?/>)""")
"""A start tag that is laid out already."""
_TAGS = frozenset({TokenKind.START, TokenKind.EMPTY})
_MJCF = frozenset({"mujoco", "mujocoinclude"})
"""The roots of MJCF, and of files that MJCF includes."""
_BETWEEN = frozenset({TokenKind.BLANK, TokenKind.COMMENT})


@dataclass(frozen=True, slots=True)
class FormatOptions:
    """How a text is formatted; `indent` stands once for each level."""

    indent: str = "  "
    numbers: Literal["kept", "shortest"] = "kept"
    sort_attributes: bool = False


def format_text(source: SourceText, options: FormatOptions) -> SourceText:
    """Return the file with its text formatted.

    Raises:
        UnplacedError: the text is not well-formed, or has a document type declaration.
    """
    tokens = Tokens(source.text)
    return source.with_text(_Formatting(tokens, options, _line_end(source.text)).run())


def _line_end(text: str) -> str:
    """Return the line end of the first line."""
    found = _LINE_END.search(text)
    return found.group() if found else "\n"


def _usage_of(tokens: Tokens) -> ModuleType:
    """Return the usage of names in the format of a text: in MJCF names of URDF and SDF have other attributes."""
    first = next((number for number, kind in enumerate(tokens.kinds) if kind in _TAGS), None)
    if first is None or name_of(tokens[first]) not in _MJCF:
        return name_usage
    from twinform.schemas.generated import mjcf_name_usage  # noqa: PLC0415 - few files are MJCF

    return mjcf_name_usage


class _Formatting:
    """One pass of the formatter over the tokens of a text."""

    def __init__(self, tokens: Tokens, options: FormatOptions, line_end: str) -> None:
        self.tokens, self.options, self.line_end = tokens, options, line_end
        self.fixed = _fixed_contents(tokens)
        self.out: list[str] = []
        self.asked = (0, False)
        self.keeps_tags = options.numbers == "kept" and not options.sort_attributes
        self.open: list[_OpenElement] = [_OpenElement("", opaque=False)]
        self.usage = _usage_of(tokens)

    def run(self) -> str:
        """Return the formatted text."""
        kinds, fixed, number = self.tokens.kinds, self.fixed, 0
        while number < len(kinds):
            kind = kinds[number]
            if kind in _TAGS:
                self._begin_line(number)
                self._start(number)
                if fixed[number]:
                    self._fixed(number, fixed[number])
                    number = fixed[number]
            elif kind == TokenKind.END:
                self._write_end_tag(number)
            elif kind == TokenKind.COMMENT:
                self._comment(number)
            elif kind == TokenKind.INSTRUCTION:
                self._begin_line(number)
                self.out.append(self.tokens[number])
            number += 1
        self.out.append(self.line_end)
        return "".join(self.out)

    def _start(self, number: int) -> None:
        text, around = self.tokens[number], self.open[-1]
        plain = _PLAIN.fullmatch(text) if self.keeps_tags else None
        self.out.append(text if plain else self._tag_text(number, self._tag(number)))
        around.row = number if self._is_row(number) else None
        if self.tokens.kinds[number] == TokenKind.START:
            name = plain[1] if plain else name_of(text)
            self.open.append(_OpenElement(name, opaque=around.opaque or name in self.usage.OPAQUE))

    def _write_end_tag(self, number: int) -> None:
        ended = self.open.pop()
        if not (ended.on_one_line and self._lines_before(number) == 0):
            self._begin_line(number)
        elif self.tokens.kinds[number - 1] == TokenKind.BLANK:
            self.out.append(self.tokens[number - 1])
        self.out.append(f"</{ended.name}>")

    def _fixed(self, number: int, end: int) -> None:
        """Write the content that stays as it is, and the end tag behind it."""
        begin = self.tokens.ends[number]
        text, ended = self.tokens.text[begin : self.tokens.start(end)], self.open.pop()
        is_leaf = end == number + 2 and self.tokens.kinds[number + 1] == TokenKind.TEXT
        if is_leaf and not ended.opaque and ended.name in self.usage.NUMERIC_TEXTS and all_numbers(text):
            text = self._moved(shortest(text) if self.options.numbers == "shortest" else text, number)
        self.out.append(f"{text}</{ended.name}>")

    def _comment(self, number: int) -> None:
        if self.out and self._lines_before(number) == 0 and self._ends_line(number):
            before = self.tokens[number - 1] if self.tokens.kinds[number - 1] == TokenKind.BLANK else ""
            self.out.append(before + self.tokens[number])
        else:
            self._begin_line(number)
            self.out.append(self._moved(self.tokens[number], number))

    def _ends_line(self, number: int) -> bool:
        """Tell whether no element follows a comment on its line."""
        if number >= self.asked[0]:
            self.asked = self._end_of_comments(number)
        return self.asked[1]

    def _end_of_comments(self, number: int) -> tuple[int, bool]:
        """Return the first token after a run of comments, and whether it ends their line or the element."""
        kinds = self.tokens.kinds
        for here in range(number, len(kinds)):
            if kinds[here] == TokenKind.BLANK:
                if _LINE_END.search(self.tokens[here]):
                    return here, True
            elif kinds[here] != TokenKind.COMMENT:
                return here, kinds[here] == TokenKind.END
        return len(kinds), True

    def _begin_line(self, number: int) -> None:
        """Begin the line of a token, after as many blank lines as it had, up to a limit."""
        self.open[-1].on_one_line = False
        if self.out:
            lines = min(max(self._lines_before(number), 1), _MOST_LINE_ENDS)
            self.out.append(self.line_end * lines + self._indent)

    @property
    def _indent(self) -> str:
        return self.options.indent * (len(self.open) - 1)

    def _lines_before(self, number: int) -> int:
        if not number or self.tokens.kinds[number - 1] != TokenKind.BLANK:
            return 0
        return len(_LINE_END.findall(self.tokens[number - 1]))

    def _moved(self, text: str, number: int) -> str:
        """Indent the lines of a text anew, as far as they were indented at least as deep as its first one."""
        if "\n" not in text:
            return text
        old, new = self._old_indent(number), self._indent
        return text if old in {None, new} else re.sub(rf"\n{old}(?![\r\n])", lambda _: f"\n{new}", text)

    def _old_indent(self, number: int) -> str | None:
        """Return the blanks before a token that begins its line; None for all others."""
        if not number:
            return ""
        before = self.tokens[number - 1]
        is_blank = self.tokens.kinds[number - 1] == TokenKind.BLANK
        return _LINE_END.split(before)[-1] if is_blank and _LINE_END.search(before) else None

    def _tag(self, number: int) -> StartTag:
        """Parse a start tag, with its attributes sorted and its numbers shortened where the options ask for it."""
        tag, options = StartTag.of(self.tokens[number]), self.options
        if options.sort_attributes:
            tag = tag.sorted_by([rank(self.usage.ORDER.get(tag.name, ()), each.name) for each in tag.attributes])
        if options.numbers == "shortest" and not self.open[-1].opaque:
            numeric = self.usage.NUMERIC_ATTRIBUTES.get(tag.name, ())
            tag = tag.with_values(lambda name, value: shortest(value) if name in numeric else value)
        return tag

    def _tag_text(self, number: int, tag: StartTag) -> str:
        if tag.is_broken:
            return tag.on_lines(self.line_end + self._indent, self.options.indent, self._column(number))
        is_wide = _WIDE.search(self.tokens[number]) is not None
        return tag.on_one_line(keep_gaps=is_wide and self._is_in_table(number, tag))

    def _is_in_table(self, number: int, tag: StartTag) -> bool:
        """Tell whether the attributes of a tag are aligned with the element before or after it."""
        neighbors = (self.open[-1].row, self._next_row(number)) if self._is_row(number) else ()
        return any(each is not None and tag.is_aligned_with(self._tag(each)) for each in neighbors)

    def _is_row(self, number: int) -> bool:
        """Tell whether an element has no child elements."""
        return self._end_of_row(number) is not None

    def _end_of_row(self, number: int) -> int | None:
        kinds = self.tokens.kinds
        if kinds[number] == TokenKind.EMPTY:
            return number
        end = number + 1 if kinds[number + 1] == TokenKind.END else number + 2
        return end if kinds[end] == TokenKind.END and kinds[number + 1] != TokenKind.COMMENT else None

    def _next_row(self, number: int) -> int | None:
        kinds, here = self.tokens.kinds, (self._end_of_row(number) or number) + 1
        while here < len(kinds) and kinds[here] in _BETWEEN:
            here += 1
        is_tag = here < len(kinds) and kinds[here] in _TAGS
        return here if is_tag and self._is_row(here) else None

    @cached_property
    def lines(self) -> Lines:
        """The lines of the text."""
        return Lines(self.tokens.text)

    def _column(self, number: int) -> int:
        """Return the column, from 0, at which a token stood."""
        start = self.tokens.start(number)
        line = start - self.lines.place(start).column + 1
        return len(self.tokens.text[line:start].expandtabs(TAB))


def _fixed_contents(tokens: Tokens) -> "array[int]":
    """Return, for each start tag whose content must stay, the number of its end tag, and 0 for all other tokens."""
    fixed = array("q", bytes(8 * len(tokens)))
    open_tags: list[int] = []
    is_fixed: list[bool] = []
    may_preserve = "xml:space" in tokens.text
    for number, kind in enumerate(tokens.kinds):
        if kind == TokenKind.START:
            open_tags.append(number)
            is_fixed.append(may_preserve and _PRESERVED.search(tokens[number]) is not None)
        elif kind == TokenKind.TEXT:
            is_fixed[-1] = True
        elif kind == TokenKind.END:
            start = open_tags.pop()
            if is_fixed.pop() or _has_blanks_only(tokens, start, number):
                fixed[start] = number
    return fixed


def _has_blanks_only(tokens: Tokens, start: int, end: int) -> bool:
    """Tell whether an element holds blanks on one line and nothing else: somebody may want them."""
    return end == start + 2 and tokens.kinds[start + 1] == TokenKind.BLANK and not _LINE_END.search(tokens[start + 1])


@dataclass(slots=True)
class _OpenElement:
    """An element whose end tag has not come yet.

    `row` is its last child if that has no elements in it; `on_one_line` that nothing in it has begun a line.
    """

    name: str
    opaque: bool
    row: int | None = None
    on_one_line: bool = True
