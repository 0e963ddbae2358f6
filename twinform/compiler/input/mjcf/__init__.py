"""The front end of MJCF: from the XML tree of a file to a document in the terms of SDF.

First the tree is made canonical: includes, frames, replicates and attached models are put in their place, the values of
default classes are written into each element, angles are radians and orientations are `quat`. Then its bodies become
links, joints and frames, and carriers add what MJCF cannot say.
"""

from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.mjcf.carried_texts import take_texts
from twinform.compiler.input.mjcf.lower import lower
from twinform.compiler.input.mjcf.model_trees import WrittenModels
from twinform.compiler.input.mjcf.normalize import check_classes, normalize
from twinform.compiler.input.mjcf.note_notation import note_notation
from twinform.ir import Document
from twinform.schemas import Context, XmlElement

__all__ = ["check_classes", "lower_mjcf"]


def lower_mjcf(root: XmlElement, context: Context, load_options: LoadOptions) -> Document | None:
    """Build the document of a `<mujoco>` in the terms of SDF; the tree is left as it is.

    There is none where the tree has errors, which are reported: names that lead nowhere, for one.
    """
    canonical = normalize(root, context, load_options)
    if canonical is None or context.sink.has_errors:
        return None
    note_notation(root, context.sink)
    texts = take_texts(canonical, context)
    document = lower(canonical, context, load_options, root, WrittenModels.of(texts))
    if not texts:
        return document
    from twinform.compiler.input.mjcf.merge_texts import merge_texts  # noqa: PLC0415 - most files have no carriers

    return merge_texts(document, texts, canonical, context.sink)
