"""The link that a model's own frame keeps to: the base of the tree of transforms in ROS."""

from twinform.ir import Format, Model


def base_link(model: Model, format_: Format) -> str | None:
    """The root in URDF, the canonical link in SDF; None for a model without links."""
    if not model.links:
        return None
    first = model.links[0].name
    if format_ is Format.SDF:
        return model.canonical_link or first
    children = {joint.child for joint in model.joints}
    return next((link.name for link in model.links if link.name not in children), first)
