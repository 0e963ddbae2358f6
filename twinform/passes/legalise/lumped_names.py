"""Names of lumped collisions in contact sensors and plugins, which name the collisions that are there in SDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, Source, rules
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Collision, Element, GazeboExtension, Model, replace_fields
from twinform.passes.carriers.lumped_names import Followed, followed, has_annotations, mentions_collisions, restored
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.shape_names import name_all
from twinform.passes.structure.tag_shapes import seen_shapes


class FollowLumpedNames(ModelPass):
    """Name the collisions that libsdformat would lump as they are called here.

    Changes: a text such as `HOST_fixed_joint_lump__PAD_collision_2` in a `<gazebo>` element becomes the name of the
    collision that libsdformat calls so, lumped or not.
    Never touches: names of lumped collisions that there would not be, which are reported as those of no collision.
    Diagnostics: `unseen-collision` where the collision is on a body of its own, which a contact sensor of another link
    does not see. The ledger has `lumped-name` for each name; it is carried.
    """

    name: ClassVar[str] = "follow-lumped-names"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with names of collisions that are there."""
        if not mentions_collisions(model):
            return model
        names = names_of_libsdformat(model)
        extensions = tuple(self._extension(each, model, names, sink) for each in model.extensions)
        return replace_fields(model, extensions=extensions)

    def _extension(
        self, extension: GazeboExtension, model: Model, names: dict[str, Followed], sink: DiagnosticSink
    ) -> GazeboExtension:
        for element in (one for part in extension.content for one in part.walk()):
            found = names.get((element.text or "").strip())
            if found is None:
                continue
            message = f"{(element.text or '').strip()!r} is called {found.name!r} when links are not lumped"
            fate = Fate.CARRIED if self.carriers else Fate.APPROXIMATED
            sink.account(fate, rules.LUMPED_NAME, message, element.location.at("text()"), weight=0)
            if extension.reference and not _is_one_body(model, extension.reference, found.link):
                message = (
                    f"{found.name!r} is on link {found.link!r}, which no sensor on {extension.reference!r} can detect"
                )
                # A warning only: to move the sensor would change the robot.
                hint = "convert with --passes 'lump-fixed-joints{compat=libsdformat}'"
                sink.report(rules.UNSEEN_COLLISION, message, element.location, found=found.name, help=hint)
        content = tuple(followed(part, names, carriers=self.carriers) for part in extension.content)
        return replace_fields(extension, content=content)


def own_collisions(model: Model) -> dict[Source, Followed]:
    """Every collision by the name that it has in SDF, by where it was written."""
    return {
        shape.source: Followed(named.name or "", link.name)
        for link in model.links
        for shape, named in zip(link.collisions, _name_collisions(link.name, link.collisions), strict=True)
        if shape.source is not None
    }


def names_of_libsdformat(model: Model) -> dict[str, Followed]:
    """What names that only libsdformat gives mean: what it lumps has the same shapes, from where they were written."""
    own = own_collisions(model)
    known = {each.name for each in own.values()}
    # The number in a lumped name counts all collisions of the body, so which one is meant is found
    # by naming them all as libsdformat would.
    named = ((seen.name, own.get(seen.shape.source)) for seen in seen_shapes(model, "collisions") if seen.shape.source)
    return {name: meant for name, meant in named if meant and name not in known}


def _name_collisions(link: str, shapes: tuple[Collision, ...]) -> tuple[Collision, ...]:
    return name_all(shapes, f"{link}_collision", DiagnosticSink(), carriers=False)


def _is_one_body(model: Model, reference: str, link: str) -> bool:
    """Whether the shapes of a link come to stand in the other one: it has no mass, and hangs on it by fixed joints."""
    links = {each.name: each for each in model.links}
    above = {joint.child: joint.parent for joint in model.joints if joint.type == "fixed"}
    while link != reference:
        if link not in above or links[link].inertial is not None:
            return False
        link = above.pop(link) or ""  # joints may make a loop
    return True


class RestoreLumpedNames(ModelPass):
    """Name collisions in `<gazebo>` elements as libsdformat lumps them, where the source did.

    Changes: a text beside which an annotation has the original.
    Never touches: a text that was edited since, or whose old name does not mean that collision any more.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "restore-lumped-names"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with the names of the source."""
        if not has_annotations(model):
            return model
        names, stale = names_of_libsdformat(model), list[Element]()

        def restore(extension: GazeboExtension) -> GazeboExtension:
            content = tuple(restored(each, names, stale) for each in extension.content)
            return extension.copy(content=content)

        model = model.copy(extensions=tuple(map(restore, model.extensions)))
        for annotation in stale:
            message = f"{annotation.get('instead_of')!r} was called {annotation.text!r}, which now names something else"
            sink.report(STALE_CARRIER, message, annotation.location, found=annotation.text)
        return model
