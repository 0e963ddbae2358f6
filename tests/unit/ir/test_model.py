"""Parts of a model by their names."""

import pytest

from twinform.ir import Frame, Joint, Link, Model


def test_parts_are_found_by_their_names() -> None:
    frames = (Frame(name="f", attached_to="base"), Frame(name="f"))
    model = Model(
        name="r", links=(Link(name="base"), Link(name="tool")), joints=(Joint(name="j", type="fixed"),), frames=frames
    )
    assert model.link("tool") is model.links[1]
    assert model.joint("j") is model.joints[0]
    assert model.frame("f") is frames[0], "of several, the first"
    with pytest.raises(KeyError, match=r"there is no link 'bse'; did you mean 'base'\?"):
        model.link("bse")
    with pytest.raises(KeyError, match="there is no frame 'x'"):
        model.frame("x")
