"""Findings that only follow from an error: of what could not be read, or has a value that is not in the file."""

from collections.abc import Callable, Collection, Iterable, Iterator

from twinform.diagnostics import Diagnostic, rules
from twinform.lazy import lazy_pattern
from twinform.schemas.messages import StandIn

_OF_LIMITS = frozenset({rules.MISSING_LIMIT, rules.PARTIAL_LIMIT})
_OF_NAMES = frozenset({rules.EMPTY_NAME, rules.DUPLICATE_NAME, rules.SHARED_NAME})
_OF_THE_TREE = frozenset({rules.SEVERAL_ROOTS, rules.EMPTY_MODEL})
_REFERENCES = frozenset(
    {
        rules.DANGLING_FRAME,
        rules.DANGLING_LINK,
        rules.UNKNOWN_CANONICAL_LINK,
        rules.UNKNOWN_DRIVEN_JOINT,
        rules.UNKNOWN_GRIPPER_LINK,
        rules.UNKNOWN_LEADER,
        rules.UNKNOWN_REFERENCE,
    }
)
_JOINT = lazy_pattern(r".*/joint(?:\[(?:@name='.*?'|\d+)\])?(?=/|$)")
_ENDS = ("/parent", "/child")


def without_consequences(
    found: Iterable[Diagnostic], errors: Iterable[Diagnostic], stand_ins: Collection[StandIn]
) -> list[Diagnostic]:
    """Return the findings about a document that do not merely follow from errors of reading, or from stand-ins."""
    paths = [each.location.path for each in errors if each.is_error]
    follows = [*_of_errors(paths), *_of_stand_ins(stand_ins)] if paths else []
    return [each for each in found if not any(rule(each) for rule in follows)]


def _of_errors(paths: Iterable[str]) -> Iterator[Callable[[Diagnostic], bool]]:
    places = [(joint, path.removeprefix(joint)) for path in paths if (joint := _joint_of(path))]
    without_limits = {joint for joint, rest in places if "/limit" in rest}
    yield lambda each: each.rule in _OF_LIMITS and _joint_of(each.location.path) in without_limits
    if any(not rest or rest.startswith(_ENDS) for _, rest in places):
        yield lambda each: each.rule in _OF_THE_TREE
    if any("/material" in path for path in paths):
        yield lambda each: each.rule is rules.UNKNOWN_MATERIAL


def _of_stand_ins(stand_ins: Iterable[StandIn]) -> Iterator[Callable[[Diagnostic], bool]]:
    untyped = {each.path: each.name for each in stand_ins if each.field == "type"}
    yield lambda each: _joint_of(each.location.path) in untyped and not each.location.path.endswith(_ENDS)
    yield lambda each: each.rule is rules.UNKNOWN_LEADER and each.found in untyped.values()
    if any(each.field == "name" for each in stand_ins):
        yield lambda each: each.rule in _REFERENCES or each.rule in _OF_THE_TREE
        yield lambda each: each.rule in _OF_NAMES and not each.found


def _joint_of(path: str) -> str:
    """Return the path of the joint that a path leads into; empty if it leads into none."""
    found = _JOINT.match(path)
    return found[0] if found else ""
