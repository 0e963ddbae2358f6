"""What passes do to the node of a mesh whose file they replace."""

from twinform.ir import Mesh


def without_submesh(mesh: Mesh) -> Mesh:
    """The mesh without the part that it names: a file that was made of that part has nothing else."""
    kept = tuple(part for part in mesh.opaque if not (part.element and part.element.name == "submesh"))
    return mesh if len(kept) == len(mesh.opaque) else mesh.copy(opaque=kept)
