"""The tree of links and joints as HTML: rows that can be clicked and folded, with marks where something was found."""

from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import NamedTuple

from twinform.compiler.graph.graph import shortened
from twinform.compiler.scene import Scene, SceneJoint
from twinform.ir.motion import spanning_tree

# Levels that are indented and can be folded: browsers flatten elements that are nested too deep.
_DEEPEST = 60
_MOST_OPEN = 300
"""With more links than this, what is below the roots is folded at first."""
_STYLE = """<style>
.tf-tree{font-size:0.8em;margin:0.5em 0.75em;overflow-x:auto;white-space:nowrap;line-height:1.6}
.tf-tree details details,.tf-tree details>div{margin-left:0.9em}
.tf-tree summary{margin-left:0}.tf-tree details>div{padding-left:0.9em}
.tf-tree button{font:inherit;color:inherit;background:none;border:0;padding:0 0.2em;border-radius:3px;cursor:pointer}
.tf-tree button:hover{background:rgba(128,128,128,0.25)}
.tf-tree button[aria-current=true]{background:rgb(255,170,0);color:#000}
.tf-tree .by{opacity:0.65}.tf-tree .mark{margin-left:0.3em;cursor:help}
</style>"""


class Mark(NamedTuple):
    """A mark beside a link: its sign, its color in CSS, and its text."""

    sign: str
    color: str
    text: str


class _TreeRow(NamedTuple):
    link: str
    joint: SceneJoint | None
    depth: int
    folds: bool


def tree(scene: Scene, marks: Mapping[str, Sequence[Mark]]) -> str:
    """Return the tree of links and joints as HTML; a joint that closes a loop is listed where it closes it."""
    parts: list[str] = []
    open_: list[int] = []
    opens = len(scene.links) <= _MOST_OPEN
    for row in _list_rows(scene):
        while open_ and open_[-1] >= row.depth:
            open_.pop()
            parts.append("</details>")
        text = _write_row(row, marks.get(row.link, ()))
        if row.folds and row.depth < _DEEPEST:
            parts.append(f"<details{' open' if opens or not row.depth else ''}><summary>{text}</summary>")
            open_.append(row.depth)
        else:
            parts.append(f"<div>{text}</div>")
    return f'{_STYLE}<div class="tf-tree">{"".join(parts)}{"</details>" * len(open_)}</div>'


def _list_rows(scene: Scene) -> Iterator[_TreeRow]:
    hung = spanning_tree(scene.joints)
    below: dict[str, list[SceneJoint]] = {}
    for joint in scene.joints:
        below.setdefault(joint.parent, []).append(joint)
    names = {link.name for link in scene.links}
    roots = [link.name for link in scene.links if link.name not in hung or hung[link.name].parent not in names]
    stack: list[tuple[str, SceneJoint | None, int]] = [(name, hung.get(name), 0) for name in reversed(roots)]
    while stack:
        link, joint, depth = stack.pop()
        children = below.get(link, []) if joint is None or hung.get(link) is joint else []
        yield _TreeRow(link, joint, min(depth, _DEEPEST), bool(children))
        stack += [(each.child, each, depth + 1) for each in reversed(children)]


def _write_row(row: _TreeRow, marks: Sequence[Mark]) -> str:
    joint = row.joint
    name, full = escape(shortened(row.link)), escape(row.link)
    by = f' <span class="by">{escape(joint.type)} {escape(shortened(joint.name))}</span>' if joint else ""
    signs = "".join(
        f'<span class="mark" style="color:{each.color}" title="{escape(each.text)}">{escape(each.sign)}</span>'
        for each in marks
    )
    # The tree is HTML, since viser's buttons neither fold nor scale to a thousand links. A click
    # writes the name into the field "Find", as a person would type it: one way into the selection,
    # which also works where the script does not run.
    return f'<button type="button" data-twinform-link="{full}">{name}</button>{by}{signs}'
