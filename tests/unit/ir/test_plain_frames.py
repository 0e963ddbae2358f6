"""Where frames are sound at first sight, the graph of them has no problem either."""

from hypothesis import given
from hypothesis import strategies as st

from tests.profile import examples
from twinform.ir import Frame, Joint, Link, Model, Pose
from twinform.ir.frames import FrameGraph
from twinform.ir.verify.verify_sdf import has_plain_frames
from twinform.testing import strategies

NAMES = ("a", "b", "c", "j", "k", "f", "g", "__model__", "world", "nobody")
_any_name = st.sampled_from(NAMES)
_poses = st.none() | st.builds(Pose, relative_to=st.none() | _any_name)


@st.composite
def _models(draw: st.DrawFn) -> Model:
    """Small models of which each frame may be relative to any other, or to nothing that there is."""
    links = tuple(Link(name=name, pose=draw(_poses)) for name in draw(st.sets(st.sampled_from("abc"))))
    joints = tuple(
        Joint(name=name, type="fixed", parent=draw(_any_name), child=draw(_any_name), pose=draw(_poses))
        for name in draw(st.sets(st.sampled_from("jka")))
    )
    frames = tuple(
        Frame(name=name, attached_to=draw(st.none() | _any_name), pose=draw(_poses))
        for name in draw(st.sets(st.sampled_from("fgb")))
    )
    return Model(name="m", links=links, joints=joints, frames=frames)


@examples(4)
@given(_models())
def test_plain_frames_have_no_problems(model: Model) -> None:
    if has_plain_frames(model):
        assert [str(problem) for problem in FrameGraph(model).problems()] == []


@given(strategies.robots())
def test_robots_have_plain_frames_or_problems_only_a_graph_can_tell(robot: object) -> None:
    for model in getattr(robot, "models", ()):
        assert not has_plain_frames(model) or not list(FrameGraph(model).problems())


def test_most_models_are_plain() -> None:
    links = (Link(name="a"), Link(name="b", pose=Pose(relative_to="j")))
    joint = Joint(name="j", type="fixed", parent="a", child="b", pose=Pose(relative_to="a"))
    frame = Frame(name="f", attached_to="b")
    assert has_plain_frames(Model(name="m", links=links, joints=(joint,), frames=(frame,)))


def test_circles_and_names_of_nothing_are_not() -> None:
    around = (Link(name="a", pose=Pose(relative_to="b")), Link(name="b", pose=Pose(relative_to="a")))
    assert not has_plain_frames(Model(name="m", links=around))
    assert not has_plain_frames(Model(name="m", links=(Link(name="a", pose=Pose(relative_to="a")),)))
    assert not has_plain_frames(Model(name="m", links=(Link(name="a", pose=Pose(relative_to="x")),)))
    assert not has_plain_frames(Model(name="m", frames=(Frame(name="f", attached_to="f"),)))
