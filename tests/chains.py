"""Robots that are chains of links."""


def chain(count: int) -> str:
    """The text of a URDF robot of so many links, called `l0` and so on, each fixed to the one before it."""
    links = "".join(f'<link name="l{i}"/>' for i in range(count))
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="l{i - 1}"/><child link="l{i}"/></joint>'
        for i in range(1, count)
    )
    return f'<robot name="r">{links}{joints}</robot>'
