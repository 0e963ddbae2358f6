import twinform

_FRAMED = """\
<sdf version="1.11">
  <model name="m">
    <link name="base"/>
    <frame name="tool" attached_to="base"/>
  </model>
</sdf>
"""


def test_a_link_does_not_take_over_that_a_frame_on_it_was_made():
    urdf = twinform.convert(_FRAMED.encode(), to="urdf").text
    (base,) = twinform.convert(urdf.encode(), to="sdf").document.models[0].links
    assert base.opaque == ()
