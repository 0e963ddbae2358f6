"""The pure parts of `make bench`: ratios, medians, targets, stages and tables."""

from collections.abc import Mapping
from pathlib import Path

import pytest

from benchmarks import converters, real_files, scale, sizes, stages
from benchmarks.before import Figures
from benchmarks.engines import Answer
from benchmarks.inputs import Robot
from benchmarks.targets import Part, at_least, at_most, target_table
from benchmarks.turns import cell, deciles, in_turns, middle, ratio


class Scripted:
    """An engine that answers what it is told to."""

    def __init__(self, name: str, *answers: Answer) -> None:
        self.name, self.answers, self.asked = name, list(answers), 0

    def ask(self, _path: Path) -> Answer:
        self.asked += 1
        return self.answers[min(self.asked, len(self.answers)) - 1]


def test_each_engine_has_the_median_of_its_turns():
    one = Scripted("one", Answer(3), Answer(1), Answer(2))
    found = in_turns([one], Path("robot.urdf"), 3)  # pyright: ignore[reportArgumentType]
    assert found == {"one": Answer(2)}


def test_engines_that_refuse_or_are_slow_get_no_further_turn():
    refusing, slow = Scripted("refusing", Answer(refused="no")), Scripted("slow", Answer(40))
    found = in_turns([refusing, slow], Path("robot.urdf"), 5)  # pyright: ignore[reportArgumentType]
    assert found == {"refusing": Answer(refused="no"), "slow": Answer(40)}
    assert (refusing.asked, slow.asked) == (1, 1)


def test_a_refusal_in_a_later_turn_is_no_time():
    assert middle([Answer(1), Answer(refused="crashed")]).refused == "crashed"


def test_there_is_no_ratio_of_a_refusal():
    assert ratio(Answer(6), Answer(2)) == 3
    assert ratio(Answer(refused="no"), Answer(2)) is None
    assert ratio(Answer(6), Answer(refused="no")) is None


@pytest.mark.parametrize(
    ("answer", "base", "expected"),
    [
        (Answer(0.00012), None, "0.12"),
        (Answer(0.012), Answer(0.002), "12 (6.0)"),
        (Answer(32.371), None, "32,371"),
        (Answer(refused="no such file"), Answer(1), "refuses"),
        (Answer(refused="no answer in 300 s"), None, "no answer"),
    ],
)
def test_cells_are_milliseconds_and_times_the_base(answer: Answer, base: Answer | None, expected: str):
    assert cell(answer, base) == expected


def test_deciles_are_ordered_and_known_for_one_value():
    assert deciles([5.0]) == (5, 5, 5, 5, 5)
    assert deciles([float(number) for number in range(11)]) == (0, 1, 5, 9, 10)


def test_targets_are_met_by_the_worst_figure():
    assert at_most("a", 7, [1, 7]).met is True
    assert at_most("a", 7, [1, 7.01]).met is False
    assert at_least("a", 3, [3, 9]).met is True
    assert at_least("a", 3, [2.99, 9]).met is False


def test_a_target_with_a_missing_figure_is_not_met_and_one_without_figures_is_open():
    assert at_most("a", 7, [1, None]).met is False
    assert at_most("a", 7, [1, None]).measured == "1, 1 refused"
    assert at_most("a", 7, [None]).measured == "1 refused"
    assert at_least("a", 7, []).met is None


def test_what_is_shown_is_what_is_judged():
    assert (at_most("a", 7, [7.004]).measured, at_most("a", 7, [7.004]).met) == ("7.004", False)
    assert (at_most("a", 7, [7.0004]).measured, at_most("a", 7, [7.0004]).met) == ("7", True)


def test_the_table_of_targets_says_which_are_met():
    text = target_table(
        [Part("", [at_most("load", 7, [6.5], " ms"), at_least("faster", 3, [2]), at_least("x", 3, [])])]
    )
    assert text.splitlines()[2:] == [
        "| load | at most 7 ms | 6.5 ms | yes |",
        "| faster | at least 3 | 2 | **no** |",
        "| x | at least 3 | not measured |  |",
    ]


@pytest.mark.parametrize(
    ("stack", "stage"),
    [
        (["schemas/validator.py", "compiler/output/emitting.py", "compiler/driver.py"], "XSD of the output"),
        (["schemas/validator.py", "compiler/input/loading.py"], "XSD of the input"),
        (["ir/verify/links.py", "compiler/input/loading.py"], "verify the input"),
        (["ir/verify/links.py", "passes/framework/pipeline.py", "compiler/output/emitting.py"], "verify the result"),
        (["ir/rewrite.py", "passes/legalise/to_sdf/merge.py", "compiler/output/emitting.py"], "passes"),
        (["schemas/text_output.py", "compiler/output/write_sdf.py"], "write"),
        (["compiler/input/parsing.py", "compiler/input/loading.py"], "parse"),
        (["/lib/pydantic/main.py", "compiler/input/loading.py"], "Pydantic"),
        (["schemas/reader.py", "compiler/input/read_urdf.py"], "read"),
        (["compiler/driver.py"], stages.REST),
    ],
)
def test_a_stack_belongs_to_the_stage_of_its_files(stack: list[str], stage: str):
    assert stages.stage_of(stack) == stage


def test_stages_are_shown_with_their_shares():
    text = stages.page({"tree": {"passes": 0.3, "write": 0.1}, "nothing": {}})
    assert "| passes | 300 ms (75%) |  |" in text
    assert "| all | 400 ms | 0 ms |" in text


def test_a_conversion_is_sampled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(stages, "ENOUGH", 0.2)
    path = tmp_path / "robot.urdf"
    path.write_text('<robot name="a"><link name="b"/></robot>')
    found = stages.profile([path], "sdf")
    assert found
    assert sum(found.values()) < 0.2


def row(name: str, ours: Answer, theirs: Answer) -> converters.Row:
    once = "libsdformat, its description read before"
    times: Mapping[str, Answer] = {"to SDF": ours, "libsdformat": theirs, once: theirs}
    return converters.Row(Robot(name, Path(name), 10, "tree"), times)


def test_files_are_compared_where_both_have_a_time_and_the_least_ratio_is_first():
    rows = [row("a", Answer(1), Answer(8)), row("b", Answer(1), Answer(4)), row("c", Answer(1), Answer(refused="no"))]
    assert [(faster, each.robot.name) for faster, each in converters.compared(rows)] == [(4, "b"), (8, "a")]


def test_a_robot_is_held_to_the_floor_of_what_it_is_read_from():
    times = {
        "floor": Answer(1),
        "load": Answer(7),
        "to SDF": Answer(14),
        "floor of the SDF": Answer(2),
        "to URDF": Answer(40),
    }
    found = sizes.Row(Robot("tree of 10", Path("a"), 10, "tree"), times)
    assert [found.over_floor(name) for name in ("load", "to SDF", "to URDF")] == [7, 14, 20]


def test_sums_of_both_loads_are_held_to_one_target():
    figures = {"load URDF": Figures(), "load SDF": Figures()}
    figures["load URDF"].seconds.update(before=1.0, now=0.2)
    figures["load SDF"].seconds.update(before=3.0, now=2.2)
    targets = real_files.targets(figures)
    assert [(each.measured, each.met) for each in targets] == [
        ("0.6", True),
        ("not measured", None),
        ("not measured", None),
    ]


def test_growth_is_of_the_time_for_a_link():
    first, last = scale.Run("tree", "SDF", 1_000, seconds=1), scale.Run("tree", "SDF", 100_000, seconds=120)
    assert scale.growth(first, last) == pytest.approx(1.2)
    assert scale.growth(first, scale.Run("tree", "SDF", 100_000, refused="too large")) is None


def test_a_refused_size_is_named_and_misses_its_targets():
    runs = [scale.Run("tree", "SDF", 1_000, 1, 0.1), scale.Run("tree", "SDF", 100_000, refused="too large")]
    assert "| refused |  |  | too large |" in scale.runs_table(runs)
    assert [each.met for each in scale.targets(runs)] == [False, False]


def test_the_peak_of_memory_is_that_of_this_process():
    assert 0.01 < scale.peak_gigabytes() < 10
