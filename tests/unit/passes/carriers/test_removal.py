"""Documents without what other readers skip."""

import twinform
from twinform.passes.carriers.carriers import without_bodies_for_gazebo, without_ours

_ROBOT = b"""<robot xmlns:tf="urn:twinform:1" name="r">
  <link name="a"><tf:offset xyz="0 0 1"/><visual><geometry><sphere radius="1"/></geometry><tf:sdf/></visual></link>
  <gazebo><joint name="j"/><plugin name="p"><tf:version/><rate>5</rate></plugin></gazebo>
  <gazebo><link name="b"/></gazebo>
  <gazebo/>
  <gazebo reference="a"><link>named so</link></gazebo>
</robot>"""


def test_nothing_of_ours_is_left_and_all_else_is():
    text = without_ours(_document()).model_dump_json()
    assert "urn:twinform:1}" not in text
    assert '"rate"' in text


def test_what_has_nothing_to_take_away_stays_the_same_object():
    bare = without_bodies_for_gazebo(without_ours(_document()))
    assert without_ours(bare) is bare
    assert without_bodies_for_gazebo(bare) is bare


def test_bodies_go_from_what_is_about_the_model():
    extensions = without_bodies_for_gazebo(_document()).models[0].extensions
    assert [(each.reference, [one.name for one in each.content]) for each in extensions] == [
        (None, ["plugin"]),
        (None, []),
        ("a", ["link"]),
    ]


def _document() -> twinform.Document:
    document = twinform.check(_ROBOT).document
    assert document is not None
    return document
