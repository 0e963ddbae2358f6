"""The tags of `<gazebo>` elements that are about one link of URDF, changed without touching the others."""

from collections.abc import Mapping

from twinform.ir import Element, GazeboExtension, Model


def with_tags(model: Model, link: str, tags: Mapping[str, str]) -> Model:
    """The model with flat tags for a link; those that are there say the new value, others join the first extension."""
    missing = dict(tags)
    extensions: list[GazeboExtension] = []
    for extension in model.extensions:
        if extension.reference == link:
            content = tuple(_changed(element, tags) for element in extension.content)
            for element in content:
                missing.pop(element.name, None)
            extension = extension.model_copy(update={"content": content})  # noqa: PLW2901 - the same one, changed
        extensions.append(extension)
    more = tuple(Element(name=name, text=text) for name, text in missing.items())
    return model.model_copy(update={"extensions": _joined(extensions, link, more)})


def with_element(model: Model, link: str, path: tuple[str, ...], text: str) -> Model:
    """The model with a value in an element of SDF for a link, such as `collision/surface/bounce/threshold`."""
    extensions: list[GazeboExtension] = []
    done = False
    for extension in model.extensions:
        if extension.reference == link and any(element.name == path[0] for element in extension.content):
            content = tuple(_deep(each, path[1:], text) if each.name == path[0] else each for each in extension.content)
            extension, done = extension.model_copy(update={"content": content}), True  # noqa: PLW2901 - likewise
        extensions.append(extension)
    more = () if done else (_deep(Element(name=path[0]), path[1:], text),)
    return model.model_copy(update={"extensions": _joined(extensions, link, more)})


def _changed(element: Element, tags: Mapping[str, str]) -> Element:
    if element.name not in tags:
        return element
    kept = tuple(pair for pair in element.attributes if pair[0] != "value")
    return element.model_copy(update={"text": tags[element.name], "attributes": kept})


def _deep(element: Element, path: tuple[str, ...], text: str) -> Element:
    """The element with a text at the end of a path below it."""
    if not path:
        return element.model_copy(update={"text": text, "attributes": ()})
    name, rest = path[0], path[1:]
    if element.find(name) is None:
        return element.model_copy(update={"children": (*element.children, _deep(Element(name=name), rest, text))})
    children = tuple(_deep(each, rest, text) if each.name == name else each for each in element.children)
    return element.model_copy(update={"children": children})


def _joined(extensions: list[GazeboExtension], link: str, more: tuple[Element, ...]) -> tuple[GazeboExtension, ...]:
    """The extensions, with more content in the first one for the link."""
    if not more:
        return tuple(extensions)
    for index, extension in enumerate(extensions):
        if extension.reference == link:
            extensions[index] = extension.model_copy(update={"content": (*extension.content, *more)})
            return tuple(extensions)
    return (*extensions, GazeboExtension(reference=link, content=more))
