"""Reads a robot as a consumer does, and compares it with its table: what the consumer cannot read, or needs and misses.

A loader reads the text and not our tree, and has its own idea of a number or of a missing element. So a text is parsed
here as the consumer parses it (`xml_parsers.py`), and compared with the table of the consumer (`reads_tables.py`).
"""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import field, replace

from twinform.dataclass import dataclass
from twinform.ir.versions import version_read
from twinform.lazy import lazy_pattern
from twinform.profiles import tree_facts
from twinform.profiles.forms import FORMS
from twinform.profiles.nodes import Paths, RawNode, UnparsedError
from twinform.profiles.reads_tables import Demand, PlaceStep, Reads, reads
from twinform.profiles.xml_parsers import (
    TINYXML,
    TINYXML_2,
    parse_with_expat,
    parse_with_lxml,
    parse_with_tinyxml,
    split_as_bullet,
)

IsThere = Callable[[str], bool]
"""Says whether a URI leads to a file."""
_is_number = FORMS["python"][1]
_ITEMS = lazy_pattern(r"[\w:.-]+\??")


@dataclass(frozen=True, slots=True)
class Shortfall:
    """A demand that a robot does not meet: `kind` is "value", "absent", "unread", "tree" or "text".

    `path` is that of the element or attribute, and `fact` the name of the fact if the demand is one.
    """

    kind: str
    effect: str
    about: str
    message: str
    line: int
    path: str = ""
    found: str | None = None
    expected: str | None = None
    pipeline: str = ""
    fact: str = ""
    node: RawNode | None = field(default=None, repr=False, compare=False)


def shortfalls(root: RawNode, table: Reads, is_there: IsThere) -> Iterator[Shortfall]:
    """All demands of a table that a robot does not meet, in the order of the table."""
    paths = Paths(root)
    for each in _unmet_demands(root, table, is_there):
        above = paths.of(each.node) if each.node else "/"
        yield replace(each, path=above + each.path)


def _unmet_demands(root: RawNode, table: Reads, is_there: IsThere) -> Iterator[Shortfall]:
    version = version_read("urdf", root.attributes.get("version"))
    for demand in (each for each in table.demands if each.is_about(version)):
        if demand.item in tree_facts.FACTS:
            for node, message in tree_facts.FACTS[demand.item](root):
                yield _shortfall(demand, "tree", message, node, fact=demand.item)
            continue
        for node in _find_nodes(root, demand.place):
            if demand.form == "file":
                yield from _check_file(demand, node, is_there)
            else:
                yield from _check_demand(demand, node)


def _check_file(demand: Demand, node: RawNode, is_there: IsThere) -> Iterator[Shortfall]:
    uri = node.attributes.get(demand.item[1:])
    if uri and not is_there(uri):
        message = f"{demand.item[1:]!r} of <{node.tag}> is {uri!r}, which is not there"
        yield _shortfall(demand, "value", message, node, found=uri)


def _find_nodes(node: RawNode, place: tuple[PlaceStep, ...]) -> Iterator[RawNode]:
    """The elements at a place."""
    if not place:
        yield node
        return
    step, *rest = place
    for child in _children_at(node, step):
        if not step.types or (child.attributes.get("type", "") in step.types) != step.other:
            yield from _find_nodes(child, tuple(rest))


def _children_at(node: RawNode, step: PlaceStep) -> Iterable[RawNode]:
    if step.first:
        return [child for child in node.children[:1] if child.tag == step.tag]
    # Readers in C++ take the first element of a name (`FirstChildElement`) and never look at a
    # second one.
    same = node.all(step.tag)
    return same if step.every else (child for child in (next(same, None),) if child is not None)


def _check_demand(demand: Demand, node: RawNode) -> Iterator[Shortfall]:
    if demand.form == "known":
        yield from _check_known(demand, node)
    elif demand.form == "transmission":
        if message := _transmission_fault(node):
            yield _shortfall(demand, "absent", message, node)
    elif demand.item.startswith("@"):
        yield from _check_attribute(demand, node)
    elif demand.item == "#text":
        yield from _check_value(demand, node, f"the text of <{node.tag}>", node.text)
    else:
        yield from _check_element(demand, node)


def _check_attribute(demand: Demand, node: RawNode) -> Iterator[Shortfall]:
    names = demand.item[1:].split("|")
    given = [name for name in names if name in node.attributes]
    if demand.form == "none":
        yield from (_unread_attribute(demand, node, name) for name in given)
        return
    if demand.form == "once":
        yield from (_unread_attribute(demand, node, name) for name in given[1:])
        return
    if not given and demand.needed:
        wanted = " or ".join(map(repr, names))
        yield _shortfall(demand, "absent", f"<{node.tag}> has no attribute {wanted}", node, expected=wanted)
    for name in given:
        yield from _check_value(demand, node, f"{name!r} of <{node.tag}>", node.attributes[name], f"/@{name}")


def _check_value(demand: Demand, node: RawNode, what: str, text: str, below: str = "") -> Iterator[Shortfall]:
    words, reads = FORMS[demand.form] if demand.form in FORMS else _choice(demand.form)
    if not reads(text):
        yield _shortfall(demand, "value", f"{what} is {text!r}", node, found=text, expected=words, below=below)


def _unread_attribute(demand: Demand, node: RawNode, name: str) -> Shortfall:
    return _shortfall(demand, "unread", f"<{node.tag}> has an attribute {name!r}", node, below=f"/@{name}")


def _choice(form: str) -> tuple[str, Callable[[str], bool]]:
    choice = form.removeprefix("=").split("|")
    return " or ".join(choice), choice.__contains__


def _check_element(demand: Demand, node: RawNode) -> Iterator[Shortfall]:
    names = demand.item.strip("<>").split("|")
    if demand.form == "none":
        yield from (
            _shortfall(demand, "unread", f"<{node.tag}> has a <{tag.tag}>", tag)
            for tag in node.children
            if tag.tag in names
        )
    elif demand.form == "once" and (again := [tag for tag in node.children if tag.tag in names][1:]):
        yield _shortfall(demand, "unread", f"<{node.tag}> has a second <{again[0].tag}>", again[0])
    elif demand.form in {"first", "single"}:
        if demand.form == "single" and len(node.children) != 1:
            yield _shortfall(demand, "unread", f"<{node.tag}> has {len(node.children)} elements", node, expected="one")
        elif not node.children:
            yield _shortfall(demand, "absent", f"<{node.tag}> is empty", node, expected=" or ".join(names))
        elif (shape := node.children[0]).tag not in names:
            yield _shortfall(
                demand, "unread", f"<{node.tag}> begins with <{shape.tag}>", shape, expected=" or ".join(names)
            )
    elif demand.needed and not any(child.tag in names for child in node.children):
        wanted = " or ".join(f"<{name}>" for name in names)
        yield _shortfall(demand, "absent", f"<{node.tag}> has no {wanted}", node, expected=wanted)


def _check_known(demand: Demand, node: RawNode) -> Iterator[Shortfall]:
    """Attributes or children that the consumer does not know, or that are there twice but known only once."""
    known = _ITEMS.findall(demand.item)
    names = {name.removesuffix("?") for name in known}
    if demand.item.startswith("@"):
        strange = (name for name in node.attributes if name not in names)
        yield from (_unread_attribute(demand, node, name) for name in strange)
        return
    once, met = {name[:-1] for name in known if name.endswith("?")}, set[str]()
    for child in node.children:
        if child.tag not in names:
            yield _shortfall(demand, "unread", f"<{node.tag}> has a <{child.tag}>", child)
        elif child.tag in once and child.tag in met:
            yield _shortfall(demand, "unread", f"<{node.tag}> has a second <{child.tag}>", child)
        met.add(child.tag)


def _shortfall(
    demand: Demand,
    kind: str,
    message: str,
    node: RawNode,
    *,
    found: str | None = None,
    expected: str | None = None,
    below: str = "",
    fact: str = "",
) -> Shortfall:
    what = (kind, demand.effect, demand.about, message, node.line, below)
    return Shortfall(*what, found, expected, demand.pipeline, fact, node)


def _transmission_fault(node: RawNode) -> str:
    """Why urdf_parser_py reads a `<transmission>` neither as that of ros_control nor as that of the PR2; else empty."""
    newer, older = _ros_control_fault(node), _pr2_fault(node)
    return newer if newer and older else ""


def _ros_control_fault(node: RawNode) -> str:
    joints, actuators = list(node.all("joint")), list(node.all("actuator"))
    if "name" not in node.attributes:
        return "<transmission> has no attribute 'name'"
    if node.first("type") is None:
        return "<transmission> has no <type>"
    if not joints or not actuators:
        return f"<transmission> has no <{'actuator' if joints else 'joint'}>"
    if any("name" not in each.attributes for each in (*joints, *actuators)):
        return "a <joint> or <actuator> of a <transmission> has no name"
    if any(joint.first("hardwareInterface") is None for joint in joints):
        return "a <joint> of a <transmission> has no <hardwareInterface>"
    reductions = (actuator.first("mechanicalReduction") for actuator in actuators)
    return next((f"{each.text!r} is no reduction" for each in reductions if each and not _is_number(each.text)), "")


def _pr2_fault(node: RawNode) -> str:
    named = [node.first("joint"), node.first("actuator")]
    reduction = node.first("mechanicalReduction")
    if not {"name", "type"} <= node.attributes.keys() or reduction is None or not _is_number(reduction.text):
        return "<transmission> is not of the older form either"
    if any(each is None or "name" not in each.attributes for each in named):
        return "<transmission> is not of the older form either"
    return ""


__all__ = ["Shortfall", "read_as"]

_ROBOTS = frozenset({"tinyxml", "tinyxml2", "bullet", "sax"})
"""Parsers whose consumers take the first robot at the top; others take whatever element is there."""
_DECLARATIONS = lazy_pattern(rb"^[^\S\n]*<\?xml[^\n]*\?>[^\S\n]*$", re.MULTILINE)
"""Declarations, which are removed before the text is parsed."""
_NOT_XML = "its XML parser does not read the file"
_LEFT_OUT = "it leaves the element out"
_RECOVERED = "it reads as much of the file as it can"


def read_as(consumer: str, content: bytes, is_there: IsThere = lambda _: True) -> Iterator[Shortfall]:
    """What a consumer, perhaps with a release after `@`, cannot read in a text, or needs and does not find there."""
    table = reads(consumer)
    try:
        top, message = _parse_as(table.parser, content)
    except UnparsedError as error:
        yield Shortfall("text", "refuses", _NOT_XML, error.message, error.line)
        return
    if message:
        yield Shortfall("text", "misreads", _RECOVERED, message, 0)
    root = next((node for node in top if node.tag == "robot"), None) if table.parser in _ROBOTS else top[0]
    if root is None:
        yield Shortfall("text", "refuses", _NOT_XML, "there is no <robot>", top[0].line)
        return
    for child in [child for child in root.children if table.skips and child.attributes.get(table.skips) == "true"]:
        yield Shortfall("unread", "drops", _LEFT_OUT, f"<{child.tag}> has {table.skips}='true'", child.line, child.tag)
        root.children.remove(child)
    yield from shortfalls(root, table, is_there)


def _parse_as(parser: str, content: bytes) -> tuple[list[RawNode], str]:
    if parser == "expat":
        return parse_with_expat(content), ""
    if parser == "sax":
        return parse_with_expat(_DECLARATIONS.sub(b"", content)), ""
    if parser == "lxml":
        return parse_with_lxml(content)
    if parser == "bullet":
        return parse_with_tinyxml(split_as_bullet(content), TINYXML_2), ""
    return parse_with_tinyxml(content, TINYXML if parser == "tinyxml" else TINYXML_2), ""
