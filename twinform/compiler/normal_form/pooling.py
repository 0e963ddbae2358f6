"""Several `<gazebo>` elements, and several elements in them, that say something of one link or joint, put together."""

from twinform.compiler.compare.values import Value
from twinform.compiler.normal_form.part import TEXT, Key, Part
from twinform.compiler.normal_form.values import literally
from twinform.schemas import XmlElement


def tag_part(tag: XmlElement, value: Value | None) -> Part:
    """A tag of an extension: what it says, and attributes that mean nothing."""
    values = {f"@{name}": literally(str(text)) for name, text in tag.items() if name != "value"}
    return Part(tag, values=values if value is None else {**values, TEXT: value})


def add_once(made: Part, tag: str, part: Part) -> None:
    """Take in what may be said several times in the same words, and is then said once."""
    if not any(one.values == part.values for key, one in made.children.items() if key.tag == tag):
        made.children[_free_key(made, tag, "")] = part


def pool(made: Part, tag: str, part: Part) -> None:
    """Take in one of several elements that add to one thing, such as two `<collision>`."""
    key = Key(tag, "", 1)
    mine = made.children.get(key)
    if mine is None:
        if not part.says_nothing:
            made.children[key] = part
        return
    mine.values = {**part.values, **mine.values}
    for inner, child in part.children.items():
        if inner.name:
            mine.children[_free_key(mine, inner.tag, inner.name)] = child
        elif child.children:
            pool(mine, inner.tag, child)
        else:
            add_once(mine, inner.tag, child)


def _free_key(made: Part, tag: str, name: str) -> Key:
    return Key(tag, name, 1 + sum(1 for key in made.children if (key.tag, key.name) == (tag, name)))
