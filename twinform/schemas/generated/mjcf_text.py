"""From nodes to the text of MJCF: generated from the facts tables by `make generate`, not to be edited."""

from typing import Any

from twinform.schemas.text_output import (
    TextOutput,
    Write,
)


def write_mujoco(node: Any, out: TextOutput, indent: str) -> str:
    """`<mujoco>`."""
    attributes = ""
    attributes += out.declarations
    if node.opaque or out.parts is not None:
        return out.unusual(node, "mujoco", indent, attributes=attributes, keep=True)
    return f"{indent}<mujoco{attributes}/>"


write_root: Write = write_mujoco

WRITERS: dict[str, Write] = {
    "mujoco": write_mujoco,
}
