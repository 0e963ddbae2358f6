"""Profiles: their names, releases and rows, and what holds for all data."""

import re
from dataclasses import replace

import pytest

from twinform.diagnostics import Diagnostic, Location, Severity, catalog
from twinform.diagnostics.rules import IMPOSSIBLE_INERTIA
from twinform.ir import Format
from twinform.passes import parse_pipeline
from twinform.profiles import Effect, Profile, ProfileRow, UnknownProfileError, load, names, parse
from twinform.profiles.assessment import RULES_OF_FACTS
from twinform.profiles.profile import PORTABLE, all_rows, releases_of
from twinform.profiles.reads_tables import demands_by_release, reads
from twinform.profiles.remedies import REMEDIES, in_order
from twinform.profiles.tree_facts import FACTS

_EVERY = [profile for name in names() if name != PORTABLE for profile in load(name)]
_FINDING = Diagnostic(
    IMPOSSIBLE_INERTIA, "of link 'a'", Location("a.urdf", 3, "/robot/link/inertial"), Severity.WARNING
)


def _pipelines(profile: Profile) -> set[str]:
    demands = reads(profile.reads).demands if profile.reads else ()
    return {each.pipeline for each in (*profile.rows, *demands) if each.pipeline}


@pytest.mark.parametrize("profile", _EVERY, ids=lambda each: each.name)
def test_every_row_names_a_rule_and_passes_that_there_are(profile: Profile) -> None:
    known, remedies = set(catalog()), {each.name for each in REMEDIES}
    assert {row.rule for row in profile.rows} <= known
    assert {step.name for text in _pipelines(profile) for step in parse_pipeline(text)} <= remedies


@pytest.mark.parametrize("profile", _EVERY, ids=lambda each: each.name)
def test_what_was_tested_says_in_which_version(profile: Profile) -> None:
    assert profile.tested == any(each.seen for each in releases_of(profile.name))
    assert profile.formats
    assert profile.label.startswith(f"{profile.title} ")


@pytest.mark.parametrize("profile", _EVERY, ids=lambda each: each.name)
def test_every_release_was_tested_or_read_somewhere_and_has_names_of_its_own(profile: Profile) -> None:
    releases = releases_of(profile.name)
    assert all(bool(each.seen) != bool(each.source) for each in releases) or not profile.tested
    named = [name for each in releases for name in each.names]
    assert len(named) == len(set(named))
    assert all(parse(f"{profile.name}@{name}")[0].release.names.count(name) for name in named)


@pytest.mark.parametrize("profile", _EVERY, ids=lambda each: each.name)
def test_what_holds_for_no_release_that_was_asked_says_where_it_was_read(profile: Profile) -> None:
    for demand, releases in demands_by_release(profile.name).items():
        assert demand.source or any(each.seen for each in releases) or not profile.tested, demand
    asked = [each.name for each in releases_of(profile.name) if each.seen]
    rows = [row for name in asked for row in load(f"{profile.name}@{name}")[0].rows]
    assert all(row.source or row in rows or not profile.tested for row in all_rows(profile.name))


def test_what_facts_share_with_check_are_facts_and_rules() -> None:
    assert set(RULES_OF_FACTS) <= set(FACTS)
    assert {name for rules in RULES_OF_FACTS.values() for name in rules} <= set(catalog())


def test_every_remedy_is_needed_by_a_profile() -> None:
    needed = {step.name for profile in _EVERY for text in _pipelines(profile) for step in parse_pipeline(text)}
    assert {each.name for each in REMEDIES} == needed


def test_every_remedy_that_is_asked_for_runs_once_and_in_order() -> None:
    options = {"convert-meshes": "{for=mujoco}"}
    pipeline = ",".join(each.name + options.get(each.name, "") for each in reversed(REMEDIES))
    steps = [*parse_pipeline(pipeline), *parse_pipeline(pipeline)]
    assert [step.name for step in in_order(steps)] == [each.name for each in REMEDIES]


def test_portable_is_all_that_are_tested() -> None:
    assert {each.name for each in load(PORTABLE)} == {each.name for each in _EVERY if each.tested}
    assert not any(each.named for each in load(PORTABLE))


def test_a_release_is_named_behind_an_at_sign() -> None:
    (fortress,), (harmonic,) = load("gazebo@fortress"), load("gazebo@harmonic")
    assert (fortress.release.sdf, harmonic.release.sdf) == ("1.9", "1.11")
    assert (fortress.label, harmonic.label) == ("Gazebo fortress", "Gazebo harmonic")
    assert [each.release for each in load("gazebo")] == [harmonic.release]


def test_a_distribution_is_a_name_of_a_release() -> None:
    (jazzy,), (four,) = load("urdfdom@jazzy"), load("urdfdom@4.0")
    assert jazzy.release == four.release
    assert [each.label for each in parse("urdfdom@jazzy,urdfdom@4.0,urdfdom")] == ["urdfdom 4.0.1"]


def test_what_is_built_on_urdfdom_has_the_releases_that_distributions_ship() -> None:
    (moveit,) = load("moveit@rolling")
    assert (moveit.label, moveit.reads, moveit.release.urdf) == ("MoveIt rolling", "urdfdom@lyrical", "1.2")
    assert "5.1" not in {name for each in releases_of("moveit") for name in each.names}


def test_names_with_commas_between_each_once() -> None:
    assert [each.name for each in parse("mujoco, drake,mujoco")] == ["mujoco", "drake"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("mujocco", "there is no profile 'mujocco'; did you mean 'mujoco'?"),
        ("gazebo@harmonics", "has no release 'harmonics'; did you mean 'harmonic'?"),
        ("drake@1", "'drake' has no release '1'; there are 1.51"),
        ("moveit@jazy", "'moveit' has no release 'jazy'; did you mean 'jazzy'?"),
        ("portable@1", "'portable' has no releases"),
        (",", "name a profile"),
        ("", "name a profile"),
        ("../../etc/passwd", "there is no profile"),
    ],
)
def test_names_that_there_are_not(text: str, message: str) -> None:
    with pytest.raises(UnknownProfileError, match=re.escape(message)):
        parse(text)


@pytest.mark.parametrize(
    ("conditions", "minded"),
    [
        ({}, True),
        ({"format": Format.URDF}, True),
        ({"format": Format.SDF}, False),
        ({"message": r"link 'a'$"}, True),
        ({"message": "joint"}, False),
        ({"place": "/inertial$"}, True),
        ({"place": "/joint"}, False),
    ],
)
def test_conditions_narrow_a_row(conditions: dict[str, object], minded: bool) -> None:
    row = ProfileRow.model_validate({"rule": "impossible-inertia", "effect": Effect.REFUSES, "about": "", **conditions})
    assert row.minds(_FINDING, Format.URDF) is minded
    assert not row.minds(replace(_FINDING, rule=next(iter(catalog().values()))), Format.URDF)


def test_a_pattern_that_is_none_is_refused() -> None:
    with pytest.raises(re.error):
        ProfileRow.model_validate({"rule": "a", "effect": "refuses", "about": "", "message": "("})
