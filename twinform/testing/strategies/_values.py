"""Numbers, vectors and poses."""

from typing import Any

from hypothesis import strategies as st

from twinform.ir import Pose

_FEW = (0.0, 1.0, -0.5, 0.25, 1e-3)


def numbers(*, min_value: float = -1e3, max_value: float = 1e3) -> st.SearchStrategy[float]:
    """Finite numbers, simple ones first."""
    simple = [value for value in _FEW if min_value <= value <= max_value] or [min_value]
    return st.sampled_from(simple) | st.floats(min_value, max_value, allow_nan=False, width=64)


def vectors(*, min_value: float = -10, max_value: float = 10) -> st.SearchStrategy[tuple[float, float, float]]:
    """Three numbers, in meters or radians as it comes."""
    each = numbers(min_value=min_value, max_value=max_value)
    return st.tuples(each, each, each)


def maybe(strategy: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """What the strategy gives, or nothing."""
    return st.none() | strategy


def poses(*, whole: bool = False) -> st.SearchStrategy[Pose]:
    """Poses of roll, pitch and yaw that are not empty; `whole` ones have both parts, as SDF must."""
    if whole:
        return st.builds(Pose, xyz=vectors(), rpy=vectors(min_value=-3.2, max_value=3.2))
    parts = st.tuples(maybe(vectors()), maybe(vectors(min_value=-3.2, max_value=3.2)))
    return parts.filter(lambda pair: pair != (None, None)).map(lambda pair: Pose(xyz=pair[0], rpy=pair[1]))
