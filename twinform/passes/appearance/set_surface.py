"""Set the contact surface of collisions."""

from collections.abc import Callable, Iterable, Mapping
from typing import ClassVar, Self

from pydantic import Field, model_validator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import NOTHING_MATCHED, UNSET_SURFACE
from twinform.ir import Collision, Document, Element, Format, GazeboExtension, Link, Model, Surface, rewrite
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.schemas import format_value

_TAGS = {"mu": "mu1", "mu2": "mu2", "kp": "kp", "kd": "kd", "max_vel": "maxVel", "min_depth": "minDepth"}
"""The flat tags of `<gazebo>` by field; other fields stand at their paths in SDF."""
_PATHS = {
    "restitution_coefficient": ("collision", "surface", "bounce", "restitution_coefficient"),
    "slip1": ("collision", "surface", "friction", "ode", "slip1"),
    "slip2": ("collision", "surface", "friction", "ode", "slip2"),
}
Content = tuple[Element, ...]


class SetSurface(Pass):
    """Set friction, restitution and contact parameters of collisions.

    Changes the collisions whose name matches `collisions` on links whose name matches `links`:

    1. in SDF, the `<surface>` of each;
    2. in URDF, the `<gazebo reference="LINK">` tags `mu1`, `mu2`, `kp`, `kd`, `maxVel` and `minDepth`, and for what has
       no tag, restitution and slip, the `<collision>` in such an element. These are about all collisions of a link.

    Only what an option is given for is set; all else that is written of a surface stays.
    Never touches: links without collisions, and models that an `<include>` names.
    Diagnostics: `unset-surface` where URDF cannot express it for one of several collisions, and `nothing-matched`.
    """

    name = "set-surface"
    example: ClassVar[str] = 'set-surface{links="*wheel*" mu=0.9 mu2=0.5}'

    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only links"))
    collisions: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only collisions"))
    mu: float | None = Field(default=None, ge=0, description="Coulomb friction along the first direction.")
    mu2: float | None = Field(
        default=None, ge=0, description="Coulomb friction along the second direction; kept where not set."
    )
    restitution: float | None = Field(default=None, ge=0, le=1, description="From 0, no bounce, to 1.")
    kp: float | None = Field(default=None, gt=0, description="The stiffness of the contact, in N/m.")
    kd: float | None = Field(default=None, ge=0, description="The damping of the contact, in N s/m.")
    slip1: float | None = Field(default=None, ge=0, description="Force dependent slip along the first, in m/(N s).")
    slip2: float | None = Field(default=None, ge=0, description="Force dependent slip along the second, in m/(N s).")
    max_vel: float | None = Field(default=None, ge=0, description="The fastest correction of a contact, in m/s.")
    min_depth: float | None = Field(default=None, ge=0, description="The depth that is left uncorrected, in m.")

    @model_validator(mode="after")
    def _check_numbers(self) -> Self:
        if any(value in {float("inf"), float("-inf")} for value in self._values().values()):
            raise ValueError("a surface has finite numbers")
        return self

    def _values(self) -> dict[str, float]:
        """The values to set, by the fields of a surface."""
        fields = {"restitution_coefficient": self.restitution}
        fields |= {name: getattr(self, name) for name in (*_TAGS, "slip1", "slip2")}
        return {name: value for name, value in fields.items() if value is not None}

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with other surfaces."""
        matched: list[Collision] = []

        if document.format is Format.URDF:
            made = rewrite(document, Model, lambda model: self._set_in_urdf(model, matched, sink))
        else:
            made = rewrite(document, Link, lambda link: self._set_in_sdf(link, matched))
        if not matched:
            collisions, links = ", ".join(self.collisions), ", ".join(self.links)
            message = f"no collision {collisions!r} on a link {links!r}"
            sink.report(NOTHING_MATCHED, message, document.location, found=collisions)
        return made

    def _matching(self, link: Link) -> list[Collision]:
        if not matches(link.name, self.links):
            return []
        return [one for one in link.collisions if matches(one.name, self.collisions)]

    def _set_in_sdf(self, link: Link, matched: list[Collision]) -> Link:
        meant = self._matching(link)
        matched += meant
        if not meant or not self._values():
            return link
        chosen = {id(one) for one in meant}
        collisions = tuple(self._set_surface(one) if id(one) in chosen else one for one in link.collisions)
        return link if collisions == link.collisions else link.copy(collisions=collisions)

    def _set_surface(self, collision: Collision) -> Collision:
        surface = (collision.surface or Surface()).copy(**self._values())
        return collision.copy(surface=surface)

    def _set_in_urdf(self, model: Model, matched: list[Collision], sink: DiagnosticSink) -> Model:
        links: list[str] = []
        for link in model.links:
            meant = self._matching(link)
            matched += meant
            # A <gazebo> element is about all collisions of its link; there is no place in URDF for
            # one of them.
            if meant and len(meant) < len(link.collisions):
                names = ", ".join(repr(one.name) for one in meant)
                message = f"URDF has one surface for all collisions of link {link.name!r}, not one for {names}"
                sink.report(UNSET_SURFACE, message, meant[0].location, found=meant[0].name)
            elif meant:
                links.append(link.name)
        made = self._set_in_gazebo(model, links)
        return model if made == model else made

    def _set_in_gazebo(self, model: Model, links: list[str]) -> Model:
        values = {name: format_value(value) for name, value in self._values().items()}
        tags = {tag: values[name] for name, tag in _TAGS.items() if name in values}
        model = set_tags(model, links, tags)
        for name, path in _PATHS.items():
            if name in values:
                model = _set_element(model, links, path, values[name])
        return model


def set_tags(model: Model, links: Iterable[str], tags: Mapping[str, str]) -> Model:
    """The model with flat tags for some links; existing tags get the new value wherever they stand."""

    def change(content: Content) -> Content:
        return tuple(_replace_text(element, tags) for element in content)

    def missing(content: Content) -> Content:
        names = {element.name for element in content}
        return tuple(Element(name=name, text=text) for name, text in tags.items() if name not in names)

    return _edit_content(model, links, change, missing)


def _set_element(model: Model, links: Iterable[str], path: tuple[str, ...], text: str) -> Model:
    """The model with a value at a path of SDF for some links, such as `collision/surface/bounce/threshold`."""

    def change(content: Content) -> Content:
        return tuple(_set_at_path(each, path[1:], text) if each.name == path[0] else each for each in content)

    def missing(content: Content) -> Content:
        is_there = any(element.name == path[0] for element in content)
        return () if is_there else (_set_at_path(Element(name=path[0]), path[1:], text),)

    return _edit_content(model, links, change, missing)


def _edit_content(
    model: Model, links: Iterable[str], change: Callable[[Content], Content], missing: Callable[[Content], Content]
) -> Model:
    """The model with changed content for some links; what all extensions of a link lack is added to the first."""
    wanted: dict[str, Content] = dict.fromkeys(links, ())
    first: dict[str, int] = {}
    extensions: list[GazeboExtension] = []
    for index, extension in enumerate(model.extensions):
        name = extension.reference or ""
        if name not in wanted:
            extensions.append(extension)
            continue
        first.setdefault(name, index)
        # Several <gazebo> elements may name one link, and libsdformat takes the last tag of a kind:
        # so all of them get the new value.
        wanted[name] += extension.content
        extensions.append(extension.copy(content=change(extension.content)))
    for name, content in wanted.items():
        more = missing(content)
        if more and name in first:
            old = extensions[first[name]]
            extensions[first[name]] = old.copy(content=(*old.content, *more))
        elif more:
            extensions.append(GazeboExtension(reference=name, content=more))
    return model.copy(extensions=tuple(extensions))


def _replace_text(element: Element, tags: Mapping[str, str]) -> Element:
    if element.name not in tags:
        return element
    # libsdformat reads a tag's `value` attribute before its text, so an old attribute would
    # overrule the new text.
    kept = tuple(pair for pair in element.attributes if pair[0] != "value")
    return element.copy(text=tags[element.name], attributes=kept)


def _set_at_path(element: Element, path: tuple[str, ...], text: str) -> Element:
    """The element with a text at the end of a path below it."""
    if not path:
        return element.copy(text=text, attributes=())
    name, rest = path[0], path[1:]
    if element.find(name) is None:
        return element.copy(children=(*element.children, _set_at_path(Element(name=name), rest, text)))
    children = tuple(_set_at_path(each, rest, text) if each.name == name else each for each in element.children)
    return element.copy(children=children)
