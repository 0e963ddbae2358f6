"""The reader over a small table that has every kind of row: all that comes out, kept in `schema_reader.json`.

There, a case has its `text` and the `definition` of its root, the `data` with sources as text, all `findings`, and
what the context remembers.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, Literal, cast

import pytest
from lxml import etree

from twinform.diagnostics import DiagnosticSink, Source
from twinform.ir import Element, Node, Pose
from twinform.ir.record import Record, record
from twinform.schemas import Context, SchemaReader, Table, table
from twinform.schemas.facts import parse_facts

FACTS = """
thing
  @name      1  string                                    -> name
  @on        ?  bool                                      -> on
  @near      ?  double   min=0 max=10                     -> near
  @size      ?  vector3  min=0                            -> size
  @low       ?  int      max=3                            -> low
  @mode      ?  string   enum=fast|slow also=warp:gazebo  -> mode
  @old       ?  double   until=1.0                        -> old
  @new       ?  double   since=1.2                        -> new
  @hint      ?  string   dialect=gazebo
  @spare     ?  int
  @unit      ?  double   default=1 expected               -> unit
  @edition   ?  string                                    -> /version
  mass       ?  double   min=0                            -> mass
  must       ?  double                                    -> must
  count      *  int                                       -> counts
  label      ?  string                                    -> label
  flag       ?  bool                                      -> flag
  depth      ?  double                                    -> box.depth
  width      ?  double                                    -> box.width
  limit      ?                                            -> box.limit
    @top     ?  double                                    -> top
  style      ?  string   enum=plain|fancy                 -> style
  span       ?  double                                    -> span
    @of      ?  string                                    -> span_of
  part       *  &part                                     -> parts
  one        ?  &part                                     -> ones[]
  group      ?                                            -> .
    @rank    ?  int                                       -> rank
    tag      ?  string                                    -> tag
  range      ?                                            -> .
    @from    1  double                                    -> start
    @to      ?  double                                    -> stop
  sensor     ?                                            -> sensor
    @rate    ?  double                                    -> rate
  round      ?                                            -> shape:round
    @radius  1  double                                    -> radius
  square     ?                                            -> shape:square
    @side    1  double                                    -> side
  secret     ?
    @code    1  int
  late       ?  double   since=1.2                        -> late
  fading     ?  double   deprecated                       -> fading
  skipped    ?           aside
    @code    1  int
  foreign    ?  string   dialect=drake                    -> foreign
  pose       ?  &pose                                     -> pose
part
  @name      1  string                                    -> name
  child      1  string                                    -> child
free  any                                                 -> content
pose  pose  default="0 0 0 0 0 0"                         -> .
  @rotation_format  ?  string  enum=euler_rpy|quat_xyzw   -> rotation_format
  @degrees          ?  bool                               -> degrees
"""
TABLE = Table("sdf", ("1.0", "1.1", "1.2"), "thing", {each.name: each for each in parse_facts(FACTS.splitlines(), "t")})


@record
class Part(Node):
    name: str | None = None
    child: str | None = None


@record
class Limit(Node):
    top: float | None = None


@record
class Box(Node):
    depth: float | None = None
    width: float | None = None
    limit: Limit | None = None


@record
class Sensor(Node):
    rate: float | None = None


@record
class Round(Node):
    kind: Literal["round"] = "round"
    radius: float | None = None


@record
class Square(Node):
    kind: Literal["square"] = "square"
    side: float | None = None


@record
class Free(Node):
    content: tuple[Element, ...] = ()


@record
class Thing(Node):
    name: str
    on: bool | None = None
    near: float | None = None
    size: tuple[float, float, float] | None = None
    low: int | None = None
    mode: str | None = None
    old: float | None = None
    new: float | None = None
    unit: float | None = None
    mass: float | None = None
    must: float | None = None
    counts: tuple[int, ...] = ()
    label: str | None = None
    flag: bool | None = None
    box: Box | None = None
    style: str | None = None
    span: float | None = None
    span_of: str | None = None
    parts: tuple[Part, ...] = ()
    ones: tuple[Part, ...] = ()
    rank: int | None = None
    tag: str | None = None
    start: float | None = None
    stop: float | None = None
    sensor: Sensor | None = None
    shape: Round | Square | None = None
    late: float | None = None
    fading: float | None = None
    foreign: str | None = None
    pose: Pose | None = None


NODES: dict[str, type[Node]] = {"thing": Thing, "part": Part, "free": Free, "pose": Pose}
CASES: dict[str, dict[str, Any]] = json.loads(
    Path(__file__).with_name("schema_reader.json").read_text(encoding="utf-8")
)
NOT_VALID = {"leaves with attributes", "stray text", "faults inside of what is skipped"}
"""What a schema does not let pass, and the short way does not see."""


def shown(data: object) -> object:
    """The data as JSON has it, with sources as text."""
    if isinstance(data, Source):
        return f"{data.file}:{data.line} {data.path}"
    if isinstance(data, Record):
        values = {each.name: getattr(data, each.name) for each in fields(data)}  # pyright: ignore[reportArgumentType]
        defaults = {each.name: each.default for each in fields(data)}  # pyright: ignore[reportArgumentType]
        return {
            name: shown(value) for name, value in values.items() if name in {"at", "kind"} or value != defaults[name]
        }
    if isinstance(data, Mapping):
        return {key: shown(value) for key, value in cast("Mapping[str, object]", data).items()}
    if isinstance(data, list | tuple):
        return [shown(each) for each in cast("Sequence[object]", data)]
    return data


def read(text: str, definition: str, *, simple: bool = False) -> dict[str, object]:
    """All that becomes of a text."""
    sink = DiagnosticSink(file="notes")
    context = Context(sink, "file", "sdf", (1, 1), simple=simple)
    data = SchemaReader(TABLE, (1, 1)).read(etree.fromstring(text), context, definition, NODES[definition])
    return {
        "text": text,
        "definition": definition,
        "data": shown(data),
        "findings": [
            [
                each.rule.name,
                str(each.severity),
                f"{each.location.file}:{each.location.line} {each.location.path}",
                each.message,
                each.found,
                each.expected,
                each.help,
            ]
            for each in sink.diagnostics
        ],
        "tolerated": [[str(element.tag), what] for element, what in context.tolerated],
        "structural": context.structural,
        "header": context.header,
        "aside": context.aside,
    }


@pytest.mark.parametrize("name", CASES)
def test_every_row_is_read_and_every_fault_is_reported(name: str) -> None:
    case = CASES[name]
    assert read(case["text"], case["definition"]) == case


@pytest.mark.parametrize("name", [name for name in CASES if name not in NOT_VALID])
def test_the_short_way_leads_to_the_same(name: str) -> None:
    case = CASES[name]
    assert read(case["text"], case["definition"], simple=True) == case


def test_a_source_may_be_given() -> None:
    context = Context(DiagnosticSink(), "file", "sdf", (1, 1))
    source = Source("elsewhere", 7, None, "origin", "o")
    element = etree.fromstring("<sensor><child>c</child></sensor>")
    given = SchemaReader(TABLE, (1, 1)).read(element, context, "part", Part, source)
    assert given == {"source": source, "child": "c"}
    element = etree.fromstring("<thing name='t'><part name='p'/></thing>")
    root = SchemaReader(TABLE, (1, 1)).read(element, context, "thing", Thing)
    assert root["name"] == "t"
    assert root["parts"][0].source == Source("file", 1, Source("file", 1, None, "thing", "t"), "part", "p")


def test_what_is_read_depends_on_the_version() -> None:
    element = etree.fromstring("<thing name='t' unit='1' old='1' new='2'><late>1</late></thing>")
    for version, strange in (((1, 0), ["new", "late"]), ((1, 1), ["old", "new", "late"]), ((1, 2), ["old"])):
        context = Context(DiagnosticSink(), "", "sdf", version)
        data = SchemaReader(TABLE, version).read(element, context, "thing", Thing)
        assert (data["old"], data["new"], data["late"]) == (1.0, 2.0, 1.0)
        assert [what or str(where.tag) for where, what in context.tolerated] == strange


def test_a_node_without_what_it_needs_breaks_the_document() -> None:
    for text, broken in (("<thing unit='1'/>", True), ("<thing name='t' unit='1'/>", False)):
        context = Context(DiagnosticSink(), "", "sdf", (1, 1))
        SchemaReader(TABLE, (1, 1)).read(etree.fromstring(text), context, "thing", Thing)
        assert context.broken is broken
        assert context.sink.has_errors is broken


@pytest.mark.parametrize(
    ("link", "element", "complaint"),
    [
        ("link\n  @name  1  string  -> nmae", "<link name='a'/>", "Link has no field 'nmae'"),
        ("link\n  @name  ?  string  -> name", "<link name='a'/>", "link: nothing asks for name"),
        ("link\n  @name  1  string  -> name\n  @x  ?  string  -> pose.x", "<link x='a'/>", "Pose has no field 'x'"),
        ("link\n  @name  1  string  -> name\n  @x  ?  string  -> /x", "<link x='a'/>", "Document has no field 'x'"),
        (
            "link\n  @name  1  string  -> name\n  mass  ?  -> .\n    @value  1  double  -> mass",
            "<link><mass value='1'/></link>",
            "Link has no field 'mass'",
        ),
        (
            "link\n  @name  1  string  -> name\n  visual  *  -> visual\n    @name  ?  string  -> name",
            "<link><visual/></link>",
            "Link has no field 'visual'",
        ),
    ],
)
def test_a_place_is_a_field_of_the_class(link: str, element: str, complaint: str) -> None:
    (definition,) = parse_facts(link.splitlines(), "link.facts")
    facts = replace(table("urdf"), definitions={**table("urdf").definitions, "link": definition})
    context = Context(DiagnosticSink(), "", "urdf", (1, 0))
    with pytest.raises(ValueError, match=complaint):
        SchemaReader(facts, (1, 0)).read(etree.fromstring(f"<robot name='r'>{element}</robot>"), context)
