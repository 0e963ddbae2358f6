"""The schema reader over a small table that has every kind of row: all that comes out, kept in `schema_reader.json`.

There, a case has its `text` and the `definition` of its root, the `data` with sources as text, all `findings`, and
what the context remembers.
"""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, cast

import pytest
from lxml import etree

from twinform.diagnostics import DiagnosticSink, Source
from twinform.schemas import Context, Reader, Table
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
  @edition   ?  string                                    -> /edition
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


CASES: dict[str, dict[str, Any]] = json.loads(
    Path(__file__).with_name("schema_reader.json").read_text(encoding="utf-8")
)
NOT_VALID = {"leaves with attributes", "stray text", "faults inside of what is skipped"}
"""What a schema does not let pass, and the short way does not see."""


def shown(data: object) -> object:
    """The data as JSON has it, with sources as text."""
    if isinstance(data, Source):
        return f"{data.file}:{data.line} {data.path}"
    if isinstance(data, Mapping):
        return {key: shown(value) for key, value in cast("Mapping[str, object]", data).items()}
    if isinstance(data, list | tuple):
        return [shown(each) for each in cast("Sequence[object]", data)]
    return data


def read(text: str, definition: str, *, simple: bool = False) -> dict[str, object]:
    """All that becomes of a text."""
    sink = DiagnosticSink(file="notes")
    context = Context(sink, "file", "sdf", (1, 1), clean=simple)
    data = Reader(TABLE, (1, 1)).read(etree.fromstring(text), context, definition)
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
    given = Reader(TABLE, (1, 1)).read(etree.fromstring("<sensor><child>c</child></sensor>"), context, "part", source)
    assert given == {"source": source, "child": "c"}
    root = Reader(TABLE, (1, 1)).read(etree.fromstring("\n<thing name='t'><part name='p'/></thing>".strip()), context)
    assert root["name"] == "t"
    assert root["parts"][0]["source"] == Source("file", 1, Source("file", 1, None, "thing", "t"), "part", "p")


def test_what_is_read_depends_on_the_version() -> None:
    element = etree.fromstring("<thing name='t' unit='1' old='1' new='2'><late>1</late></thing>")
    for version, strange in (((1, 0), ["new", "late"]), ((1, 1), ["old", "new", "late"]), ((1, 2), ["old"])):
        context = Context(DiagnosticSink(), "", "sdf", version)
        data = Reader(TABLE, version).read(element, context)
        assert (data["old"], data["new"], data["late"]) == (1.0, 2.0, 1.0)
        assert [what or str(where.tag) for where, what in context.tolerated] == strange
