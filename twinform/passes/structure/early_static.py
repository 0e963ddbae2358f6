"""`<static>` of URDF that some releases of libsdformat forget."""

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Model
from twinform.passes.transforms.gazebo_tags import TRUE, value_text


def find_early_static(model: Model, sink: DiagnosticSink) -> None:
    """Report a true `<static>` of a robot that its last `<gazebo>` does not repeat."""
    own = [extension for extension in model.extensions if not extension.reference]
    statics = [(each, element) for each in own for element in each.content if element.name == "static"]
    if not statics or statics[-1][0] is own[-1] or value_text(statics[-1][1]).lower() not in TRUE:
        return
    extension, element = statics[-1]
    message = (
        "<static> is true, and a later <gazebo> for the robot does not say so, which libsdformat before 12.7 and 13.3 "
        "takes for false"
    )
    where, related = element.location if element.source else extension.location, (own[-1].location,)
    help = "write it into the last <gazebo> without a reference"
    sink.report(rules.EARLY_STATIC, message, where, found=element.name, related=related, help=help)
