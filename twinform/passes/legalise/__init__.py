"""The passes that turn what a target cannot say into what it can."""

from twinform.ir import Format
from twinform.passes.base import Pass

__all__ = ["legalisation"]


def legalisation(
    source: Format, target: Format, *, sdf_version: str, carriers: bool = True, model: str | None = None
) -> tuple[Pass, ...]:
    """Every pass that a document of `source` needs before the back end of `target` can write it."""
    if source is target:
        return ()
    if target is Format.SDF:
        from twinform.passes.legalise.to_sdf import to_sdf

        return to_sdf(sdf_version, carriers=carriers)
    from twinform.passes.legalise.to_urdf import pipeline as to_urdf
    from twinform.passes.legalise.to_urdf.unpack_urdf import UnpackUrdf

    return (*to_urdf(model=model, carriers=carriers), UnpackUrdf())
