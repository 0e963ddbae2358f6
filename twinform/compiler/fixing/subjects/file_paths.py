"""Fixes of the paths and URIs of files: backslashes, typos in names and schemes."""

from twinform.compiler.fixing.site import FixableFile, TextFixers, unsafe
from twinform.diagnostics import Diagnostic, Fix, TextEdit, meant_name, rules


def _backslashes(finding: Diagnostic, file: FixableFile) -> Fix | None:
    found = finding.found or ""
    new = found.replace("\\", "/")
    edits = _write_uri(file, found, new)
    return unsafe(f"Write {new!r}", *edits) if edits else None


def _missing_file(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Another scheme, or the part of the path that is called nearly so."""
    found, meant = finding.found or "", meant_name(finding.help)
    new = _with(found, meant) if meant else None
    edits = _write_uri(file, found, new) if new else ()
    return unsafe(f"Write {new!r}", *edits) if edits else None


def _with(uri: str, meant: str) -> str | None:
    """A URI with what is meant in the place of what is nearest to it."""
    from difflib import SequenceMatcher  # noqa: PLC0415 - few files are missing

    scheme, separator, rest = uri.partition("://")
    if meant.endswith("://"):
        return f"{meant}{rest}" if separator else None
    parts = rest.split("/") if separator else uri.split("/")
    likeness = [SequenceMatcher(None, part.lower(), meant.lower()).ratio() for part in parts]
    at = max(range(len(parts)), key=likeness.__getitem__)
    parts[at] = meant
    return f"{scheme}{separator}{'/'.join(parts)}" if separator else "/".join(parts)


def _write_uri(file: FixableFile, found: str, new: str) -> tuple[TextEdit, ...]:
    """Every place where the URI stands alone: it is reported where it stands first."""
    if file.parts is None:
        return ()
    edits: list[TextEdit] = []
    for element, name in file.values.get(found, ()):
        if name is None:
            edits += file.edit.set_text(element, new)
        elif not name.startswith("{"):
            edits.append(file.edit.set_attribute(element, name, new))
    return tuple(edits)


TEXT_FIXERS: TextFixers = {rules.BACKSLASH_IN_PATH.name: _backslashes, rules.MISSING_FILE.name: _missing_file}
