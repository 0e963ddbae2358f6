"""Whether two files are the same robot in Gazebo's physics: what one engine has of each, compared."""

from collections.abc import Iterator

from testbed.engines.gazebo.differing import AT_REST, LEAST, Difference, Tolerances, pose_apart, short
from testbed.engines.gazebo.joints import joint_differences
from testbed.engines.gazebo.motion import motion_differences
from testbed.engines.gazebo.results import Moment, Simulation
from twinform.passes.carriers.token_mass import CHAIN_MASS


def differences(
    reference: Simulation, result: Simulation, tolerances: Tolerances, *, frames: bool = True
) -> Iterator[Difference]:
    """What differs in the result. Links and joints are known by their names without that of their model.

    Fixed joints and the links on them may be there or not: libsdformat lumps them. Without `frames`, where link frames
    are is not compared, only how links and joints move.
    """
    if not result.done:
        yield Difference("does not load", "", f"{result.outcome} at {result.stage}: {_reasons(result)}")
        return
    yield from _new_lines(reference, result)
    yield from joint_differences(reference, result, tolerances)
    if frames:
        yield from _compare_at_rest(reference.moments[0], result.moments[0], tolerances)
    yield from _mass(reference, result)
    if tolerances.moved is not None:
        yield from motion_differences(reference, result, tolerances.moved)


def _reasons(simulation: Simulation) -> str:
    return "; ".join((*simulation.errors, *simulation.console.errors, *simulation.console.other[-2:]))


def _new_lines(reference: Simulation, result: Simulation) -> Iterator[Difference]:
    for kind, before, now in (
        ("new error line", reference.console.errors, result.console.errors),
        ("new warning line", reference.console.warnings, result.console.warnings),
    ):
        yield from (Difference(kind, "", line) for line in dict.fromkeys(now) if line not in before)


def _compare_at_rest(reference: Moment, result: Moment, tolerances: Tolerances) -> Iterator[Difference]:
    now = {short(name): state for name, state in result.links.items()}
    for name, state in reference.links.items():
        if short(name) not in now:
            yield Difference("link is missing", short(name))
        elif (gap := max(pose_apart(state.pose, now[short(name)].pose))) > tolerances.at_rest:
            yield Difference("pose at rest", short(name), f"{gap:.1e} apart")


def _masses(simulation: Simulation) -> float | None:
    """All mass, but for that of the links between the joints of a chain."""
    masses = [link.mass for link in simulation.links if link.mass is not None and link.mass != CHAIN_MASS]
    return sum(masses) if masses else None


def _mass(reference: Simulation, result: Simulation) -> Iterator[Difference]:
    before, now = _masses(reference), _masses(result)
    if before is not None and now is not None and abs(before - now) > LEAST + AT_REST * before:
        yield Difference("mass", "", f"{before:.6g} became {now:.6g}")
