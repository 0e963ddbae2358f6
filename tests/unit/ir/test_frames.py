"""The frame graph; the expected poses are products of numpy matrices, or plain to see."""

import numpy as np
import pytest

from twinform.diagnostics import DiagnosticSink, Source
from twinform.ir import Frame, Include, Joint, Link, Model, Pose, World
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.transform import Transform

QUARTER = Pose(rpy=(0, 0, np.pi / 2))


def at(x: float, y: float = 0.0, z: float = 0.0, relative_to: str | None = None) -> Pose:
    return Pose(xyz=(x, y, z), relative_to=relative_to)


def turned(x: float, relative_to: str | None = None) -> Pose:
    return Pose(xyz=(x, 0, 0), rpy=(0, 0, np.pi / 2), relative_to=relative_to)


def joint(name: str, parent: str, child: str, pose: Pose | None = None) -> Joint:
    return Joint(name=name, type="fixed", parent=parent, child=child, pose=pose)


def place(transform: Transform) -> tuple[float, ...]:
    return tuple(round(number, 12) + 0.0 for number in transform.translation)


ARM = Model(
    name="arm",
    pose=at(100),
    links=(Link(name="a", pose=at(1)), Link(name="b", pose=turned(2)), Link(name="c", pose=at(5, relative_to="j2"))),
    joints=(joint("j1", "a", "b", at(0.5)), joint("j2", "b", "c", turned(3, "b"))),
    frames=(
        Frame(name="f"),
        Frame(name="g", attached_to="b", pose=at(1)),
        Frame(name="h", attached_to="g", pose=at(1, 0, 0, "a")),
    ),
)


@pytest.mark.parametrize(
    ("frame", "base", "expected"),
    [
        ("b", "__model__", (2, 0, 0)),
        ("a", "a", (0, 0, 0)),
        ("j1", "b", (0.5, 0, 0)),
        ("j1", "__model__", (2, 0.5, 0)),
        ("j1", "a", (1, 0.5, 0)),
        ("j2", "b", (3, 0, 0)),
        ("c", "j2", (5, 0, 0)),
        ("c", "b", (3, 5, 0)),
        ("c", "__model__", (-3, 3, 0)),
        ("f", "__model__", (0, 0, 0)),
        ("g", "b", (1, 0, 0)),
        ("h", "a", (1, 0, 0)),
        ("__model__", "a", (-1, 0, 0)),
        ("a", "world", (101, 0, 0)),
        ("world", "__model__", (-100, 0, 0)),
    ],
)
def test_frames_are_found_in_each_other(frame: str, base: str, expected: tuple[float, ...]) -> None:
    assert place(FrameGraph(ARM).pose(frame, base)) == expected


def test_frames_agree_with_products_of_matrices() -> None:
    graph, names = FrameGraph(ARM), ["a", "b", "c", "j1", "j2", "f", "g", "h", "__model__", "world"]
    in_model = {name: np.array(graph.pose(name, "__model__").matrix) for name in names}
    for one in names:
        for other in names:
            expected = np.linalg.inv(in_model[other]) @ in_model[one]
            np.testing.assert_allclose(graph.pose(one, other).matrix, expected, atol=1e-13)


def test_numbers_that_are_written_are_kept() -> None:
    graph = FrameGraph(ARM)
    assert graph.pose("c", "j2").to_pose() == Pose(xyz=(5, 0, 0), relative_to=None)
    assert graph.resolve(at(0.1, 0.2, 0.3), "c", "c").to_pose() == at(0.1, 0.2, 0.3)


def test_a_pose_is_in_its_holder_unless_it_names_another_frame() -> None:
    graph = FrameGraph(ARM)
    assert place(graph.resolve(at(1), "b", "__model__")) == (2, 1, 0)
    assert place(graph.resolve(at(1, relative_to="a"), "b", "__model__")) == (2, 0, 0)
    assert place(graph.resolve(None, "j2", "b", kind="joint")) == (3, 0, 0)


@pytest.mark.parametrize(
    ("frame", "link"),
    [("f", "a"), ("g", "b"), ("h", "b"), ("j2", "c"), ("__model__", "a"), ("c", "c"), ("world", "world")],
)
def test_a_frame_moves_with_a_link(frame: str, link: str) -> None:
    assert FrameGraph(ARM).body(frame) == link


OUTER = Model(
    name="outer",
    links=(Link(name="base", pose=at(1, relative_to="inner::tip")),),
    models=(
        Model(
            name="inner",
            pose=turned(10),
            placement_frame="root",
            links=(Link(name="root", pose=at(2)), Link(name="hand", pose=at(3, relative_to="root"))),
            frames=(Frame(name="tip", attached_to="hand", pose=at(1)),),
            models=(Model(name="deep", pose=at(0, 0, 7), links=(Link(name="seed"),)),),
        ),
    ),
)


@pytest.mark.parametrize(
    ("frame", "expected"),
    [
        ("inner::root", (10, 0, 0)),
        ("inner", (10, -2, 0)),
        ("inner::__model__", (10, -2, 0)),
        ("inner::hand", (10, 3, 0)),
        ("inner::tip", (10, 4, 0)),
        ("inner::deep::seed", (10, -2, 7)),
        ("base", (10, 5, 0)),
    ],
)
def test_nested_models_have_scopes_and_are_placed_by_their_frame(frame: str, expected: tuple[float, ...]) -> None:
    assert place(FrameGraph(OUTER).pose(frame, "__model__")) == expected


def test_a_nested_model_moves_with_its_canonical_link() -> None:
    assert FrameGraph(OUTER).body("inner") == "inner::root"
    assert FrameGraph(Model(name="m", models=OUTER.models)).body("__model__") == "inner::root"
    assert FrameGraph(OUTER.copy(canonical_link="inner::hand")).body("__model__") == "inner::hand"
    assert FrameGraph(Model(name="empty", static=True)).body("__model__") == "__model__"


def test_a_world_places_its_models() -> None:
    world = World(
        name="w",
        models=(ARM, Model(name="box", pose=at(1, relative_to="arm"), links=(Link(name="box"),))),
        frames=(Frame(name="dock", attached_to="arm::b", pose=at(0, 1)), Frame(name="stake", pose=at(4))),
        includes=(Include(uri="model://x", name="x", pose=at(0, 0, 3)),),
    )
    graph = FrameGraph(world)
    assert place(graph.pose("box::box", "world")) == (101, 0, 0)
    assert place(graph.pose("dock", "world")) == (101, 0, 0)
    assert place(graph.pose("x", "stake")) == (-4, 0, 3)
    assert graph.body("dock") == "arm::b"
    assert graph.body("stake") == "world"


def test_a_link_and_a_joint_of_one_name_are_distinguished() -> None:
    robot = Model(
        name="r",
        links=(Link(name="base"), Link(name="hip", pose=Pose(relative_to="hip"))),
        joints=(
            joint("hip", "base", "hip", at(3, relative_to="base")),
            joint("knee", "hip", "base2", at(1, relative_to="hip")),
        ),
    )
    graph = FrameGraph(robot)
    assert place(graph.pose("hip", "base", kind="link")) == (3, 0, 0)
    assert place(graph.pose("knee", "base", kind="joint")) == (4, 0, 0)


def chain(count: int, **first: object) -> Model:
    links = [Link(name="l0", **first)]  # pyright: ignore[reportArgumentType] - the fields of a link
    joints: list[Joint] = []
    for i in range(1, count):
        joints.append(joint(f"j{i}", f"l{i - 1}", f"l{i}", at(1, relative_to=f"l{i - 1}")))
        links.append(Link(name=f"l{i}", pose=Pose(relative_to=f"j{i}")))
    frames = (
        Frame(name="f0", attached_to="l0"),
        *(Frame(name=f"f{i}", attached_to=f"f{i - 1}") for i in range(1, count)),
    )
    return Model(name="chain", links=tuple(links), joints=tuple(joints), frames=frames)


def test_long_chains_are_no_recursion() -> None:
    graph = FrameGraph(chain(10_000))
    assert place(graph.pose("l9999", "l0")) == (9999, 0, 0)
    assert sum(graph.pose(f"l{i}", "__model__").translation[0] for i in range(10_000)) == 9999 * 5000
    assert graph.body("f9999") == "l0"


@pytest.mark.parametrize(
    ("model", "ask", "rule", "line"),
    [
        (
            Model(name="m", links=(Link(name="a", pose=Pose(relative_to="b"), source=Source("", 7, None, "link")),)),
            "a",
            "dangling-frame",
            7,
        ),
        (
            Model(
                name="m",
                links=(Link(name="a"), Link(name="b", pose=Pose(relative_to="j"))),
                joints=(joint("j", "a", "b").copy(source=Source("", 8, None, "joint")),),
            ),
            "j",
            "frame-cycle",
            8,
        ),
        (chain(5000, pose=Pose(relative_to="l4999")), "l7", "frame-cycle", 0),
        (
            Model(name="m", links=(Link(name="a", pose=Pose(relative_to="a"), source=Source("", 9, None, "link")),)),
            "a",
            "frame-cycle",
            9,
        ),
    ],
)
def test_what_cannot_be_resolved_is_a_located_error(model: Model, ask: str, rule: str, line: int) -> None:
    with pytest.raises(FrameError) as caught:
        FrameGraph(model).pose(ask, "__model__")
    sink = DiagnosticSink()
    caught.value.report(sink)
    assert [(each.rule.name, each.location.line, each.is_error) for each in sink.diagnostics] == [(rule, line, True)]


def source(line: int, tag: str) -> Source:
    return Source("m.sdf", line, None, tag)


@pytest.mark.parametrize(
    ("where", "line"),
    [(Source("m.sdf", 7, None, "pose"), 7), (None, 3)],
    ids=["the pose that names it", "the model where the pose was not written"],
)
def test_an_unknown_frame_is_reported_where_it_is_named(where: Source | None, line: int) -> None:
    graph = FrameGraph(ARM.copy(source=source(3, "model")))
    with pytest.raises(FrameError) as caught:
        graph.resolve(at(1, relative_to="nowhere").copy(source=where), "a", "b")
    error = caught.value
    assert (error.rule.name, error.message, error.found) == (
        "dangling-frame",
        "there is no frame 'nowhere'",
        "nowhere",
    )
    assert (error.location.file, error.location.line) == ("m.sdf", line)


def test_a_frame_without_a_body_is_reported_where_it_was_asked_for() -> None:
    with pytest.raises(FrameError, match="there is no frame 'nowhere'") as caught:
        FrameGraph(ARM).body("nowhere", source=source(5, "plugin"))
    assert caught.value.location.line == 5
    for question in (lambda: FrameGraph(ARM).resolve(at(1), "nowhere", "b"), lambda: FrameGraph(ARM).pose("a", "x")):
        with pytest.raises(FrameError, match="there is no frame"):
            question()


def test_a_pose_names_a_joint_rather_than_a_link_of_the_same_name() -> None:
    robot = Model(
        name="r",
        links=(Link(name="base"), Link(name="hip", pose=at(5)), Link(name="leg", pose=Pose(relative_to="hip"))),
        joints=(joint("hip", "base", "leg", at(3, relative_to="base")),),
    )
    graph = FrameGraph(robot)
    assert place(graph.resolve(at(1, relative_to="hip"), "base", "base")) == (4, 0, 0)
    assert place(graph.resolve(at(1), "hip", "base")) == (6, 0, 0)
    assert place(graph.resolve(at(1), "hip", "base", kind="joint")) == (4, 0, 0)
    assert place(graph.resolve(at(1), "base", "hip", base="joint")) == (-2, 0, 0)


def test_every_frame_that_cannot_be_resolved_is_a_problem() -> None:
    frames = (Frame(name="f", attached_to="x", source=source(4, "frame")), Frame(name="g", attached_to="g"))
    lost = Link(name="a", pose=at(1, relative_to="y"), source=source(6, "link"))
    found = list(FrameGraph(Model(name="m", links=(lost,), frames=frames)).problems())
    assert [(each.rule.name, each.location.line, each.found) for each in found] == [
        ("dangling-frame", 6, "y"),
        ("dangling-frame", 4, "x"),
        ("frame-cycle", 0, "g"),
    ]


def test_frames_attached_in_a_circle_are_an_error() -> None:
    frames = (Frame(name="f", attached_to="g"), Frame(name="g", attached_to="f"))
    with pytest.raises(FrameError, match="frame 'f' is attached to frame 'g' is attached to frame 'f'"):
        FrameGraph(Model(name="m", frames=frames)).body("f")


def test_an_error_leaves_the_graph_usable() -> None:
    model = Model(name="m", links=(Link(name="a", pose=Pose(relative_to="a")), Link(name="b", pose=at(1))))
    graph = FrameGraph(model)
    for _ in range(2):
        with pytest.raises(FrameError):
            graph.pose("a", "b")
    assert place(graph.pose("b", "__model__")) == (1, 0, 0)


def test_the_world_is_the_same_one_inside_a_nested_model() -> None:
    inner = Model(name="inner", pose=at(1), links=(Link(name="l", pose=at(7, relative_to="world")),))
    assert place(FrameGraph(Model(name="m", pose=at(10), models=(inner,))).pose("inner::l", "__model__")) == (-3, 0, 0)
    assert place(FrameGraph(World(name="w", models=(inner,))).pose("inner::l", "world")) == (7, 0, 0)


def test_what_places_a_model_in_a_world_is_looked_for_when_it_is_asked_for() -> None:
    graph = FrameGraph(Model(name="m", placement_frame="nowhere", links=(Link(name="l", pose=at(1)),)))
    assert place(graph.pose("l", "__model__")) == (1, 0, 0)
    with pytest.raises(FrameError, match="there is no frame 'nowhere'"):
        graph.pose("l", "world")
