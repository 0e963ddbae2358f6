"""What is a mistake in a facts table."""

import pytest

from twinform.schemas.facts import Fact, FactDefinitions, named_kinds, parse_facts, table

_FIELD_BELOW_NOTHING = """\
visual
  transparency  ?
    @value      1  double  -> transparency"""
_DEEPER = """\
visual
  material   ?          -> material
    shader   ?
      normal_map  ?  string  -> normal_map"""

_GROUPS = """\
body
  @name   ?  string
  & turned
  @mass   ?  double
turned
  & angles
  @quat   ?  string
angles
  @euler  ?  string"""


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (_FIELD_BELOW_NOTHING, "t.facts:3: @value is kept in a field, and <transparency> around it is not"),
        (_DEEPER, "t.facts:4: normal_map is kept in a field, and <shader> around it is not"),
        ("visual\n    deep  ?", "t.facts:2: not a row of a facts table"),
        ("visual\n  name  ?  sting  string", "t.facts:2: 'string' is not known here"),
        ("visual\n  name  ?  string  minimum=1", "t.facts:2: 'minimum' is not a key of a facts table"),
    ],
)
def test_a_mistake_in_a_table_is_an_error_with_its_line(text: str, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        list(parse_facts(text.splitlines(), "t.facts"))


def test_a_container_that_makes_no_node_says_so() -> None:
    (visual,) = parse_facts(_FIELD_BELOW_NOTHING.replace("?", "?  -> .", 1).splitlines(), "t.facts")
    assert [row.place for row in visual.rows] == ["."]


def test_rows_of_another_definition_stand_where_it_is_named() -> None:
    definitions = FactDefinitions()
    definitions.add(_GROUPS.splitlines(), "t.facts")
    assert [row.name for row in definitions["body"].rows] == ["@name", "@euler", "@quat", "@mass"]
    assert [row.name for row in definitions["turned"].rows] == ["@euler", "@quat"]


def test_a_row_says_of_what_its_value_is_the_name() -> None:
    (sensor,) = parse_facts(["sensor", "  @objname  1  string  names=body|site"], "t.facts")
    assert sensor.rows[0].names == ("body", "site")


def test_attributes_of_mjcf_that_name_parts_mean_one_kind_wherever_they_are() -> None:
    def walk(row: Fact) -> list[Fact]:
        return [row, *(inner for each in row.rows for inner in walk(each))]

    rows = [row for each in table("mjcf").definitions.values() for row in walk(each)]
    naming = {(row.name, row.names) for row in rows if row.is_attribute and len(row.names) == 1}
    assert {(f"@{name}", (kind,)) for name, kind in named_kinds("mjcf").items()} == naming
