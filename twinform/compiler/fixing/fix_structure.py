"""Fixes of structure: missing attributes, repeated and deprecated elements, stray texts, and versions."""

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from copy import deepcopy

from twinform.compiler.fixing.fix_names import free_name
from twinform.compiler.fixing.fix_numbers import guesses, numbers_of, text_of_number
from twinform.compiler.fixing.site import FindingSite, Fixers, careful, display, revealing, safe, unsafe
from twinform.diagnostics import Diagnostic, Fix, Safety, Span, TextEdit, is_typo, nearest_name, rules
from twinform.schemas import VALUE_TYPES, Fact, parse_version, print_version, table, versions_of
from twinform.schemas.hints import new_holder
from twinform.text import same_element

# Products of inertia: whoever leaves them out means zero.
_ZERO = frozenset({"ixy", "ixz", "iyz"})
_NUMBERS_TO_FIND = frozenset({"effort", "velocity"})
# Things of their own: a second one does not repeat the first.
_OF_THEIR_OWN = frozenset({"actor", "camera", "joint", "light", "link", "model", "world"})
_SHOWN = 40


def _missing_attribute(site: FindingSite) -> Fix | None:
    name = (site.finding.expected or "").removeprefix("@")
    if not name or name in site.element.attrib:
        return None
    moved = _text_as_attribute(site, name) or _misspelt_attribute(site, name)
    if moved is not None:
        return moved
    if name in _ZERO and site.element.tag == "inertia":
        return safe(f'Write {name}="0"', site.edit.set_attribute(site.element, name, "0"))
    if name in _NUMBERS_TO_FIND:
        return display(f"Write {name}, as the actuator has it", site.edit.set_attribute(site.element, name, ""))
    if name == "version":
        newest = versions_of(site.file.format)[-1]
        return unsafe(f'Write version="{newest}"', site.edit.set_attribute(site.element, name, newest))
    if name == "name":
        called = free_name(site.file, str(site.element.tag))
        return unsafe(f'Write name="{called}"', site.edit.set_attribute(site.element, name, called))
    return None


def _misspelt_attribute(site: FindingSite, name: str) -> Fix | None:
    """Call the only attribute with a typing mistake in it by its name."""
    row = site.file.row_of(site.element)
    known = {each.name[1:] for each in row.attributes} if row else set[str]()
    free = known.difference(map(str, site.element.keys()))
    unknown = (key for key in map(str, site.element.keys()) if key not in known)
    near = [key for key in unknown if is_typo(key, name) and nearest_name(key, free) == name]
    if len(near) != 1:
        return None
    return unsafe(f"Write {name} instead of {near[0]}", site.edit.rename_attribute(site.element, near[0], name))


def _text_as_attribute(site: FindingSite, name: str) -> Fix | None:
    """Make the text of an element its attribute, such as `<mass>1</mass>` into `<mass value="1"/>`."""
    row = site.file.row_of(site.element)
    fact = next((each for each in row.attributes if each.name == f"@{name}"), None) if row else None
    place = site.edit.places[site.element]
    if row is None or row.type or fact is None or len(site.element) or place.asides or place.end_tag is None:
        return None
    written = (site.element.text or "").strip()
    expected = VALUE_TYPES[site.file.format][fact.type or "string"].expected
    certain = [each.text for each in guesses(written, expected) if each.safety is Safety.SAFE]
    text = next((each for each in (written, *certain) if each and _is_valid(fact, each, site.file.format)), None)
    if text is None:
        return None
    slash = site.edit.replace(site.element, Span(place.start_tag.end - 1, place.end_tag.end), "/>")
    return safe(f'Write {name}="{text}"', site.edit.set_attribute(site.element, name, text), slash)


def _is_valid(fact: Fact, text: str, format_: str) -> bool:
    if fact.enum:
        return text in fact.enum
    try:
        VALUE_TYPES[format_][fact.type or "string"].parse(text)
    except ValueError:
        return False
    return True


def _defaulted_attribute(site: FindingSite) -> Fix | None:
    """Write the default of an attribute, or delete an element without effect where there is no default."""
    name = site.finding.expected or ""
    misspelt = _misspelt_attribute(site, name[1:])
    if misspelt is not None:
        return misspelt
    row = site.file.row_of(site.element)
    fact = next((each for each in row.attributes if each.name == name), None) if row else None
    if fact is None:
        return None
    if fact.default is None:
        if site.element.attrib or len(site.element):
            return None  # something is written, and means something to somebody
        return safe(f"Delete the empty <{site.element.tag}>", site.edit.remove(site.element))
    value = fact.default
    return safe(f'Write {name[1:]}="{value}"', site.edit.set_attribute(site.element, name[1:], value))


def _deprecated_element(site: FindingSite) -> Fix | None:
    """Replace `thread_pitch`, in rad/m and left-handed, by `screw_thread_pitch`, in m per turn and right-handed."""
    parent, numbers = site.element.getparent(), numbers_of(site.element.text)
    if site.element.tag != "thread_pitch" or parent is None or len(numbers) != 1 or not numbers[0]:
        return None
    if parent.find("screw_thread_pitch") is not None:
        return safe("Delete <thread_pitch>: <screw_thread_pitch> is read", site.edit.remove(site.element))
    value = text_of_number(-2 * math.pi / numbers[0])
    edits = (*site.edit.rename(site.element, "screw_thread_pitch"), *site.edit.set_text(site.element, value))
    return unsafe(f"Write <screw_thread_pitch>{value}</screw_thread_pitch>", *edits)


def _repeated_element(site: FindingSite) -> Fix | None:
    """Delete a repeated element; readers take the first one, or the last one."""
    parent = site.element.getparent()
    if parent is None or site.element.tag in _OF_THEIR_OWN:
        return None
    row = site.file.row_of(site.element)
    last = row is not None and row.last
    taken, which = next(parent.iterchildren(str(site.element.tag), reversed=last)), "first" if last else "second"
    if taken is site.element:
        return None
    edit = site.edit.remove(site.element)
    if same_element(taken, site.element):
        return safe(f"Delete the {which} <{site.element.tag}>, which says the same", edit)
    return unsafe(f"Delete the {which} <{site.element.tag}>", edit)


def _blank_value(site: FindingSite) -> Fix | None:
    """Write the default, or the value of an attribute as URDF has it, such as `<mass value="1"/>`."""
    _, is_attribute, name = site.finding.location.path.rpartition("/@")
    if is_attribute:
        return safe(f"Delete {name!r}", site.edit.remove_attribute(site.element, name))
    row = site.file.row_of(site.element)
    if row is None or len(site.element):
        return None
    if site.element.attrib:
        return _attribute_as_text(site, row)
    if row.default is None:
        return None
    return safe(f"Write the default, {row.default}", *site.edit.set_text(site.element, row.default))


def _attribute_as_text(site: FindingSite, row: Fact) -> Fix | None:
    """Make the only attribute of an element its text, where the format has no such attribute."""
    (name, value), *others = site.element.items()
    written = value.strip()
    if (
        others
        or any(each.name == f"@{name}" for each in row.attributes)
        or not _is_valid(row, written, site.file.format)
    ):
        return None
    edits = (site.edit.remove_attribute(site.element, name), *site.edit.set_text(site.element, written))
    return revealing(f"Write <{site.element.tag}>{written}</{site.element.tag}>", *edits)


def _stray_text(site: FindingSite) -> Fix | None:
    """Remove text that every reader skips, unless it may be meant as a missing attribute."""
    fixes = site.file.memo.setdefault("stray texts", {})
    key = site.element, site.finding.found
    if key not in fixes:
        fixes[key] = None if site.finding.location.path in _without_attributes(site) else _without_stray_text(site)
    return fixes[key]


def _without_stray_text(site: FindingSite) -> Fix | None:
    """Make all texts of an element that begin as found comments, or delete them where they say nothing."""
    runs, text = _runs_of_text(site).get(site.finding.found, []), site.edit.text_with(site.element)
    if not runs or any("--" in run.of(text) and _says_something(run.of(text)) for run in runs):
        return None
    if any(_says_something(run.of(text)) for run in runs):
        return safe("Make the text a comment", *(site.edit.comment_out(site.element, run) for run in runs))
    return safe("Delete the characters that belong to nothing", *(_without_text(site, run) for run in runs))


def _runs_of_text(site: FindingSite) -> Mapping[str | None, list[Span]]:
    """Return the texts in an element by their beginnings."""
    memo = site.file.memo.setdefault("runs of text", {})
    if site.element not in memo:
        found = memo[site.element] = defaultdict[str, list[Span]](list)
        text = site.edit.text_with(site.element)
        for run in site.edit.places[site.element].texts():
            found[" ".join(run.of(text).split())[:_SHOWN]].append(run)
    return memo[site.element]


def _without_attributes(site: FindingSite) -> frozenset[str]:
    """Return the paths of elements that lack an attribute."""
    if "without attributes" not in site.file.memo:
        lacking = (each for each in site.file.loaded.diagnostics if each.rule is rules.MISSING_ATTRIBUTE)
        site.file.memo["without attributes"] = frozenset(each.location.path for each in lacking)
    return site.file.memo["without attributes"]


def _says_something(text: str) -> bool:
    return any(map(str.isalnum, text))


def _without_text(site: FindingSite, run: Span) -> TextEdit:
    piece = run.of(site.edit.text_with(site.element))
    start = run.start + len(piece) - len(piece.lstrip())
    return site.edit.replace(site.element, Span(start, start + len(piece.strip())), "")


def _outside_version(site: FindingSite) -> Fix | None:
    """Move what has another place now, or declare the first version that has everything in the file."""
    moved = _moved_out(site)
    if moved is not None:
        return moved
    if "version" not in site.file.memo:
        site.file.memo["version"] = _first_fitting_version(site)
    version = site.file.memo["version"]
    if version is None:
        return None
    # From SDF 1.5 on an axis is in the frame of its joint, and with other versions other things change.
    return careful(f"Declare version {version}", site.edit.set_attribute(site.file.root, "version", version))


def _moved_out(site: FindingSite) -> Fix | None:
    """Move a value to the element around it that has it in the declared version, unless there is one."""
    rows = [row for row in _rows_at(site, site) if site.attribute is None and row.until < site.file.version]
    around = list(site.element.iterancestors())
    names = [str(each.tag) for each in around]
    found = next((new_holder(site.file.format, row, names, site.file.version) for row in rows), None)
    holder = around[names.index(found)] if found else None
    if holder is None or holder.find(str(site.element.tag)) is not None:
        return None
    edits = (site.edit.remove(site.element), site.edit.insert(holder, deepcopy(site.element)))
    return unsafe(f"Move <{site.element.tag}> into <{found}>", *edits)


def _first_fitting_version(site: FindingSite) -> str | None:
    outside = [each for each in site.file.loaded.diagnostics if each.rule is rules.OUTSIDE_VERSION]
    rows = [[*_rows_at(site, each)] for each in _sites_of(site, outside)]
    if len(rows) != len(outside) or site.file.root.get("version") is None:
        return None
    versions = map(parse_version, table(site.file.format).versions)
    newer = (version for version in versions if version > site.file.version)
    fitting = (each for each in newer if all(any(row.exists_in(each) for row in some) for some in rows))
    found = next(fitting, None)
    return print_version(found) if found else None


def _sites_of(site: FindingSite, findings: Iterable[Diagnostic]) -> Iterator[FindingSite]:
    for each in findings:
        element = site.part(each.location)
        if element is not None:
            path = each.location.path
            yield FindingSite(each, site.file, element, path.rpartition("/@")[2] if "/@" in path else None)


def _rows_at(site: FindingSite, other: FindingSite) -> list[Fact]:
    """Return the rows, of all versions, for the element or attribute at a site."""
    found = other.finding.found or ""
    holder = other.element.getparent() if other.attribute is None else other.element
    name = str(other.element.tag) if other.attribute is None else f"@{other.attribute}"
    fact = site.file.row_of(holder) if holder is not None else None
    rows = [] if fact is None else fact.children if other.attribute is None else fact.attributes
    return [row for row in rows if row.name == name and (row.name == found or found in row.enum)]


def _unknown_version(site: FindingSite) -> Fix | None:
    declared, known = site.element.get("version"), versions_of(site.file.format)
    if declared is None:
        return None
    plain = declared.strip().lower().removeprefix("v").removesuffix(".0")
    for version in (declared.strip(), declared.strip().lower().removeprefix("v"), plain):
        if version in known:
            return safe(f"Declare version {version}", site.edit.set_attribute(site.element, "version", version))
    edit = site.edit.set_attribute(site.element, "version", known[-1])
    return careful(f"Declare version {known[-1]}, as which it is read", edit)


FIXERS: Fixers = {
    rules.BLANK_VALUE.name: _blank_value,
    rules.DEFAULTED_ATTRIBUTE.name: _defaulted_attribute,
    rules.DEPRECATED_ELEMENT.name: _deprecated_element,
    rules.MISSING_ATTRIBUTE.name: _missing_attribute,
    rules.OUTSIDE_VERSION.name: _outside_version,
    rules.REPEATED_ELEMENT.name: _repeated_element,
    rules.STRAY_TEXT.name: _stray_text,
    rules.UNKNOWN_VERSION.name: _unknown_version,
}
