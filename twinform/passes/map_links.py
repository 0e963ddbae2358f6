"""Change the links of a document, wherever they are."""

from collections.abc import Callable, Iterator

from twinform.ir import Document, Link, Model, Node, map_children

Change = Callable[[Link, Model], Link]
"""From a link, and the model that it stands in, to the link as it is to be."""


def map_links(document: Document, change: Change) -> Document:
    """The document with every link changed; parts in which no link changed are the same objects as before."""

    def visit(node: Node) -> Node:
        if not isinstance(node, Model):
            return map_children(node, visit)
        links = tuple(change(link, node) for link in node.links)
        if any(new is not old for new, old in zip(links, node.links, strict=True)):
            node = node.model_copy(update={"links": links})
        models = tuple(visit(nested) for nested in node.models)
        same = all(new is old for new, old in zip(models, node.models, strict=True))
        return node if same else node.model_copy(update={"models": models})

    return map_children(document, visit)


def movable_models(document: Document) -> Iterator[Model]:
    """Every model that is not static, nor in a static one; nested ones after those around them."""
    models = [*document.models, *(model for world in document.worlds for model in world.models)]
    for model in models:  # grows while it is walked
        if not model.static:
            yield model
            models.extend(model.models)
