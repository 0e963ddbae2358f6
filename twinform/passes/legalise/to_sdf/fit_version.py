"""What older versions of SDF cannot say."""

from typing import ClassVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Joint, Model, Opaque, count_parts
from twinform.ir.frames import WORLD, FrameGraph
from twinform.passes.legalise.carrier import carry, to_element
from twinform.passes.legalise.model_pass import ModelPass
from twinform.schemas import parse_version

_MIMIC_SINCE = (1, 11)
_FRAMES_AS_PARENTS = (1, 8)
_CONTINUOUS_SINCE = (1, 6)


class FitVersion(ModelPass):
    """Take out of a model what the SDF version asked for does not have.

    Changes: 1. `mimic` before 1.11 is carried; 2. a joint's parent that is a frame, which 1.8 allows, becomes the link
    that the frame moves with; 3. `continuous` before 1.6 becomes `revolute`, which has no limits unless they are
    written.
    Never touches: what the version has.
    Diagnostics: `older-version`.
    """

    name: ClassVar[str] = "fit-version"
    version: str
    carriers: bool = True

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model in the words of the version."""
        version = parse_version(self.version)
        joints = model.joints
        if version < _MIMIC_SINCE:
            joints = tuple(self._without_mimic(joint, notes) for joint in joints)
        if version < _FRAMES_AS_PARENTS and model.frames:
            graph = FrameGraph(model)
            joints = tuple(_on_a_link(joint, graph) for joint in joints)
        if version < _CONTINUOUS_SINCE:
            joints = tuple(_without_continuous(joint) for joint in joints)
        return model if joints is model.joints else model.model_copy(update={"joints": joints})

    def _without_mimic(self, joint: Joint, notes: Notes) -> Joint:
        if joint.axis is None or joint.axis.mimic is None:
            return joint
        mimic = joint.axis.mimic
        message = f"joint {joint.name!r} mimics {mimic.joint!r}; SDF {self.version} has no <mimic>, it came with 1.11"
        notes.report(to_sdf.OLDER_VERSION, message, mimic.location, found="mimic")
        fate = Fate.CARRIED if self.carriers else Fate.DROPPED
        notes.account(fate, to_sdf.OLDER_VERSION, message, mimic.location, count_parts(mimic))
        free = joint.model_copy(update={"axis": joint.axis.model_copy(update={"mimic": None})})
        element = to_element(joint, "joint", "urdf").find("mimic")
        return carry(free, [Opaque(element=element)], "urdf") if self.carriers and element else free


def _on_a_link(joint: Joint, graph: FrameGraph) -> Joint:
    if joint.parent is None or joint.parent == WORLD:
        return joint
    return joint.model_copy(update={"parent": graph.body(joint.parent)})


def _without_continuous(joint: Joint) -> Joint:
    return joint.model_copy(update={"type": "revolute"}) if joint.type == "continuous" else joint
