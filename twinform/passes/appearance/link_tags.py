"""Editing the `<gazebo>` tags of one URDF link without touching the others."""

from collections.abc import Callable, Iterable, Mapping

from twinform.ir import Element, GazeboExtension, Model

Content = tuple[Element, ...]


def with_tags(model: Model, links: Iterable[str], tags: Mapping[str, str]) -> Model:
    """The model with flat tags for some links; those that are there say the new value, wherever they stand."""

    def change(content: Content) -> Content:
        return tuple(_with_new_text(element, tags) for element in content)

    def missing(content: Content) -> Content:
        names = {element.name for element in content}
        return tuple(Element(name=name, text=text) for name, text in tags.items() if name not in names)

    return _with_content(model, links, change, missing)


def with_element(model: Model, links: Iterable[str], path: tuple[str, ...], text: str) -> Model:
    """The model with a value in an element of SDF for some links, such as `collision/surface/bounce/threshold`."""

    def change(content: Content) -> Content:
        return tuple(_deep(each, path[1:], text) if each.name == path[0] else each for each in content)

    def missing(content: Content) -> Content:
        is_there = any(element.name == path[0] for element in content)
        return () if is_there else (_deep(Element(name=path[0]), path[1:], text),)

    return _with_content(model, links, change, missing)


def _with_content(
    model: Model, links: Iterable[str], change: Callable[[Content], Content], missing: Callable[[Content], Content]
) -> Model:
    """The model with other content for some links: what is missing in all of a link's extensions joins the first."""
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


def _with_new_text(element: Element, tags: Mapping[str, str]) -> Element:
    if element.name not in tags:
        return element
    # libsdformat reads a tag's `value` attribute before its text, so an old attribute would
    # overrule the new text.
    kept = tuple(pair for pair in element.attributes if pair[0] != "value")
    return element.copy(text=tags[element.name], attributes=kept)


def _deep(element: Element, path: tuple[str, ...], text: str) -> Element:
    """The element with a text at the end of a path below it."""
    if not path:
        return element.copy(text=text, attributes=())
    name, rest = path[0], path[1:]
    if element.find(name) is None:
        return element.copy(children=(*element.children, _deep(Element(name=name), rest, text)))
    children = tuple(_deep(each, rest, text) if each.name == name else each for each in element.children)
    return element.copy(children=children)
