"""What is written instead of what our passes find."""

import re

from twinform.compiler.fixing import FindingSite
from twinform.diagnostics import Fix, Safety, TextEdit


def house_style(site: FindingSite) -> Fix | None:
    """The name in small letters with underscores, wherever the file says it."""
    old = site.finding.found or ""
    new = re.sub(r"\W+", "_", old.strip()).lower()
    edits: list[TextEdit] = []
    for each in site.file.root.iter("*"):
        edits += [site.edit.set_attribute(each, str(key), new) for key, value in each.attrib.items() if value == old]
        if each.text == old and not len(each):
            edits += site.edit.set_text(each, new)
    return Fix(f"Call it {new}", tuple(edits), Safety.UNSAFE) if edits else None
