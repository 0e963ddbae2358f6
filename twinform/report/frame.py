"""Makes the page of the 3D view run in a report under its Content-Security-Policy.

A frame with a `srcdoc` has the policy of the page around it. To allow inline scripts there would allow them in the
report too; so the scripts of the view get a nonce, and so do those that it makes itself. The nonce is a hash of the
view, with all names that are in it: nobody can write it into a name.
"""

import hashlib
from base64 import b64encode
from typing import NamedTuple

# viser's client puts its program into a script element that it makes itself, and evaluates strings.
# Without a view, the policy of a report has no `unsafe` word at all.
_MAKES_SCRIPTS = (
    "(()=>{const make=document.createElement.bind(document);document.createElement=(name,...more)=>{"
    "const made=make(name,...more);if(String(name).toLowerCase()==='script')made.nonce='%s';return made}})()"
)


class Framed(NamedTuple):
    """A page with nonces, and the nonce."""

    page: str
    nonce: str


def framed(page: str) -> Framed:
    """The page with what it needs to run in the frame."""
    nonce = b64encode(hashlib.sha256(page.encode()).digest(), b"-_").decode().rstrip("=")
    first = f'<script nonce="{nonce}">{_MAKES_SCRIPTS % nonce}</script>'
    return Framed(page.replace("<script", f'<script nonce="{nonce}"').replace("<head>", f"<head>{first}", 1), nonce)


def policy(style: str, script: str, nonce: str | None) -> str:
    """The Content-Security-Policy of a report: nothing from elsewhere, and no script but these.

    The client of the view evaluates strings, computes in WebAssembly and in workers, and sets styles.
    """
    own = f"'sha256-{_hash(script)}'"
    if nonce is None:
        return f"default-src 'none'; img-src data:; style-src 'sha256-{_hash(style)}'; script-src {own}; {_REST}"
    return (
        f"default-src 'none'; img-src data: blob:; font-src data:; connect-src data: blob:; worker-src blob:; "
        f"style-src 'unsafe-inline'; script-src {own} 'nonce-{nonce}' 'unsafe-eval'; {_REST}"
    )


_REST = "base-uri 'none'; form-action 'none'"


def _hash(text: str) -> str:
    return b64encode(hashlib.sha256(text.encode()).digest()).decode()
