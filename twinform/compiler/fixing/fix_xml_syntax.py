"""Fixes of XML that is not well-formed: declarations, comments, prefixes, quotes, ampersands, end tags."""

import html
import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import NamedTuple

from lxml import etree

from twinform.compiler.fixing.site import FixableFile, TextFixers, safe, unsafe
from twinform.compiler.input.parsing import has_unread_numbers
from twinform.compiler.input.xml_recovery import REPAIRS
from twinform.diagnostics import Diagnostic, Fix, Span, TextEdit, nearest_name, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import usual_namespace
from twinform.text.tokens import COMMENT, IN_COMMENT, INSTRUCTION, SECTION

_COMMENT = lazy_pattern(rf"<!--(?P<inside>{IN_COMMENT})(?:-->)?")
_ASIDE = lazy_pattern(f"{COMMENT}|{SECTION}|{INSTRUCTION}")
_DECLARATION = lazy_pattern(r"<\?xml\s[^<>]*+(?<=\?)>", re.IGNORECASE)
_VERSION = lazy_pattern(r"""(?<=\s)version\s*=\s*(?:"[^"]*"|'[^']*')""")
_VERSION_TYPO = lazy_pattern(r"(?<=\s)ver[a-z]*(?=\s*=)")
_ENCODING = lazy_pattern(r"""encoding\s*=\s*["']([^"']*)["']""")
_HYPHENS = lazy_pattern(r"-{2,}")
_LOST = lazy_pattern(r"\s*(?=\?xml\s)")
_PREFIX = lazy_pattern(r"the prefix '(?P<prefix>[\w.-]+)' of ")
_TAG = lazy_pattern(r"</?[A-Za-z_][\w.-]*::[A-Za-z_]")
_ROOT = lazy_pattern(r"<[A-Za-z_][\w:.-]*")
_BARE_AMPERSAND = lazy_pattern(r"&(?!#\d+;|#x[0-9A-Fa-f]+;|[A-Za-z_][\w.-]*;)")
_ENTITY = lazy_pattern(r"&(?P<name>[A-Za-z]\w*);")
_OF_XML = frozenset({"lt", "gt", "amp", "apos", "quot"})
_UNQUOTED = lazy_pattern(r"""(?P<before>\s[\w:.-]+\s*=\s*)(?P<value>[^\s"'<>=/]+)(?=[\s/>])""")
_MISMATCH = lazy_pattern(r"Opening and ending tag mismatch: (?P<open>\S+) line \d+ and (?P<close>\S+)")
_NO_BLANK = lazy_pattern(r"""(?<==)\s*(?P<value>"[^"<]*"|'[^'<]*')(?=[A-Za-z_])""")
_CONTROL = lazy_pattern(r"[\x00-\x08\x0b\x0c\x0e-\x1f]")
_DOCTYPE = lazy_pattern(r"<!DOCTYPE\s+\w+\s*>\s*", re.IGNORECASE)
_SURE = 0.7
# The most namespaces of a root to which more are added. libxml2 names a hundred prefixes at a time;
# real files have 16.
_MOST_DECLARED = 100


def _in_markup(pattern: re.Pattern[str], text: str) -> Iterator[re.Match[str]]:
    """Yield the matches of a pattern outside of comments, sections and instructions."""
    return _outside(_ASIDE, pattern, text)


def _outside(around: re.Pattern[str], pattern: re.Pattern[str], text: str) -> Iterator[re.Match[str]]:
    """Yield the matches of a pattern that do not begin inside a match of another one, in one pass over the text."""
    asides = (found.span() for found in around.finditer(text))
    start, end = next(asides, (len(text), len(text)))
    for found in pattern.finditer(text):
        while end <= found.start() and start < len(text):
            start, end = next(asides, (len(text), len(text)))
        if found.start() < start:
            yield found


def _repaired_xml(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Write what parsers of ROS and Gazebo accept as correct XML."""
    text, way = file.text, finding.help or ""
    for type_name, help_ in REPAIRS.items():
        if help_ == way and type_name in _OF_REPAIRS:
            return _OF_REPAIRS[type_name](finding, file)
    lost = _LOST.match(text)
    if lost and "'<'" in finding.message:
        return safe("Write the '<' of <?xml", TextEdit(Span(lost.end(), lost.end()), "<"))
    if "two colons" in finding.message:
        return _single_colons(file)
    return None


def _version(_: Diagnostic, file: FixableFile) -> Fix | None:
    text = file.text
    declaration = _DECLARATION.search(text)
    if declaration is None:
        return None
    inside = _VERSION.search(declaration[0])
    typo = _VERSION_TYPO.search(declaration[0])
    if inside is None and typo:
        span = Span(declaration.start() + typo.start(), declaration.start() + typo.end())
        return safe("Write version", TextEdit(span, "version"))
    if inside is None:
        at = declaration.start() + len("<?xml")
        return safe('Write version="1.0"', TextEdit(Span(at, at), ' version="1.0"'))
    span = Span(declaration.start() + inside.start(), declaration.start() + inside.end())
    return safe('Write version="1.0"', TextEdit(span, 'version="1.0"'))


def _late_declaration(_: Diagnostic, file: FixableFile) -> Fix | None:
    """Fix a late declaration, in the same way for each finding of the file."""
    if "late declaration" not in file.memo:
        file.memo["late declaration"] = _move_declaration(file.text)
    return file.memo["late declaration"]


def _move_declaration(text: str) -> Fix | None:
    """Move the first late declaration to the beginning, or delete it where one stands there already."""
    found = [*_outside(_COMMENT, _DECLARATION, text)]
    late = [each for each in found if each.start()]
    if not late:
        return None
    end = late[0].end()
    while end < len(text) and text[end] in " \t\r":
        end += 1
    whole = Span(late[0].start(), end + 1 if text[end : end + 1] == "\n" else late[0].end())
    if len(found) > len(late) or len(late) > 1:
        return safe("Delete the second <?xml ...?>", TextEdit(whole, ""))
    encoding = _ENCODING.search(late[0][0])
    if encoding and encoding[1].lower() != "utf-8":  # nobody has minded it; at the beginning it would count
        return safe("Delete the late <?xml ...?>", TextEdit(whole, ""))
    if not text[: late[0].start()].strip():
        return safe("Move <?xml ...?> to the beginning", TextEdit(Span(0, late[0].start()), ""))
    begin = TextEdit(Span(0, 0), late[0][0] + ("\r\n" if "\r\n" in text else "\n"))
    return safe("Move <?xml ...?> to the beginning", begin, TextEdit(whole, ""))


def _hyphens(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Separate the hyphens in the comment that ends on the line of the finding, or is around it."""
    if "comments" not in file.memo:
        file.memo["comments"] = _comments_by_line(file)
    return file.memo["comments"].get(finding.location.line)


def _comments_by_line(file: FixableFile) -> dict[int, Fix]:
    """Return the fix that separates the hyphens of the first comment with some on each line."""
    found: dict[int, Fix] = {}
    for comment in _COMMENT.finditer(file.text):
        inside, start = comment["inside"], comment.start("inside")
        edits = [
            TextEdit(Span(start + run.start(), start + run.end()), " ".join(run[0]))
            for run in _HYPHENS.finditer(inside)
        ]
        if inside.endswith("-"):
            edits.append(TextEdit(Span(start + len(inside), start + len(inside)), " "))
        if edits:
            first, last = (file.lines.place(offset).line for offset in (comment.start(), comment.end() - 1))
            fix = safe("Put blanks between the hyphens of the comment", *edits)
            found.update((line, fix) for line in range(first, last + 1) if line not in found)
    return found


def _prefix(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Declare the prefix on the root element."""
    found = _PREFIX.search(finding.message)
    if found is None or file.text.count("xmlns:") >= _MOST_DECLARED:
        return None
    prefix = found["prefix"]
    name, uri = f"xmlns:{prefix}", usual_namespace(prefix)
    title = f"Declare the prefix {prefix} on the root element"
    if file.parts is not None:
        return safe(title, file.edit.set_attribute(file.root, name, uri))
    root = next(_in_markup(_ROOT, file.text), None)
    return safe(title, TextEdit(Span(root.end(), root.end()), f' {name}="{uri}"')) if root else None


def _single_colons(file: FixableFile) -> Fix | None:
    if "colons" not in file.memo:
        tags = _in_markup(_TAG, file.text)
        edits = [TextEdit(Span(found.end() - 2, found.end() - 1), "") for found in tags]
        file.memo["colons"] = safe("Write one colon behind the prefix", *edits) if edits else None
    return file.memo["colons"]


_OF_REPAIRS: TextFixers = {
    "ERR_UNKNOWN_VERSION": _version,
    "ERR_VERSION_MISSING": _version,
    "ERR_HYPHEN_IN_COMMENT": _hyphens,
    "NS_ERR_UNDEFINED_NAMESPACE": _prefix,
    "ERR_RESERVED_XML_NAME": _late_declaration,
}


class _Broken(NamedTuple):
    """A text that is not well-formed, the line on which libxml2 stopped reading, and its message."""

    text: str
    line: Span
    message: str


def _not_well_formed(finding: Diagnostic, file: FixableFile) -> Fix | None:
    text = file.text
    if _PREFIX.search(finding.message):  # what is repaired elsewhere is refused by xacro
        return _prefix(finding, file)
    lines = file.lines
    number = finding.location.line
    if not 1 <= number <= len(lines):
        return None
    start = lines.start(number)
    end = lines.start(number + 1) if number < len(lines) else len(text)
    type_name, message = _first_break(file.source.data)
    broken = _Broken(text, Span(start, end), message)
    way = _OF_BREAKS.get(type_name)
    return way(broken) if way else None


def _first_break(data: bytes) -> tuple[str, str]:
    """Return libxml2's name for the first error that is not repaired, and its message."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, recover=True)
    with suppress(etree.XMLSyntaxError):
        etree.fromstring(data, parser)
    entries = ((entry.type_name, entry.message) for entry in parser.error_log if entry.type_name not in REPAIRS)
    return next(entries, ("", ""))


def _on_line(pattern: re.Pattern[str], broken: _Broken) -> Iterator[re.Match[str]]:
    for found in _in_markup(pattern, broken.text):
        if broken.line.start <= found.start() < broken.line.end:
            yield found


def _ampersands(broken: _Broken) -> Fix | None:
    edits = [TextEdit(Span(*found.span()), "&amp;") for found in _in_markup(_BARE_AMPERSAND, broken.text)]
    return safe("Write & as &amp;", *edits) if edits else None


def _entities(broken: _Broken) -> Fix | None:
    edits = [
        TextEdit(Span(*found.span()), html.unescape(found[0]))
        for found in _in_markup(_ENTITY, broken.text)
        if found["name"] not in _OF_XML and html.unescape(found[0]) != found[0]
    ]
    return safe("Write the characters themselves", *edits) if edits else None


def _quotes(broken: _Broken) -> Fix | None:
    edits = [TextEdit(Span(*found.span("value")), f'"{found["value"]}"') for found in _on_line(_UNQUOTED, broken)]
    return safe("Put the value in quotes", *edits) if edits else None


def _blank_between(broken: _Broken) -> Fix | None:
    edits = [TextEdit(Span(found.end(), found.end()), " ") for found in _on_line(_NO_BLANK, broken)]
    return safe("Put a blank between the attributes", *edits) if edits else None


def _end_tag(broken: _Broken) -> Fix | None:
    """Correct a typo in an end tag; a missing one may belong anywhere."""
    found = _MISMATCH.search(broken.message)
    if found is None or nearest_name(found["close"], [found["open"]], _SURE) is None:
        return None
    wrong = [*_on_line(re.compile(rf"(?<=</){re.escape(found['close'])}(?=\s*>)"), broken)]
    if len(wrong) != 1:
        return None
    return safe(f"Write </{found['open']}>", TextEdit(Span(*wrong[0].span()), found["open"]))


def _control(broken: _Broken) -> Fix | None:
    edits = [TextEdit(Span(*found.span()), "") for found in _CONTROL.finditer(broken.text)]
    return safe("Delete the control characters", *edits) if edits else None


def _attribute_twice(broken: _Broken) -> Fix | None:
    """Delete the second of two attributes of one name, which is safe where both have one value."""
    for tag in _on_line(re.compile(r"<[A-Za-z_][^<>]*>", re.DOTALL), broken._replace(line=_tag_line(broken))):
        seen: dict[str, str] = {}
        for found in re.finditer(r"""(?<!\s)\s++([\w:.-]++)\s*+=\s*+("[^"]*+"|'[^']*+')""", tag[0]):
            name, value = found[1], found[2][1:-1]
            edit = TextEdit(Span(tag.start() + found.start(), tag.start() + found.end()), "")
            if name in seen:
                make = safe if seen[name] == value else unsafe
                return make(f"Delete the second {name}", edit)
            seen[name] = value
    return None


def _tag_line(broken: _Broken) -> Span:
    """Return the line, extended to where its tag begins."""
    opened, closed = (broken.text.rfind(bracket, 0, broken.line.start) for bracket in "<>")
    return broken.line._replace(start=opened) if opened > closed else broken.line


def _open_hyphens(broken: _Broken) -> Fix | None:
    """Put a blank into `--->`, which does not end a comment."""
    ends = [each.end("inside") for each in _COMMENT.finditer(broken.text) if each["inside"].endswith("-")]
    edits = [TextEdit(Span(end, end), " ") for end in ends if broken.text.startswith("-->", end)]
    return safe("Put a blank before the end of the comment", *edits) if edits else None


_OF_BREAKS: Mapping[str, Callable[[_Broken], Fix | None]] = {
    "ERR_ATTRIBUTE_NOT_STARTED": _quotes,
    "ERR_ATTRIBUTE_REDEFINED": _attribute_twice,
    "ERR_COMMENT_NOT_FINISHED": _open_hyphens,
    "ERR_ENTITYREF_SEMICOL_MISSING": _ampersands,
    "ERR_INVALID_CHAR": _control,
    "ERR_NAME_REQUIRED": _ampersands,
    "ERR_SPACE_REQUIRED": _blank_between,
    "ERR_TAG_NAME_MISMATCH": _end_tag,
    "ERR_UNDECLARED_ENTITY": _entities,
}


def _doctype(_: Diagnostic, file: FixableFile) -> Fix | None:
    """Delete a DOCTYPE that declares nothing."""
    found = next(_in_markup(_DOCTYPE, file.text), None)
    return safe("Delete the DOCTYPE, which declares nothing", TextEdit(Span(*found.span()), "")) if found else None


def _tabbed_numbers(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Write single blanks between the numbers that begin on the line, and none around them."""
    if "tabbed" not in file.memo:
        file.memo["tabbed"] = _tabbed_fixes(file)
    return file.memo["tabbed"].get(finding.location.line)


def _tabbed_fixes(file: FixableFile) -> dict[int, Fix]:
    """Return a fix for all numbers that urdfdom does not read and that begin on a line, by line."""
    found: defaultdict[int, list[TextEdit]] = defaultdict(list)
    for name, attribute in (each for place in file.edit.places.values() for each in place.attributes.items()):
        value = attribute.value.of(file.text)
        if has_unread_numbers(name, value):
            line = file.lines.place(attribute.name.start).line
            found[line].append(TextEdit(attribute.value, " ".join(value.split())))
    return {line: safe("Put blanks between the numbers", *edits) for line, edits in found.items()}


def _old_root(_: Diagnostic, file: FixableFile) -> Fix | None:
    if file.parts is None:
        return None
    return safe("Call the root <sdf>", *file.edit.rename(file.root, "sdf"))


TEXT_FIXERS: TextFixers = {
    rules.DOCTYPE.name: _doctype,
    rules.NOT_WELL_FORMED.name: _not_well_formed,
    rules.OLD_ROOT.name: _old_root,
    rules.REPAIRED_XML.name: _repaired_xml,
    rules.TABBED_NUMBERS.name: _tabbed_numbers,
}
