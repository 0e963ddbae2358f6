"""What the generator of readers finds wrong in the facts tables."""

from dataclasses import replace

import pytest

from twinform.compiler.input.readers.functions import ModuleWriter
from twinform.schemas import Table, table
from twinform.schemas.facts import parse_facts


def _with(link: str) -> Table:
    """The table of URDF with other facts of links."""
    (definition,) = parse_facts(link.splitlines(), "link.facts")
    facts = table("urdf")
    return replace(facts, definitions={**facts.definitions, "link": definition})


@pytest.mark.parametrize(
    ("link", "complaint"),
    [
        ("link\n  @name  1  string  -> nmae\n  visual  *  -> visuals", "link/@name: Link has no field 'nmae'"),
        ("link\n  @name  1  string  -> pose.x", "link/@name: Pose has no field 'x'"),
        ("link\n  @name  1  string  -> /edition", "link/@name: Document has no field 'edition'"),
        ("link\n  mass  ?  -> .\n    @value  1  double  -> mass", "link/@value: Link has no field 'mass'"),
        ("link\n  visual  *  -> visual\n    @name  ?  string  -> name", "link/visual: Link has no field 'visual'"),
    ],
)
def test_a_place_is_a_field_of_the_class(link: str, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        ModuleWriter(_with(link)).text()
