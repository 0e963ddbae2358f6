"""What readers take and nobody means: units, left and right, plugins, sensors, drives, meshes that are no meshes."""

from twinform.compiler.mistakes.mesh_checks import MeshFiles, report_collisions
from twinform.compiler.mistakes.scale_checks import report_masses, report_scale
from twinform.compiler.mistakes.twin_checks import report_twins
from twinform.compiler.mistakes.value_checks import report_substitutions, report_values
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.schemas import XmlElement

__all__ = ["report_mistakes"]


def report_mistakes(document: Document, tree: XmlElement | None, files: MeshFiles, sink: DiagnosticSink) -> None:
    """Report the mistakes of a document; those in parts that it keeps as they are, where there is a tree of it."""
    odd = report_scale(document, files, sink)
    report_twins(document, sink)
    report_masses(document, files, odd, sink)
    report_collisions(document, files, sink)
    if tree is None:
        return
    report_values(tree, sink)
    report_substitutions(tree, sink)
    # A plain robot has none of these parts, and starts without what is known of them.
    tags = {str(each.tag) for each in tree.iter("sensor", "plugin", "ros2_control", "transmission")}
    if "sensor" in tags:
        from twinform.compiler.mistakes.sensor_checks import report_sensors  # noqa: PLC0415 - see above

        report_sensors(tree, sink)
    if "ros2_control" in tags or "transmission" in tags:
        from twinform.compiler.mistakes.control_checks import report_control  # noqa: PLC0415 - see above

        report_control(document, tree, sink)
    if "plugin" in tags:
        from twinform.compiler.mistakes.plugin_checks import report_plugins  # noqa: PLC0415 - see above

        report_plugins(document, sink)
