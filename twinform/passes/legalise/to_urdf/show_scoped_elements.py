"""Elements that were hidden from readers of SDF, for URDF, where names may have `::`."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Model, Node, Opaque, replace_fields, rewrite
from twinform.ir.scopes import scoped_elements
from twinform.passes.carriers.carriers import bits_of_ours, is_carrier, unpack
from twinform.passes.framework.pass_base import ModelPass

_HAVING = bits_of_ours("sdf")


class ShowScopedElements(ModelPass):
    """Take unknown elements with `::` in their names out of the carriers that hid them.

    Changes: carriers of SDF in a file of SDF, of elements that `hide-scoped-elements` has put there.
    Never touches: other carriers.
    Diagnostics: none.
    """

    name: ClassVar[str] = "show-scoped-elements"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with these elements where they were."""
        return rewrite(model, Node, _show_hidden, having=_HAVING)


def _show_hidden(node: Node) -> Node:
    return replace_fields(node, opaque=tuple(each for part in node.opaque for each in _pieces(part)))


def _pieces(part: Opaque) -> tuple[Opaque, ...]:
    if not is_carrier(part, "sdf"):
        return (part,)
    pieces = unpack(part)
    hidden = pieces and all(each.element and any(scoped_elements(each.element)) for each in pieces)
    return pieces if hidden else (part,)
