"""Hiding unknown elements with `::` in their names from readers of SDF, which refuse the whole file for one."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import PLAIN, Model, Node, rewrite
from twinform.ir.scopes import scoped_parts
from twinform.passes.carriers.carriers import Keeper, carry
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
