"""Short texts of both formats, and how they compare."""

from twinform.compiler.normal_form import normal_form


def robot(content: str, head: str = "") -> str:
    """A URDF with this in it; `head` are more attributes of the robot."""
    return f'<robot name="r"{head}>{content}</robot>'


def link(content: str) -> str:
    """A URDF with a link of this content."""
    return robot(f'<link name="l">{content}</link>')


def joint(content: str) -> str:
    """A URDF with a joint of this content."""
    return robot(f'<joint name="j" type="revolute">{content}</joint>')


def sdf(content: str, version: str = "1.9") -> str:
    """An SDF with a model of this content."""
    return f'<sdf version="{version}"><model name="m">{content}</model></sdf>'


def sdf_link(content: str, version: str = "1.9") -> str:
    """An SDF with a link of this content."""
    return sdf(f'<link name="l">{content}</link>', version)


def compared(source: str, back: str) -> list[str]:
    """What the normal forms of two texts differ in: kind, path, and the text of either."""
    found = normal_form(source.encode()).compare(normal_form(back.encode()))
    texts = ((one, " -> ".join(text for text in (one.source.text, one.back.text) if text is not None)) for one in found)
    return [f"{one.kind} {one.location.path} {text}" for one, text in texts]
