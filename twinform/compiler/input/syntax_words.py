"""Says in plain words what is wrong in a text that is not XML, from libxml2's name for the error and its place."""

import re
from collections.abc import Callable, Mapping
from typing import NamedTuple

from twinform.compiler.input.xml_recovery import XmlError
from twinform.diagnostics import nearest_name
from twinform.lazy import lazy_pattern
from twinform.text.tokens import COMMENT, INSTRUCTION, SECTION

_NEAR = 2000
"""So many characters before an error are searched for the tag that it is in."""
_TAG = lazy_pattern(r"<(/?[\w:.-]+)")
_ATTRIBUTE = lazy_pattern(r"([\w:.-]+)\s*=\s*[\"']?")
_TAGS = lazy_pattern(rf"{COMMENT}|{INSTRUCTION}|{SECTION}|<(?P<end>/?)(?P<name>[^\s<>/!?]++)(?P<rest>[^<>]*+)>")
_MISMATCH = lazy_pattern(r"(?P<open>\S+) line (?P<line>\d+) and (?P<close>\S+)$")
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
        return self.text[max(0, self.offset - _NEAR) : self.offset]

    @property
    def here(self) -> str:
        """The character at which libxml2 stopped."""
        return self.text[self.offset : self.offset + 1]


# libxml2 has one name for several mistakes, which different things help against.
_ADVICE = {
    r" needs > or />": "close the tag with >, or with /> if nothing is in it",
    r" ends nothing: ": "delete it, or write the start tag that is missing before it",
    r"</\S+ ends the <(\S+)> of line \d+$": r"write </\1>",
    r"^<(\S+)> of line \d+ is not closed before (\S+)$": r"write </\1> before this \2",
    r" has no closing quote": "close the quotes; a '<' that is meant is written &lt;",
}


def described(error: XmlError, text: str, offset: int) -> XmlError:
    """Say what is wrong and what helps; in libxml2's words where it is seldom wrong in a model."""
    words = _WORDS.get(error.kind)
    said = words if isinstance(words, str) else words(_Site(error, text, offset)) if words else ""
    advice = (found.expand(text) for pattern, text in _ADVICE.items() if (found := re.search(pattern, said)))
    is_cut = "was cut off" in (error.help or "")
    return error._replace(message=said or error.message, help=error.help if is_cut else next(advice, error.help))


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
    if site.here in {"<", ""}:
        return _open_tag(site)
    value = _last(re.compile(r"""[\w:.-]+\s*=\s*(?:"([^"]*)"|'([^']*)')"""), site.before)
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
    start = max(0, site.offset - _NEAR) + found.start()
    line = site.text.count("\n", 0, start) + 1
    needs = ">" if name.startswith("/") else "> or />"
    return f"<{name} of line {line} needs {needs}"


def _no_name(site: _Site) -> str:
    if site.error.message.startswith("xmlParseEntityRef"):
        return "'&' is written &amp; in XML"
    if not site.error.message.startswith("error parsing attribute name"):
        return "no name follows '<'"
    return _open_tag(site) if site.here in {"<", ""} else f"{site.here!r} stands where {site.tag} can have an attribute"


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


_WORDS: Mapping[str, str | Callable[[_Site], str]] = {
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
    "ERR_DOCUMENT_END": "something follows the end tag of the root element",
    "ERR_INVALID_CHAR": "a control character stands here",
    "ERR_RESERVED_XML_NAME": "<?xml ...?> does not stand at the very beginning of the file",
    "ERR_UNKNOWN_VERSION": _with_quoted("there is no version {!r} of XML"),
    "ERR_VERSION_MISSING": "<?xml ...?> has no version",
    "ERR_HYPHEN_IN_COMMENT": "'--' stands inside a comment",
    "NS_ERR_UNDEFINED_NAMESPACE": _unknown_prefix,
}
