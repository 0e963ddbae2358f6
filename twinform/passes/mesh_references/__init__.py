"""File references inside meshes and material scripts: COLLADA images, OBJ and MTL, glTF buffers, Ogre textures.

For each format there is a module with `references`, the names of files as they are written, and `rewritten`, the bytes
with other names in their place.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from twinform.passes.mesh_references import collada, gltf, ogre, wavefront

Names = Mapping[str, str]
"""From the name of a file as it is written to the one that is to stand there."""


class ReferenceFormat(NamedTuple):
    """How the files that a file names are found in it, and replaced.

    `by_name`: the program that reads it looks for the bare name in folders that it knows.
    """

    references: Callable[[bytes], list[str]]
    rewritten: Callable[[bytes, Names], bytes]
    by_name: bool = False


FORMATS: Mapping[str, ReferenceFormat] = {
    "dae": ReferenceFormat(collada.references, collada.rewritten),
    "obj": ReferenceFormat(wavefront.libraries, wavefront.with_libraries),
    "mtl": ReferenceFormat(wavefront.textures, wavefront.with_textures),
    "gltf": ReferenceFormat(gltf.references, gltf.rewritten),
    "glb": ReferenceFormat(gltf.references_of_binary, gltf.rewritten_binary),
    "material": ReferenceFormat(ogre.references, ogre.rewritten, by_name=True),
}
"""By the suffix of a file; all other formats name no files, or none that is known here."""
