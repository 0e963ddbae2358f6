"""Every rule has a case that triggers it and one that does not; where no case file can, a test does."""

from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import twinform
from twinform.diagnostics import Diagnostic, LedgerEntry, catalog
from twinform.testing import Case, cases, mjcf_cases, pass_cases

_TESTS = Path(__file__).parent
_CASES = _TESTS / "cases"
_PARTS = _CASES / "includes/parts"

WITHOUT_CASE = {
    "automatic-inertia": "unit/passes/legalise/to_urdf/test_refusals.py",
    "bare-script": "portability/gazebo.toml",
    "late-sensor": "portability/gazebo.toml",
    "model-joint-end": "portability/gazebo.toml",
    "empty-attribute": "portability/gazebo.toml",
    "edit-conflict": "unit/cli/test_run_conversion.py",
    "changed-physics": "unit/cli/test_project_options.py",
    "collada-mesh": "unit/profiles/test_detectors.py",
    "kept-physics": "unit/cli/test_project_options.py",
    "root-inertia": "unit/profiles/test_detectors.py",
    "unread-format": "unit/cli/test_project_options.py",
    "foreign-hardware": "unit/compiler/packaging/test_gazebo_control.py",
    "flat-collision": "portability/gazebo.toml",
    "frame-elsewhere": "unit/compiler/packaging/test_ros2_packages.py",
    "frame-not-in-tf": "unit/compiler/packaging/test_ros2_packages.py",
    "joint-type-unsupported": "unit/passes/legalise/to_urdf/test_refusals.py",
    "kept-as-sdf": "unit/compiler/test_split_world.py",
    "measured-wheels": "unit/passes/plugins/test_add_plugin.py",
    "merged-away": "unit/compiler/test_expand_includes.py",
    "mesh-reader-missing": "unit/passes/shared/test_mesh_solids.py",
    "detailed-collision": "unit/compiler/test_mistakes_in_meshes.py",
    "loosened-fixed-joint": "unit/profiles/test_detectors.py",
    "no-differential-drive": "unit/compiler/packaging/test_controllers.py",
    "no-joint-states": "unit/compiler/packaging/test_ros2_packages.py",
    "no-thumbnail": "unit/compiler/packaging/test_thumbnail.py",
    "narrow-view": "portability/gazebo.toml",
    "nested-in-engine": "portability/gazebo.toml",
    "nested-too-deeply": "unit/passes/legalise/to_mjcf/test_bodies.py",
    "nothing-to-add-to": "unit/passes/plugins/test_add_plugin.py",
    "open-mesh": "unit/passes/shared/test_mesh_solids.py",
    "package-name": "unit/compiler/packaging/test_ros2_packages.py",
    "placeholder": "unit/cli/test_package.py",
    "renamed-collision": "unit/profiles/test_lost_tags.py",
    "replaced-controllers-file": "unit/compiler/packaging/test_gazebo_control.py",
    "broken-footprint": "unit/cli/test_check_companions.py",
    "broken-parameters": "unit/cli/test_check_companions.py",
    "broken-semantics": "unit/cli/test_check_companions.py",
    "impossible-state": "unit/cli/test_check_companions.py",
    "loosened-limit": "unit/cli/test_check_companions.py",
    "missing-interface": "unit/cli/test_check_companions.py",
    "repeated-key": "unit/cli/test_check_companions.py",
    "repeated-semantics": "unit/cli/test_check_companions.py",
    "robot-not-found": "unit/cli/test_check_companions.py",
    "stale-frame": "unit/cli/test_check_companions.py",
    "stale-name": "unit/cli/test_check_companions.py",
    "rare-joint-type": "portability/gazebo.toml",
    "schema-disagreement": "unit/schemas/test_validator.py",
    "threadless-screw": "portability/gazebo.toml",
    "too-many-includes": "unit/compiler/test_expand_includes.py",
    "unbridged-topic": "unit/passes/plugins/test_bridge_config.py",
    "unread-part": "unit/profiles/test_walking.py",
    "unread-text": "unit/profiles/test_walking.py",
    "unread-value": "unit/profiles/test_walking.py",
    "uncertain-inertia": "portability/gazebo.toml",
    "uncontrolled-joint": "unit/compiler/packaging/test_controllers.py",
    "unpackaged-file": "unit/cli/test_package.py",
    "unpackaged-include": "unit/cli/test_package.py",
    "unpackaged-parameter": "unit/cli/test_package.py",
    "untagged-shape": "unit/profiles/test_lost_tags.py",
    "untaken-tree": "unit/profiles/test_walking.py",
    "unusable-axis": "portability/gazebo.toml",
    "unused-argument": "unit/compiler/input/test_expand_xacro.py",
    "usd-only-compared": "unit/compiler/usd/test_read_usd.py",
    "usd-reader-missing": "unit/compiler/usd/test_read_usd.py",
    "unwritten-part": "unit/profiles/test_walking.py",
    "weightless-mover": "portability/gazebo.toml",
    "wheels-not-measured": "unit/passes/plugins/test_add_plugin.py",
    "wide-encoding": "unit/compiler/input/test_parsing.py",
    "wrong-configuration": "unit/cli/test_nested_config.py",
    "xacro-message": "unit/compiler/input/test_expand_xacro.py",
    "xacro-missing": "unit/compiler/input/test_expand_xacro.py",
    "xacro-refused": "unit/compiler/input/test_expand_xacro.py",
}
"""Rules that need more than one file, an option or a fault of our own, and the test that triggers each and does not."""


@cache
def _found() -> dict[str, set[str]]:
    """The rules that each case triggers, by the path of the case."""
    found: dict[str, set[str]] = defaultdict(set)
    for folder in ("check", "mjcf", "xacro"):
        for case in cases(_CASES / folder):
            found[_name(case)] = _rules(twinform.check(case.path).diagnostics)
    for case in cases(_CASES / "includes"):
        checked = twinform.check(case.path, expand_includes=True, paths=[_PARTS])
        found[_name(case)] = _rules(checked.diagnostics)
    for folder in ("convert", "from_mjcf"):
        for case in cases(_CASES / folder):
            found[_name(case)] = set(_of_conversion(case, None))
    for case in cases(_CASES / "versions"):
        found[_name(case)] = set(_of_conversion(case, "1.4"))
    for case in mjcf_cases(_CASES / "to_mjcf"):
        found[_name(case)] = set(case.rules)
    for case in pass_cases(_CASES / "passes"):
        found[_name(case)] = set(case.rules)
    return found


def _name(case: Case) -> str:
    return str(case.path.relative_to(_CASES))


def _rules(diagnostics: tuple[Diagnostic | LedgerEntry, ...]) -> set[str]:
    return {each.rule.name for each in diagnostics}


def _of_conversion(case: Case, version: str | None) -> Iterator[str]:
    """Also the rules of the ledger."""
    to = "sdf" if version or case.path.suffix == ".urdf" else "urdf"
    try:
        made = twinform.convert(case.path, to=to, sdf_version=version)
    except twinform.CompileError as error:
        yield from _rules(error.diagnostics)
        return
    yield from _rules(made.diagnostics) | _rules(made.ledger.entries)


def test_a_case_triggers_each_rule_or_the_table_names_a_test() -> None:
    triggered = set[str]().union(*_found().values())
    assert set(catalog()) - triggered == set(WITHOUT_CASE), "either a case or a row of the table, and never both"


def test_the_tests_of_the_table_are_about_their_rules() -> None:
    for rule, test in WITHOUT_CASE.items():
        text = (_TESTS / test).read_text(encoding="utf-8")
        assert rule in text or rule.upper().replace("-", "_") in text, rule


def test_a_case_of_the_same_folder_does_not_trigger_it() -> None:
    for rule in set(catalog()) - set(WITHOUT_CASE):
        folders = {str(Path(name).parent) for name, rules in _found().items() if rule in rules}
        others = {str(Path(name).parent) for name, rules in _found().items() if rule not in rules}
        assert folders <= others, rule
