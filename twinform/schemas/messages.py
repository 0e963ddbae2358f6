"""Diagnostics of the reader: one function for each, apart from the hot path."""

from collections.abc import Collection, Sequence
from dataclasses import field
from typing import NamedTuple, TypedDict, Unpack

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, Rule, Severity, nearest_name, rules
from twinform.diagnostics.wording import cut
from twinform.ir.versions import Version, parse_version, print_version, versions_of
from twinform.schemas.facts import Fact
from twinform.schemas.hints import dialect_of, hint_for_attribute, hint_for_element, hint_for_word, new_holder, words_of
from twinform.schemas.xml import Places, XmlElement, path_of

_COLORS = frozenset({"color", "color4"})
_FREE_NUMBERS = frozenset({"slip1", "slip2"})
"""Numbers of SDF whose range its description does not have; libsdformat refuses the others, and no body is negative."""
_ESSENTIAL = frozenset({"parent", "child"})
"""Elements without which no reader, not even the most forgiving, makes sense of the file."""


_BEYOND_THE_XSD = frozenset(
    rule.name
    for rule in (
        rules.OUT_OF_RANGE,
        rules.DEPRECATED_ELEMENT,
        rules.DEFAULTED_ATTRIBUTE,
        rules.BLANK_VALUE,
    )
)
"""Findings that no XSD refuses a document for."""


class FindingDetails(TypedDict, total=False):
    """What a finding may say beside its message."""

    found: str | None
    expected: str | None
    help: str | None
    severity: Severity | None
    refused: bool


class StandIn(NamedTuple):
    """A field of a node with a value that is not in the file; `name` is that of the node, if it has one."""

    path: str
    field: str
    name: str


@dataclass(slots=True)
class Context:
    """One run of the reader over one document.

    `simple` is whether the XSD has accepted the document and no attribute has a namespace: then text is only where the
    facts have it, and an element that they give nothing but text has nothing else.

    `tolerated` holds the elements, and the attributes and texts of elements, that are reported and kept although the
    schema does not have them: the XSD validation sees the document without them. `#text` is the text in an element,
    `#tail` the one that follows it. `replaced` holds the syntax of other versions: the attribute or text that one is
    in, and a value for the validation in its place. `outside` lists elements and attributes of other versions. `aside`
    is true inside of what the readers of the robot itself skip: nothing there is an error. `declared` is whether the
    version is the file's own; where it is not, old syntax is nothing to warn of. `header` holds what the root
    element has about the document rather than about its node. `broken` is whether some node lacks what its class needs,
    so that the document is good for checks only; then there is a finding as well. `stand_ins` are the values that such
    nodes have instead, where they are no likely guesses. In a `partial` document, as a carrier is, nothing is missing.
    `keeps` is whether elements without a field are kept, and not only checked.
    """

    sink: DiagnosticSink
    file: str
    format: str
    version: Version
    tolerated: list[tuple[XmlElement, str | None]] = field(default_factory=list[tuple[XmlElement, str | None]])
    replaced: list[tuple[XmlElement, str, str]] = field(default_factory=list[tuple[XmlElement, str, str]])
    structural: int = 0
    simple: bool = False
    aside: bool = False
    declared: bool = True
    partial: bool = False
    keeps: bool = True
    outside: list[tuple[XmlElement, Fact]] = field(default_factory=list[tuple[XmlElement, Fact]])
    header: dict[str, object] = field(default_factory=dict[str, object])
    broken: bool = False
    stand_ins: list[StandIn] = field(default_factory=list[StandIn])
    places: Places = field(default_factory=dict[XmlElement, int], repr=False)

    def report(
        self, rule: Rule, element: XmlElement, message: str, step: str = "", **more: Unpack[FindingDetails]
    ) -> None:
        """Report at an element, or at a step below it."""
        if self.aside and rule.severity is Severity.ERROR and not self.sink.strict:
            more["severity"] = Severity.WARNING
        self.structural += rule.name not in _BEYOND_THE_XSD
        if not self.sink.takes(more.get("severity") or rule.severity_in(strict=self.sink.strict)):
            self.sink.left_out += 1
            return
        path = path_of(element, self.places) + (f"/{step}" if step else "")
        self.sink.report(rule, message, Location(self.file, element.sourceline or 0, path), **more)


def unknown_element(
    context: Context,
    element: XmlElement,
    known: Collection[str],
    attributes: Collection[str] = (),
    once: Collection[str] = (),
) -> None:
    """An element that no version has here; its parent may have the `known` ones, some only `once`, and attributes."""
    context.tolerated.append((element, None))
    name, around = str(element.tag), _around(element)
    context.report(
        rules.UNKNOWN_ELEMENT,
        element,
        f"<{name}> is not an element of {f'<{around[0]}>' if around else 'the document'}",
        found=name,
        help=hint_for_element(context.format, name, _free(element.getparent(), known, once), attributes, around)
        if _is_shown(context)
        else None,
        refused=_is_refused(context, around) and [name, *around] != ["body", "mujoco"],
    )


def _is_refused(context: Context, around: Sequence[str]) -> bool:
    """Tell whether the program that a file is for refuses what it does not know in these elements."""
    # MuJoCo does not look at what it knows nothing of in a frame or replicate, nor at bodies beside the world
    # (asked of 4.0.0). Other readers skip what they do not know.
    return context.format == "mjcf" and not _UNCHECKED.intersection(around)


_UNCHECKED = frozenset({"frame", "replicate"})


def knows_no_prefixes(context: Context, element: XmlElement) -> bool:
    """Tell whether a prefix makes no name an exception: MuJoCo takes one at the root alone (asked of 4.0.0)."""
    return context.format == "mjcf" and element.getparent() is not None


def _around(element: XmlElement) -> list[str]:
    """List the names of the elements around one, the nearest first."""
    return [str(each.tag) for each in element.iterancestors()]


def _free(parent: XmlElement | None, known: Collection[str], once: Collection[str]) -> Collection[str]:
    """Return the known children of an element without those that it has already and may have only once."""
    if parent is None or not once or len(parent) > _MOST_NEIGHBORS:
        return known
    taken = {str(each.tag) for each in parent}.intersection(once)
    return [name for name in known if name not in taken]


_MOST_NEIGHBORS = 200
"""In a hostile file a thousand unknown elements may stand beside a hundred thousand others."""


_LOCATIONS = frozenset({
    "{http://www.w3.org/2001/XMLSchema-instance}schemaLocation",
    "{http://www.w3.org/2001/XMLSchema-instance}noNamespaceSchemaLocation",
})  # fmt: skip
"""Where schemas are, which may stand at each element by the rules of XSD."""


def unknown_attribute(
    context: Context, element: XmlElement, name: str, known: Collection[str], children: Collection[str] = ()
) -> None:
    """An attribute that no version has here; the element may have the `known` ones, and children."""
    context.tolerated.append((element, name))
    message = f"{name!r} is not an attribute of <{element.tag}>"
    free = [each for each in known if each not in element.attrib] if _is_shown(context) else ()
    hint = hint_for_attribute(context.format, name, free, children) if _is_shown(context) else None
    refused = _is_refused(context, [str(element.tag), *_around(element)])
    context.report(rules.UNKNOWN_ATTRIBUTE, element, message, f"@{name}", found=name, help=hint, refused=refused)
    if name in _LOCATIONS:
        context.structural -= 1  # each XSD allows it everywhere


def outside_version(context: Context, element: XmlElement, fact: Fact) -> None:
    """Something of another version."""
    name = fact.name
    context.outside.append((element, fact))
    context.tolerated.append((element, name[1:] if fact.is_attribute else None))
    what = f"the attribute {name[1:]!r}" if fact.is_attribute else f"<{name}>"
    message = f"{what} {_when(context, fact)}"
    step = name if fact.is_attribute else ""
    severity = None if context.declared or context.sink.strict else Severity.INFO
    is_gone = not fact.is_attribute and fact.until < context.version
    holder = new_holder(context.format, fact, _around(element), context.version) if is_gone else None
    hint = f"write it in <{holder}>, where it is now" if holder else None
    if holder:
        message = message.replace("was removed", f"moved to <{holder}>", 1)
    details: FindingDetails = {"found": name, "help": hint, "severity": severity}
    if context.format == "mjcf":  # of which no file declares a version
        details |= {"severity": None, "refused": _is_refused(context, _around(element))}
    if context.format == "urdf":  # urdfdom 6 ignores an attribute of a later version, and knows no shape of one
        details["refused"] = not fact.is_attribute
        message += "; readers ignore it" if fact.is_attribute else "; readers refuse it"
    context.report(rules.OUTSIDE_VERSION, element, message, step, **details)


def value_outside_version(context: Context, element: XmlElement, fact: Fact, word: str) -> None:
    """A value that only other versions have here."""
    step = fact.name if fact.is_attribute else ""
    context.replaced.append((element, step[1:] or "#text", fact.enum[0]))
    subject = f"{step[1:]!r} of <{element.tag}>" if step else f"<{element.tag}>"
    message = f"{word!r} as {subject} {_when(context, fact.elsewhere[word])}"
    context.report(rules.OUTSIDE_VERSION, element, message, step, found=word, expected=", ".join(fact.enum))


def _when(context: Context, fact: Fact) -> str:
    """When a part came or went, for one that is not in the declared version."""
    when = f"was added in {context.format.upper()} {print_version(fact.since)}"
    if fact.until < context.version:
        when = f"was removed after {context.format.upper()} {print_version(fact.until)}"
    is_declared = context.declared and context.format != "mjcf"
    return f"{when}; the file declares {print_version(context.version)}" if is_declared else when


def missing_child(context: Context, element: XmlElement, name: str) -> None:
    """A required element that is not there."""
    rule = rules.MISSING_PART if name in _ESSENTIAL else rules.MISSING_ELEMENT
    context.report(rule, element, f"<{element.tag}> has no <{name}>", expected=f"<{name}>")


def missing_attribute(context: Context, element: XmlElement, fact: Fact) -> None:
    """A required attribute that is not there, or one that readers want to see although they can do without."""
    message = f"<{element.tag}> has no attribute {fact.name[1:]!r}"
    if not fact.expected:
        context.report(rules.MISSING_ATTRIBUTE, element, message, expected=fact.name)
        return
    meant = "the element has no effect" if fact.default is None else f"{fact.default!r} is assumed"
    context.report(rules.DEFAULTED_ATTRIBUTE, element, f"{message}; without it, {meant}", expected=fact.name)


_DIALECTS = {
    "bullet": "Bullet reads it",
    "drake": "Drake reads it",
    "gazebo": "Gazebo reads it",
    "exporter": "exporters write it, and no known program reads it",
    "isaac": "Isaac reads it",
    "mujoco": "MuJoCo reads it",
    "nasa": "NASA's tools read it",
    "old": "it was proposed in the early days of ROS, and few programs read it",
    "idyntree": "iDynTree reads it",
    "proposed": "it is proposed for urdfdom, and no release reads it",
    "pal": "PAL Robotics' controllers read it",
}


def dialect_element(context: Context, element: XmlElement, dialect: str) -> None:
    """An element of somebody's dialect."""
    context.tolerated.append((element, None))
    message = f"<{element.tag}> is not {context.format.upper()}; {_DIALECTS[dialect]}"
    context.report(rules.DIALECT, element, message, found=dialect)


def dialect_attribute(context: Context, element: XmlElement, name: str, dialect: str) -> None:
    """An attribute of somebody's dialect."""
    context.tolerated.append((element, name))
    message = f"{name!r} of <{element.tag}> is not {context.format.upper()}; {_DIALECTS[dialect]}"
    context.report(rules.DIALECT, element, message, f"@{name}", found=dialect)


def dialect_value(context: Context, element: XmlElement, step: str, word: str, dialect: str) -> None:
    """A value of somebody's dialect, which stands where the schema has a list of values."""
    message = (
        f"{step[1:]!r} of <{element.tag}> is {word!r}, which is not {context.format.upper()}; {_DIALECTS[dialect]}"
    )
    context.report(rules.DIALECT, element, message, step, found=word)


def prefixed_element(context: Context, element: XmlElement) -> None:
    """An element with a prefix: where it is that of a known reader, the element is the reader's, with all in it."""
    own = dialect_of(element, str(element.tag))
    if own is None:
        return
    prefix, word = own
    if word in words_of(prefix):
        message = f"<{prefix}:{word}> is not {context.format.upper()}; {_DIALECTS[prefix]}"
        _report_prefixed(context, rules.DIALECT, element, message, found=prefix)
    if word != "visual":  # in which Drake reads all that SDF has in a <visual>, with the prefix
        for below in element.iter():
            _check_word(context, below, str(below.tag))


def prefixed_attribute(context: Context, element: XmlElement, name: str) -> None:
    """An attribute with a prefix, which may be that of a known reader."""
    own = dialect_of(element, name)
    if own is None:
        return
    prefix, word = own
    if word in words_of(prefix):
        message = f"'{prefix}:{word}' of <{element.tag}> is not {context.format.upper()}; {_DIALECTS[prefix]}"
        _report_prefixed(context, rules.DIALECT, element, message, f"@{prefix}:{word}", found=prefix)
    else:
        _check_word(context, element, name, f"@{prefix}:{word}")


def _check_word(context: Context, element: XmlElement, name: str, step: str = "") -> None:
    prefix, word = dialect_of(element, name) or ("", "")
    if not prefix or word in words_of(prefix):
        return
    rule = rules.UNKNOWN_ATTRIBUTE if step else rules.UNKNOWN_ELEMENT
    subject = f"'{prefix}:{word}'" if step else f"<{prefix}:{word}>"
    near = nearest_name(word, words_of(prefix)) if _is_shown(context) else None
    hint = f"did you mean '{prefix}:{near}'?" if near else None
    message = f"{prefix.capitalize()} does not read {subject}"
    _report_prefixed(context, rule, element, message, step, found=f"{prefix}:{word}", help=hint)


def _report_prefixed(
    context: Context, rule: Rule, element: XmlElement, message: str, step: str = "", **more: Unpack[FindingDetails]
) -> None:
    context.report(rule, element, message, step, **more)
    context.structural -= 1  # an XSD does not see it


def deprecated(context: Context, element: XmlElement) -> None:
    """An element on its way out."""
    message = f"<{element.tag}> is deprecated in {context.format.upper()} {print_version(context.version)}"
    context.report(rules.DEPRECATED_ELEMENT, element, message, found=str(element.tag))


def deprecated_attribute(context: Context, element: XmlElement, name: str) -> None:
    """An attribute on its way out."""
    what = f"{name!r} of <{element.tag}>"
    message = f"{what} is deprecated in {context.format.upper()} {print_version(context.version)}"
    context.report(rules.DEPRECATED_ELEMENT, element, message, f"@{name}", found=name)


def missing_text(context: Context, element: XmlElement, expected: str) -> None:
    """A required value that was left blank."""
    message = f"<{element.tag}> is empty; expected {expected}"
    context.report(rules.MISSING_ELEMENT, element, message, found="", expected=expected)


def blank_value(context: Context, element: XmlElement, expected: str, *, refused: bool) -> None:
    """A value that was left blank where that means something; `refused` is whether libsdformat asks for it."""
    message = f"<{element.tag}> is empty; expected {expected}"
    value = element.get("value")
    hint = None
    if value is not None and context.format == "sdf" and _is_shown(context):
        hint = f"SDF writes <{element.tag}>{value}</{element.tag}>; value='...' is URDF"
    context.report(rules.BLANK_VALUE, element, message, found="", expected=expected, refused=refused, help=hint)


def repeated(context: Context, element: XmlElement) -> None:
    """A second one of what may stand once."""
    context.tolerated.append((element, None))
    parent = element.getparent()
    if parent is not None and element.tag == "camera" and parent.get("type") == "multicamera":
        return  # which is what this type of sensor is for, although the specification counts one
    holder = "its parent" if parent is None else f"<{parent.tag}>"
    message = f"<{element.tag}> occurs more than once in {holder}"
    other = next(element.itersiblings("{*}*", preceding=True), None)
    if other is not None and next(element.itersiblings(str(element.tag), preceding=True), None) is None:
        message = f"<{element.tag}> stands beside <{other.tag}> in {holder}, which has one of them"
    # Root.cc: of what stands outside of worlds there may be one, or the file is refused
    refused = (parent is not None and parent.tag == "sdf") or _is_refused(context, _around(element))
    context.report(rules.REPEATED_ELEMENT, element, message, refused=refused)


def invalid_value(context: Context, element: XmlElement, step: str, text: str, expected: str) -> None:
    """Text of the wrong type. `step` is the attribute, or empty for the element's own text."""
    subject = f"{step[1:]!r} of <{element.tag}>" if step else f"<{element.tag}>"
    message = f"{subject} is {cut(text)!r}; expected {expected}"
    context.report(rules.INVALID_VALUE, element, message, step, found=text, expected=expected)


def unlisted_value(context: Context, element: XmlElement, step: str, word: str, known: tuple[str, ...]) -> None:
    """A value that is none of those that there are."""
    subject = f"{step[1:]!r} of <{element.tag}>" if step else f"<{element.tag}>"
    expected = f"one of {', '.join(known)}"
    hint = hint_for_word(word, known) if _is_shown(context) else None
    message = f"{subject} is {cut(word)!r}; expected {expected}"
    context.report(rules.INVALID_VALUE, element, message, step, found=word, expected=expected, help=hint)


def mixed_rotation(context: Context, element: XmlElement, count: int) -> None:
    """A pose whose numbers are not those of the notation that it declares."""
    notation, degrees = element.get("rotation_format"), element.get("degrees")
    context.structural -= 1  # an XSD does not see it
    if notation == "quat_xyzw" and count == 7:
        message = f"<{element.tag}> is a quaternion, which cannot have the attribute degrees={degrees!r}"
        context.report(rules.INVALID_VALUE, element, message, "@degrees", found=degrees)
        return
    need = "seven numbers" if notation == "quat_xyzw" else "six numbers, or the attribute rotation_format='quat_xyzw'"
    message = f"<{element.tag}> has {count} numbers; expected {need}"
    context.report(rules.INVALID_VALUE, element, message, found=(element.text or "").strip(), expected=need)


def out_of_range(context: Context, element: XmlElement, fact: Fact, value: float) -> None:
    """A number outside its bounds."""
    if fact.max is not None and value > fact.max:
        bound = f"at most {fact.max:g}"
    else:
        bound = f"at least {fact.min:g}" if fact.above is None else f"more than {fact.above:g}"
    attribute = fact.is_attribute
    subject = f"{fact.name[1:]!r} of <{element.tag}>" if attribute else f"<{element.tag}>"
    message = f"{subject} is {value:g}; expected {bound}"
    step = fact.name if attribute else ""
    hint = "divide by 255" if fact.type in _COLORS and value > 1 else None
    refused = fact.strict
    if context.format == "sdf":  # which libsdformat reads by its newest description
        refused = fact.name not in _FREE_NUMBERS and fact.exists_in(parse_version(versions_of("sdf")[-1]))
    details: FindingDetails = {"found": f"{value:g}", "expected": bound, "help": hint, "refused": refused}
    context.report(rules.OUT_OF_RANGE, element, message, step, **details)


def stray_text(context: Context, element: XmlElement, text: str, after: XmlElement | None) -> None:
    """Text where only elements belong: at the beginning of an element, or after one of its children."""
    context.tolerated.append((element, "#text") if after is None else (after, "#tail"))
    shown = " ".join(text.split())[:40]
    context.report(rules.STRAY_TEXT, element, f"text {shown!r} does not belong in <{element.tag}>", found=shown)


def _is_shown(context: Context) -> bool:
    """Whether anybody will see a finding: there may be a hundred thousand more."""
    return context.sink.takes(Severity.WARNING)
