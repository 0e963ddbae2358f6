"""The script that adds to viser's client what it has not: names on hover, and rows of the tree that can be clicked.

Nodes are labeled, and links selected, by what is handed over as JSON; the script itself is in `data/page.js`.
"""

import json
from collections.abc import Iterable, Mapping
from functools import cache
from html import escape
from importlib.resources import files

# viser sets the content of its controls as `innerHTML`, where scripts do not run but event handlers
# do. viser reports clicks and drags, but not where the mouse is. Asking the server with each motion
# would need a second picking of all triangles in Python and works in no page without a server; a
# server of our own in front of viser's means a second port. The script asks the scene that is drawn
# already. It uses `window.__viserMutable`, which is not public, so all of it is guarded: where
# something is missing there is no tip and no error.
_RUN = "if(!window.twinform?.show){const s=document.createElement('script');s.textContent=this.dataset.script;\
document.head.append(s)}twinform.show(JSON.parse(this.dataset.news))"


def control(labels: Mapping[str, str], selected: Iterable[str]) -> str:
    """HTML for a control of viser, which runs the script and hands it texts by names of nodes, and selected links."""
    news = json.dumps({"labels": dict(labels), "selected": list(selected)})
    return (
        f'<img hidden alt="" src="data:," onerror="{escape(_RUN)}" '
        f'data-script="{escape(_script())}" data-news="{escape(news)}">'
    )


def with_script(page: str, labels: Mapping[str, str]) -> str:
    """A page of viser with the script, and texts by names of nodes."""
    # `</script>` in a name would end the script element.
    news = json.dumps({"labels": dict(labels)}).replace("<", "\\u003c")
    before, end, after = page.rpartition("</body>")
    return f"{before}<script>{_script()}</script><script>twinform.show({news})</script>{end}{after}"


@cache
def _script() -> str:
    return (files("twinform.view") / "data" / "page.js").read_text(encoding="utf-8")
