"""The census has a bit for all that a version may lack."""

from twinform.ir.rewrite import PLANS, RARE
from twinform.passes.sdf_versions.spans import bits_lacking
from twinform.schemas import parse_version, table

OF_URDF = {
    ("Capsule", "length"), ("Capsule", "radius"), ("Limit", "acceleration"), ("Limit", "deceleration"),
    ("Limit", "jerk"), ("Pose", "quat_xyzw"),
}  # fmt: skip
"""Fields with a bit that not every version of URDF has."""


def test_fields_have_a_bit_where_a_version_lacks_them_and_only_there() -> None:
    lacking = 0
    for version in table("sdf").versions:
        lacking |= bits_lacking(parse_version(version))  # raises where a field has no bit
    rare = {(kind.__name__, field) for kind, fields in RARE.items() for field in fields}
    found = {(kind.__name__, field) for kind, plan in PLANS.items() for field, bit in plan.rare if bit & lacking}
    assert found == rare - OF_URDF


def test_the_newest_version_lacks_less_than_the_first() -> None:
    first, *_, newest = [bits_lacking(parse_version(version)).bit_count() for version in table("sdf").versions]
    assert newest < first
