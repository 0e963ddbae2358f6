"""Leave out material scripts without a name or a URI, for which libsdformat refuses a file."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import DROPPED_BARE_SCRIPT
from twinform.ir import Document, Format, Material, Script, rewrite
from twinform.passes.framework.pass_base import Pass

# libsdformat reads this as no name and as no URI.
_NOTHING = frozenset({"", "__default__", None})


class DropBareScripts(Pass):
    """Leave out material scripts of SDF that lack a name or a URI: libsdformat refuses a file with one.

    Changes materials of SDF with a `<script>` that has no `<name>`, or no `<uri>`, or an empty one: the script goes.
    `__default__`, which the description of the format has there, is read as nothing.

    Never touches: colors, PBR, scripts that are complete, and URDF.
    Diagnostics: `dropped-bare-script` for each, which has an entry of the ledger, *dropped*.
    """

    name = "drop-bare-scripts"
    example: ClassVar[str] = "materials,drop-bare-scripts"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document without incomplete scripts."""
        if document.format is not Format.SDF:
            return document
        return rewrite(document, Material, lambda material: _remove_script(material, sink))


def is_bare(script: Script | None) -> bool:
    """Whether a script lacks a name or a URI."""
    # libsdformat refuses the whole file for it (Material.cc, Load): "A <script> element is missing
    # a child <uri>".
    return script is not None and (script.name in _NOTHING or not script.uris or not _NOTHING.isdisjoint(script.uris))


def _remove_script(material: Material, sink: DiagnosticSink) -> Material:
    script = material.script
    if script is None or not is_bare(script):
        return material
    what = "name" if script.name in _NOTHING else "URI"
    called = "" if script.name in _NOTHING else f" {script.name!r}"
    message = f"the material script{called} has no {what}: it is left out"
    sink.report(DROPPED_BARE_SCRIPT, message, script.location)
    sink.account(Fate.DROPPED, DROPPED_BARE_SCRIPT, message, script.location)
    return material.copy(script=None)
