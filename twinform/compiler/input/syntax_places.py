"""Finds the piece of the text that is wrong in an XML syntax error, and says in plain words what is wrong with it.

libxml2 reports how far it had read: behind a name that it does not know, or at the end of the file for a comment that
is never closed. Its name for the error tells which piece before that is meant.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from twinform.compiler.input.xml_recovery import REPAIRS, XmlError
from twinform.diagnostics import Location, Span, nearest_name
from twinform.lazy import lazy_pattern
from twinform.text import Lines, SourceText
from twinform.text.tokens import COMMENT, INSTRUCTION, SECTION

_WORDS: Mapping[str, str] = {
    "ERR_TAG_NAME_MISMATCH": r"and (?P<word>\S+)$",
    "ERR_ATTRIBUTE_REDEFINED": r"Attribute (?P<word>\S+) redefined",
    "ERR_ATTRIBUTE_WITHOUT_VALUE": r"for attribute (?P<word>\S+)$",
    "NS_ERR_UNDEFINED_NAMESPACE": r"prefix (?P<prefix>\S+) (?:for (?P<word>\S+) )?on (?P<tag>\S+) is",
}
"""For errors whose message names the piece: how to find the name in it."""
_BEFORE: Mapping[str, str] = {
    "ERR_TAG_NAME_MISMATCH": r"</\s*(?P<piece>{word})",
    "ERR_ATTRIBUTE_REDEFINED": r"\s(?P<piece>{word})\s*=",
    "ERR_ATTRIBUTE_WITHOUT_VALUE": r"\s(?P<piece>{word})",
    "ERR_RESERVED_XML_NAME": r"(?P<piece><\?xml)",
    "ERR_VERSION_MISSING": r"(?P<piece><\?xml)",
    "ERR_UNKNOWN_VERSION": r"version\s*=\s*[\"'](?P<piece>[^\"']*)",
    "ERR_UNDECLARED_ENTITY": r"(?P<piece>&[^\s;&]*;)",
    "ERR_CDATA_NOT_FINISHED": r"(?P<piece><!\[CDATA\[)",
    "NS_ERR_QNAME": r"<(?P<piece>[\w.-]+::)",
    "ERR_ATTRIBUTE_NOT_FINISHED": r"\s(?P<piece>[^\s=<>\"']+\s*=\s*[\"'])",
}
"""The form of the piece, which is the last one before the place that libxml2 reports."""
# So the line of some findings is an earlier one than that of other tools, which report where the
# parser noticed.
_NEAR = 300
_HERE = lazy_pattern(r"</?[\w:.-]+|--|[\w:.-]+|\S")
"""The piece at the place that libxml2 reports, for all other errors."""
_DOCTYPE = lazy_pattern(rf"(?:\s++|{COMMENT}|{INSTRUCTION})*+(?P<piece><!DOCTYPE)")
_OPEN_TAG = lazy_pattern(r"</?(?P<piece>[\w:.-]+)")
_OPEN_ATTRIBUTE = lazy_pattern(r"\s(?P<piece>[^\s=<>\"']+\s*=)")
_NAME_CHARACTER = lazy_pattern(r"[\w.-]")
_INSTRUCTION = lazy_pattern(r"<\?[\w-]*")
_OPEN_VALUE = lazy_pattern(r"\s(?P<piece>[^\s=<>\"']+\s*=\s*[\"'])")


class SyntaxPlaces:
    """Finds the wrong pieces of one text."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._text = _decode(data)
        self._lines = Lines(self._text or "")
        # libxml2 ends lines at line feeds only
        self._starts = [0, *(found.end() for found in re.finditer("\n", self._text or ""))]

    def location(self, error: XmlError, path: str = "/") -> Location:
        """Return the location of an error; without a column where it is not known."""
        if self._text is None:
            return self._first_undecodable(error, path)
        span = self._find_piece(error, self._text)
        return self.at(span, path) if span else Location(line=error.line, path=path)

    def described(self, error: XmlError) -> XmlError:
        """Return the error with words for people who do not know the parser."""
        offset = self._offset(error)
        return error if offset is None or self._text is None else described(error, self._text, offset)

    def at(self, span: Span, path: str = "/") -> Location:
        """Return the location of a piece."""
        (line, column), (end_line, end_column) = self._lines.place(span.start), self._lines.place(span.end)
        return Location("", line, path, column, end_line, end_column)

    def doctype(self) -> Location:
        """Return the location of the document type declaration."""
        found = _DOCTYPE.match(self._text or "")
        return self.at(Span(*found.span("piece"))) if found else Location(line=1, path="/")

    def _find_piece(self, error: XmlError, text: str) -> Span | None:
        offset = self._offset(error)
        if offset is None:
            return None
        instruction = _open_instruction(error, text, offset)
        if instruction is not None:
            return Span(*instruction.span())
        if error.kind == "ERR_ATTRIBUTE_NOT_STARTED" and not _NAME_CHARACTER.match(text, offset):
            return _last_before(_OPEN_ATTRIBUTE, text, offset)
        if error.kind == "ERR_TAG_NOT_FINISHED":
            return _start_of_element(error, text, self._starts)
        if error.kind == "ERR_LT_IN_ATTRIBUTE":
            return _unclosed_value(text, offset)
        if error.kind == "ERR_NAME_REQUIRED":
            return _piece_without_name(text, offset)
        if error.kind == "ERR_COMMENT_NOT_FINISHED":
            start = text.find("<!--", text.rfind("-->") + 1)
            return Span(start, start + len("<!--")) if start >= 0 else None
        if error.kind == "ERR_GT_REQUIRED" and text[offset : offset + 1] == "<":
            return _last_before(_OPEN_TAG, text, offset - 1)
        pattern = _pattern_of_piece(error)
        if pattern is not None:
            return _last_before(re.compile(pattern), text, offset)
        here = _HERE.match(text, offset)
        return Span(*here.span()) if here else Span(offset, offset)

    def _offset(self, error: XmlError) -> int | None:
        """Return the offset that libxml2 reports; None if there is none."""
        if self._text is None or not 0 < error.line <= len(self._starts):
            return None
        offset = self._starts[error.line - 1] + max(0, error.column - 1)
        return offset if offset <= len(self._text) else None

    def _first_undecodable(self, error: XmlError, path: str) -> Location:
        """Return the location of the first byte that is not UTF-8, where it is on the line of the error."""
        if error.kind != "ERR_INVALID_ENCODING" or b"\0" in self._data:
            return Location(line=error.line, path=path)
        try:
            self._data.decode()
        except UnicodeDecodeError as wrong:
            start = self._data.rfind(b"\n", 0, wrong.start) + 1
            line = self._data.count(b"\n", 0, start) + 1
            column = len(self._data[start : wrong.start].decode()) + 1
            if line == error.line:
                return Location("", line, path, column, line, column + 1)
        return Location(line=error.line, path=path)


def _decode(data: bytes) -> str | None:
    try:
        return SourceText.of(data).text
    except ValueError:
        return None


def _pattern_of_piece(error: XmlError) -> str | None:
    found = re.search(_WORDS[error.kind], error.message) if error.kind in _WORDS else None
    if error.kind == "NS_ERR_UNDEFINED_NAMESPACE":
        if found is None:
            return None
        prefix, word, tag = (re.escape(each or "") for each in found.group("prefix", "word", "tag"))
        return rf"\s(?P<piece>{prefix}:{word})\s*=" if word else rf"<(?P<piece>{prefix}:{tag})(?=[\s/>])"
    pattern = _BEFORE.get(error.kind)
    if pattern is None or (found is None and error.kind in _WORDS):
        return None
    return pattern.replace("{word}", re.escape(found["word"])) if found else pattern


def _start_of_element(error: XmlError, text: str, starts: Sequence[int]) -> Span | None:
    """Return the name of an element that is never closed."""
    found = re.search(r"tag (?P<tag>\S+) line (?P<line>\d+)$", error.message)
    if found is None or not 0 < int(found["line"]) <= len(starts):
        return None
    # The line is that on which the start tag ends.
    start = starts[int(found["line"])] if int(found["line"]) < len(starts) else len(text)
    return _last_before(re.compile(rf"<(?P<piece>{re.escape(found['tag'])})(?=[\s/>])"), text, start)


def _last_before(pattern: re.Pattern[str], text: str, end: int) -> Span | None:
    """Return the last piece of a form before an offset, which is near it unless something was never closed."""
    for start in (max(0, end - _NEAR), max(0, end - 10_000), 0):
        found = list(pattern.finditer(text, start, end + 1))
        if found:
            return Span(*found[-1].span("piece"))
    return None


def _open_instruction(error: XmlError, text: str, offset: int) -> re.Match[str] | None:
    """Find the beginning of the declaration or instruction that an error is in, or behind if it is never closed."""
    start = text.rfind("<?", 0, offset + 1) if error.kind not in REPAIRS else -1
    return _INSTRUCTION.match(text, start) if start >= 0 and text.find("?>", start, offset) < 0 else None


def _unclosed_value(text: str, offset: int) -> Span | None:
    """Return a `<` in a value, or the beginning of a value that goes on over lines: its quotes are not closed."""
    opened = _last_before(_OPEN_VALUE, text, offset)
    if opened is not None and "\n" in text[opened.end : offset]:
        return opened
    return Span(offset, offset + 1) if text[offset : offset + 1] == "<" else None


def _piece_without_name(text: str, offset: int) -> Span | None:
    """Return a `&` or `<` without a name, or a tag that is not closed before the next one begins."""
    if text[offset - 1 : offset] in {"&", "<"}:
        return Span(offset - 1, offset)
    if text[offset : offset + 1] == "<":
        return _last_before(_OPEN_TAG, text, offset - 1)
    return Span(offset, min(offset + 1, len(text)))


_READ_BEFORE = 2000
"""So many characters before an error are searched for the tag that it is in."""
_TAG = lazy_pattern(r"<(/?[\w:.-]+)")
_ATTRIBUTE = lazy_pattern(r"(?<![\w:.-])([\w:.-]++)\s*+=\s*+[\"']?")
_TAGS = lazy_pattern(rf"{COMMENT}|{INSTRUCTION}|{SECTION}|<(?P<end>/?)(?P<name>[^\s<>/!?]++)(?P<rest>[^<>]*+)>")
_MISMATCH = lazy_pattern(r"(?<!\S)(?P<open>\S++) line (?P<line>\d++) and (?P<close>\S++)$")
_IN_TAG = lazy_pattern(r"in [Tt]ag (?P<tag>\S+) line (?P<line>\d+)|Start Tag (?P<start>\S+) line (?P<at>\d+)")
_PREFIX = lazy_pattern(r"prefix (?P<prefix>\S+) (?:for (?P<word>\S+) )?on (?P<tag>\S+) is")
_QUOTED = lazy_pattern(r"'([^']*)'")


class _Site(NamedTuple):
    """A syntax error in a text, and the offset that libxml2 reports."""

    error: XmlError
    text: str
    offset: int

    @property
    def tag(self) -> str:
        """The tag around the error, such as `<link>`."""
        found = _last(_TAG, self.before)
        return f"<{found[1]}>" if found else "the tag"

    @property
    def attribute(self) -> str:
        """The attribute before the error."""
        found = _last(_ATTRIBUTE, self.before)
        return found[1] if found else "the attribute"

    @property
    def before(self) -> str:
        """The text before the error."""
        return self.text[max(0, self.offset - _READ_BEFORE) : self.offset]

    @property
    def here(self) -> str:
        """The character at which libxml2 stopped."""
        return self.text[self.offset : self.offset + 1]


# libxml2 has one name for several mistakes, which different things help against.
_ADVICE = {
    r" needs > or />": "close the tag with >, or with /> if nothing is in it",
    r" ends nothing: ": "delete it, or write the start tag that is missing before it",
    r"</\S+ ends the <(\S+)> of line \d+$": r"write </\1>",
    r"/ of line \d+ needs >$": "write > behind the /",
    r"no name follows (?:<|')\S+:": "write the name behind the colon",
    r"the file ends before its first tag$": "write <robot> or <sdf> with the model in it",
    r"^<(\S+)> of line \d+ is not closed before (\S+)$": r"write </\1> before this \2",
    r" has no closing quote": "close the quotes; a '<' that is meant is written &lt;",
}


def described(error: XmlError, text: str, offset: int) -> XmlError:
    """Say what is wrong and what helps; in libxml2's words where it is seldom wrong in a model."""
    instruction = _open_instruction(error, text, offset)
    if instruction is not None:
        return _describe_instruction(error, text, instruction)
    words = _IN_PLAIN_WORDS.get(error.kind)
    said = words if isinstance(words, str) else words(_Site(error, text, offset)) if words else ""
    advice = (found.expand(text) for pattern, text in _ADVICE.items() if (found := re.search(pattern, said)))
    is_cut = "was cut off" in (error.help or "")
    return error._replace(message=said or error.message, help=error.help if is_cut else next(advice, error.help))


def _describe_instruction(error: XmlError, text: str, found: re.Match[str]) -> XmlError:
    line = text.count("\n", 0, found.start()) + 1
    if text[: found.start()].strip("\ufeff \t\r\n"):
        return error._replace(message=f"{found[0]} of line {line} is never closed", help="close it with ?>")
    message = f"the declaration {found[0]} of line {line} is not complete"
    return error._replace(message=message, help="write <?xml version='1.0'?>")


def _last(pattern: re.Pattern[str], text: str) -> re.Match[str] | None:
    return max(pattern.finditer(text), key=lambda found: found.start(), default=None)


def _no_quotes(site: _Site) -> str:
    return f"the value of {site.attribute!r} in {site.tag} has no quotes"


def _open_quote(site: _Site) -> str:
    return f"the value of {site.attribute!r} in {site.tag} has no closing quote"


def _bracket_in_value(site: _Site) -> str:
    value = site.before[max(site.before.rfind('="'), site.before.rfind("='")) + 2 :]
    if "\n" in value or ">" in value or value.endswith("="):
        return _open_quote(site)
    return f"'<' stands in the value of {site.attribute!r} in {site.tag}"


def _no_value(site: _Site) -> str:
    name = site.error.message.rpartition(" ")[2]
    return f"the attribute {name!r} of {site.tag} has no value"


def _attribute_twice(site: _Site) -> str:
    found = re.search(r"Attribute (\S+) redefined", site.error.message)
    return f"{site.tag} has the attribute {found[1]!r} twice" if found else ""


def _no_blank(site: _Site) -> str:
    """Tell a quote that is missing from a blank, and both from a tag that is not closed."""
    if site.here in {"<", "", "/"}:
        return _open_tag(site)
    value = _last(re.compile(r"""(?<![\w:.-])[\w:.-]++\s*+=\s*+(?:"([^"]*+)"|'([^']*+)')"""), site.before)
    if value and (value[1] or value[2] or "").rstrip().endswith("="):
        name = re.match(r"[\w:.-]+", value[0])
        return f"the value of {name[0]!r} in {site.tag} has no closing quote" if name else ""
    if re.match(r"[\w:]", site.here):
        return f"there is no blank between two attributes of {site.tag}, or a value lacks its closing quote"
    return f"{site.here!r} stands behind an attribute of {site.tag}"


def _open_tag(site: _Site) -> str:
    found = _last(_TAG, site.before)
    if found is None:
        return ""
    name = found[1]
    start = max(0, site.offset - _READ_BEFORE) + found.start()
    line = site.text.count("\n", 0, start) + 1
    if site.here == "/":
        return f"<{name}/ of line {line} needs >"
    needs = ">" if name.startswith("/") else "> or />"
    return f"<{name} of line {line} needs {needs}"


def _no_name(site: _Site) -> str:
    if site.error.message.startswith("xmlParseEntityRef"):
        return "'&' is written &amp; in XML"
    if not site.error.message.startswith("error parsing attribute name"):
        return _nameless(site)
    return _open_tag(site) if site.here in {"<", ""} else f"{site.here!r} stands where {site.tag} can have an attribute"


def _nameless(site: _Site) -> str:
    before = site.text[: site.offset]
    around = _open_elements(f"{before}x>")
    place = f" in <{around[-1]}>" if around else ""
    return f"no name follows the '<' of line {before.count(chr(10)) + 1}{place}"


def _no_local_name(site: _Site) -> str:
    found = _QUOTED.search(site.error.message)
    prefix = found[1] if found else ""
    if not prefix.endswith(":"):
        return ""
    line = site.text.count("\n", 0, site.offset) + 1
    is_tag = site.before.rstrip().endswith((f"<{prefix}", f"</{prefix}"))
    return f"no name follows <{prefix} of line {line}" if is_tag else f"no name follows {prefix!r} in {site.tag}"


def _no_element(site: _Site) -> str:
    if site.text[site.offset :].strip():
        return "the file does not begin with a tag"
    return "the file ends before its first tag"


def _mismatch(site: _Site) -> str:
    """Tell an end tag with a typo from one that is missing, and from one too many."""
    found = _MISMATCH.search(site.error.message)
    if found is None:
        return ""
    line = found["line"]
    around = _open_elements(site.text[: site.offset])
    # libxml2 leaves the prefixes out.
    opened = around[-1] if around and around[-1].endswith(found["open"]) else found["open"]
    end = _last(_TAG, site.before)
    closed = end[1].lstrip("/") if end and end[1].endswith(found["close"]) else found["close"]
    if closed in around[:-1]:
        return f"<{opened}> of line {line} is not closed before </{closed}>"
    if nearest_name(closed, [opened]):
        return f"</{closed}> ends the <{opened}> of line {line}"
    return f"</{closed}> ends nothing: <{opened}> of line {line} is open here"


def _open_elements(text: str) -> list[str]:
    """List the elements that are open at the last tag of a text, which does not count."""
    stack: list[str] = []
    tags = [found for found in _TAGS.finditer(text) if found["name"]]
    for found in tags[:-1]:
        if not found["end"] and not found["rest"].endswith("/"):
            stack.append(found["name"])
        elif found["end"] and stack:
            stack.pop()
    return stack


def _never_closed(site: _Site) -> str:
    found = _IN_TAG.search(site.error.message)
    return f"<{found['tag']}> of line {found['line']} is never closed" if found else ""


def _unfinished_tag(site: _Site) -> str:
    found = _IN_TAG.search(site.error.message)
    return f"<{found['start']} of line {found['at']} needs > or />" if found else _open_tag(site)


def _unknown_prefix(site: _Site) -> str:
    found = _PREFIX.search(site.error.message)
    if found is None:
        return ""
    prefix, word, tag = found.group("prefix", "word", "tag")
    place = f"the attribute {prefix}:{word}" if word else f"<{prefix}:{tag}>"
    return f"the prefix {prefix!r} of {place} is not declared"


def _with_quoted(words: str) -> Callable[[_Site], str]:
    """Make words in which a brace stands for what libxml2's message quotes."""

    def say(site: _Site) -> str:
        found = _QUOTED.search(site.error.message)
        return words.format(found[1]) if found else ""

    return say


_IN_PLAIN_WORDS: Mapping[str, str | Callable[[_Site], str]] = {
    "ERR_ATTRIBUTE_NOT_STARTED": _no_quotes,
    "ERR_ATTRIBUTE_NOT_FINISHED": _open_quote,
    "ERR_LT_IN_ATTRIBUTE": _bracket_in_value,
    "ERR_ATTRIBUTE_WITHOUT_VALUE": _no_value,
    "ERR_ATTRIBUTE_REDEFINED": _attribute_twice,
    "ERR_SPACE_REQUIRED": _no_blank,
    "ERR_GT_REQUIRED": _unfinished_tag,
    "ERR_NAME_REQUIRED": _no_name,
    "ERR_TAG_NAME_MISMATCH": _mismatch,
    "ERR_TAG_NOT_FINISHED": _never_closed,
    "ERR_UNDECLARED_ENTITY": _with_quoted("&{}; is not known to XML"),
    "ERR_COMMENT_NOT_FINISHED": "the comment that begins here is never closed",
    "ERR_CDATA_NOT_FINISHED": "the CDATA section that begins here is never closed",
    "ERR_DOCUMENT_EMPTY": _no_element,
    "NS_ERR_QNAME": _no_local_name,
    "ERR_DOCUMENT_END": "something follows the end tag of the root element",
    "ERR_INVALID_CHAR": "a control character stands here",
    "ERR_RESERVED_XML_NAME": "<?xml ...?> does not stand at the very beginning of the file",
    "ERR_UNKNOWN_VERSION": _with_quoted("there is no version {!r} of XML"),
    "ERR_VERSION_MISSING": "<?xml ...?> has no version",
    "ERR_HYPHEN_IN_COMMENT": "'--' stands inside a comment",
    "NS_ERR_UNDEFINED_NAMESPACE": _unknown_prefix,
}
