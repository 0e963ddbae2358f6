"""Unknown elements with `::` in their names, which readers of SDF refuse: hidden from these, and back for URDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import PLAIN, Model, Node, Opaque, replace_fields, rewrite
from twinform.ir.scopes import scoped_elements, scoped_parts
from twinform.passes.carriers.carriers import Keeper, bits_of_ours, carry, is_carrier, unpack
from twinform.passes.framework.pass_base import ModelPass


class HideScopedElements(ModelPass):
    """Put unknown elements with `::` in their names into carriers.

    Changes: elements without a type, such as `<api name='ati::Sensor'/>` in a sensor of a `<gazebo>` element. Since SDF
    1.8 no name has `::`, and libsdformat refuses a file with one in an element that it does not even know. With
    `carriers` false they are left out.
    Never touches: plugins and what is in them, and elements with a prefix.
    Diagnostics: none; ledger entries under `scoped-element`.
    """

    name: ClassVar[str] = "hide-scoped-elements"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without such elements but in carriers."""
        return rewrite(model, Node, lambda node: self._hide(node, sink), having=PLAIN)

    def _hide(self, node: Node, sink: DiagnosticSink) -> Node:
        scoped = scoped_parts(node)
        if not scoped:
            return node
        keeper = Keeper(sink, self.carriers)
        for part in scoped:
            message = f"{part.name} has '::' in a name, which readers of SDF refuse since 1.8"
            keeper.account(rules.SCOPED_ELEMENT, message, part.location, part.weight)
        rest = tuple(part for part in node.opaque if part not in scoped)
        node = node.copy(opaque=rest)
        return carry(node, scoped, "sdf") if self.carriers else node


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
