"""Checks what MJCF says about several things: limits, actuators, sensors, constraints, tendons and keyframes."""

from collections.abc import Callable, Mapping

from twinform.compiler.input.mjcf.check_bodies import all_joints
from twinform.compiler.input.mjcf.check_references import Named
from twinform.compiler.input.mjcf.element_findings import ElementFindings
from twinform.compiler.input.mjcf.number_lists import numbers_of
from twinform.diagnostics import rules
from twinform.passes.legalise.to_mjcf.kept_mjcf import TARGETS
from twinform.schemas import XmlElement
from twinform.schemas.mjcf_references import OF_LIMITS, SCALAR_JOINTS, WITH_COORDINATES, most_coordinates, takes

_RANGES = {
    "range": "limited",
    "ctrlrange": "ctrllimited",
    "forcerange": "forcelimited",
    "actrange": "actlimited",
    "actuatorfrcrange": "actuatorfrclimited",
}
_ALWAYS_CONTROLLED = frozenset({"damper", "adhesion"})
_PAIRS = (("body1", "body2"), ("geom1", "geom2"), ("joint1", "joint2"), ("site1", "site2"), ("tendon1", "tendon2"))


def check_relations(root: XmlElement, named: Named, findings: ElementFindings) -> None:
    """Report what cannot be as it is said in the sections behind the world."""
    joints = [*all_joints(root)]
    kinds = {name: kind for joint, kind in joints if (name := joint.get("name"))}
    for joint, kind in joints:
        if kind in SCALAR_JOINTS:  # a ball may be limited to an angle of 0
            _check_ranges(joint, ("range", "actuatorfrcrange"), findings)
    checks: Mapping[str, Callable[[XmlElement], None]] = {
        "actuator": lambda each: _check_actuator(each, findings),
        "sensor": lambda each: _check_sensor(each, kinds, named, findings),
        "equality": lambda each: _check_equality(each, kinds, findings),
        "tendon": lambda each: _check_tendon(each, kinds, findings),
        "keyframe": lambda each: _check_keyframe(each, root, [kind for _, kind in joints], findings),
        "custom": lambda each: _check_custom(each, findings),
        "asset": lambda each: _check_asset(each, findings),
    }
    for section in root.iterchildren("*"):
        check = checks.get(str(section.tag))
        for element in section.iterchildren("*") if check else ():
            if check:
                check(element)


def _check_ranges(element: XmlElement, names: tuple[str, ...], findings: ElementFindings) -> None:
    for name in names:
        is_always = name == "ctrlrange" and element.tag in _ALWAYS_CONTROLLED
        if element.get(_RANGES[name]) != "true" and not is_always:
            continue
        found = numbers_of(element, name, count=2)
        if found is None:
            message = f"<{element.tag}> is limited, and has no {name!r}"
            findings.report(rules.MISSING_ATTRIBUTE, element, message, expected=f"@{name}")
        elif not found[0] < found[1]:
            message = f"{name!r} of <{element.tag}> goes from {found[0]:g} to {found[1]:g}; the first has to be lower"
            text = element.get(name)
            findings.report(rules.LOWER_ABOVE_UPPER, element, message, f"@{name}", found=text, refused=True)


def _check_actuator(actuator: XmlElement, findings: ElementFindings) -> None:
    _check_ranges(actuator, ("ctrlrange", "forcerange", "actrange"), findings)
    if not any(name in actuator.attrib for name in TARGETS):
        message = f"<{actuator.tag}> drives nothing: it has no joint, tendon, site or body"
        findings.report(rules.MISSING_ATTRIBUTE, actuator, message, expected="@joint")
    reach = numbers_of(actuator, "lengthrange", (0.0, 0.0), count=2) or (0.0, 0.0)
    if any(reach) and not reach[0] < reach[1]:
        message = f"'lengthrange' goes from {reach[0]:g} to {reach[1]:g}; the first has to be lower"
        text = actuator.get("lengthrange")
        findings.report(rules.LOWER_ABOVE_UPPER, actuator, message, "@lengthrange", found=text, refused=True)
    crank = numbers_of(actuator, "cranklength", (0.0,), count=1) or (0.0,)
    if "slidersite" in actuator.attrib and crank[0] <= 0:
        message = "an actuator at a crank needs a 'cranklength' above 0"
        findings.report(rules.MISSING_ATTRIBUTE, actuator, message, expected="@cranklength")
    damping = numbers_of(actuator, "kv", (0.0,), count=1) or (0.0,)
    if actuator.tag in {"position", "velocity", "intvelocity", "damper"} and damping[0] < 0:
        message = f"'kv' of <{actuator.tag}> is {damping[0]:g}; expected at least 0"
        findings.report(rules.INVALID_VALUE, actuator, message, "@kv", found=actuator.get("kv"))
    lengths = numbers_of(actuator, "range", count=2)
    if actuator.tag == "muscle" and lengths is not None and not lengths[0] < lengths[1]:
        message = f"'range' of <muscle> goes from {lengths[0]:g} to {lengths[1]:g}; the first has to be lower"
        findings.report(rules.INVALID_VALUE, actuator, message, "@range", found=actuator.get("range"))


def _check_sensor(sensor: XmlElement, kinds: Mapping[str, str], named: Named, findings: ElementFindings) -> None:
    tag = str(sensor.tag)
    for name in ("cutoff", "noise"):
        if (numbers_of(sensor, name, (0.0,), count=1) or (0.0,))[0] < 0:
            message = f"{name!r} of <{tag}> is negative"
            findings.report(rules.INVALID_VALUE, sensor, message, f"@{name}", found=sensor.get(name))
    kind = kinds.get(sensor.get("joint", ""))
    if kind is not None and not takes(tag, kind):
        wanted = "ball joints" if takes(tag, "ball") else "hinges and slides"
        _report_unfit(sensor, "joint", f"<{tag}> is for {wanted}, and this joint is of type {kind!r}", findings)
    limited = OF_LIMITS.get(tag)
    target = named[limited].get(sensor.get(limited, "")) if limited else None
    if limited and target is not None and target.get("limited") != "true":
        _report_unfit(sensor, limited, f"<{tag}> is for a {limited} with limits, and this one has none", findings)
    if tag == "rangefinder" and not any(name in sensor.attrib for name in ("site", "camera")):
        findings.report(rules.MISSING_ATTRIBUTE, sensor, "<rangefinder> has no site and no camera", expected="@site")
    if tag in {"distance", "normal", "fromto"}:
        _check_pairs(sensor, findings)


def _check_equality(equality: XmlElement, kinds: Mapping[str, str], findings: ElementFindings) -> None:
    _check_pairs(equality, findings)
    for name in ("joint1", "joint2"):
        kind = kinds.get(equality.get(name, ""))
        if kind is not None and not takes("joint", kind):
            message = f"only hinges and slides can be coupled, and this joint is of type {kind!r}"
            _report_unfit(equality, name, message, findings)
    if equality.tag == "connect" and "site1" not in equality.attrib and "anchor" not in equality.attrib:
        message = "<connect> of bodies needs an 'anchor'"
        findings.report(rules.MISSING_ATTRIBUTE, equality, message, expected="@anchor")
    if equality.tag in {"connect", "weld"} and equality.get("body1") == "world" and "body2" not in equality.attrib:
        _report_unfit(equality, "body1", "the world cannot be held to itself", findings)


def _check_pairs(element: XmlElement, findings: ElementFindings) -> None:
    for first, second in _PAIRS:
        name = element.get(first)
        if name and name == element.get(second):
            message = f"{first!r} and {second!r} of <{element.tag}> are both {name!r}"
            _report_unfit(element, second, message, findings)


def _check_tendon(tendon: XmlElement, kinds: Mapping[str, str], findings: ElementFindings) -> None:
    _check_ranges(tendon, ("range", "actuatorfrcrange"), findings)
    path = [*tendon.iterchildren("*")]
    least = 2 if tendon.tag == "spatial" else 1
    if len(path) < least:
        what = "two sites" if least == 2 else "one joint"
        findings.report(rules.MISSING_PART, tendon, f"<{tendon.tag}> needs at least {what} in it", expected=what)
    known: set[str | None] = set()
    for place, each in enumerate(path):
        if tendon.tag == "fixed" and each.get("joint") in known:
            _report_unfit(each, "joint", f"the joint {each.get('joint')!r} is in this tendon already", findings)
        known.add(each.get("joint"))
        kind = kinds.get(each.get("joint", ""))
        if kind is not None and not takes("joint", kind):
            message = f"a tendon takes hinges and slides, and this joint is of type {kind!r}"
            _report_unfit(each, "joint", message, findings)
        neighbors = [path[at] for at in (place - 1, place + 1) if 0 <= at < len(path)]
        _check_wrap(each, neighbors, findings)


def _check_wrap(each: XmlElement, neighbors: list[XmlElement], findings: ElementFindings) -> None:
    if each.tag == "geom" and (len(neighbors) < 2 or any(other.tag != "site" for other in neighbors)):
        message = "a geom of a tendon stands between two sites"
        findings.report(rules.UNUSABLE_REFERENCE, each, message, "@geom", found=each.get("geom"))
    if each.tag == "site" and neighbors and all(other.tag == "pulley" for other in neighbors):
        message = "a site of a tendon needs another one beside it, on the same side of a pulley"
        findings.report(rules.UNUSABLE_REFERENCE, each, message, "@site", found=each.get("site"))
    if each.tag == "site" and any(other.tag == "site" and other is neighbors[-1] for other in neighbors):
        after = neighbors[-1]
        if after is each.getnext() and after.get("site") == each.get("site"):
            message = f"the site {each.get('site')!r} is repeated"
            findings.report(rules.UNUSABLE_REFERENCE, after, message, "@site", found=each.get("site"))
    divisor = numbers_of(each, "divisor", (1.0,), count=1) or (1.0,)
    if each.tag == "pulley" and divisor[0] <= 0:
        message = "the divisor of a pulley has to be above 0"
        findings.report(rules.INVALID_VALUE, each, message, "@divisor", found=each.get("divisor"))


def _check_keyframe(key: XmlElement, root: XmlElement, joints: list[str], findings: ElementFindings) -> None:
    if next(root.iter(*WITH_COORDINATES), None) is not None:
        return
    for name, count in most_coordinates(joints).items():
        found = numbers_of(key, name)
        if found is not None and len(found) > count:
            message = f"{name!r} of <key> has {len(found)} numbers, and the model has {count}"
            findings.report(rules.INVALID_VALUE, key, message, f"@{name}", found=key.get(name), expected=f"{count}")


def _check_custom(custom: XmlElement, findings: ElementFindings) -> None:
    if custom.tag == "text" and custom.get("data") == "":
        findings.report(rules.EMPTY_ATTRIBUTE, custom, "'data' of <text> is empty", "@data", refused=True)
    elif custom.tag == "numeric" and not custom.get("data") and not custom.get("size"):
        findings.report(rules.MISSING_ATTRIBUTE, custom, "<numeric> has neither 'data' nor 'size'", expected="@data")
    elif custom.tag == "tuple" and not len(custom):
        findings.report(rules.MISSING_PART, custom, "<tuple> has nothing in it", expected="<element>")


def _check_asset(asset: XmlElement, findings: ElementFindings) -> None:
    tag = str(asset.tag)
    if tag == "material" and not asset.get("name"):
        findings.report(rules.MISSING_ATTRIBUTE, asset, "<material> has no name", expected="@name")
    if tag == "texture":
        _check_texture(asset, findings)
    if tag == "mesh" and not any(name in asset.attrib for name in ("file", "vertex", "builtin")) and not len(asset):
        findings.report(rules.MISSING_ATTRIBUTE, asset, "<mesh> has neither a file nor vertices", expected="@file")
    for name in ("vertex", "face") if tag == "mesh" else ():
        count = len(numbers_of(asset, name, ()) or ())
        if count % 3:
            message = f"{name!r} of <mesh> has {count} numbers, and every three of them are one"
            findings.report(rules.INVALID_VALUE, asset, message, f"@{name}")


def _check_texture(texture: XmlElement, findings: ElementFindings) -> None:
    builtin, kind = texture.get("builtin", "none"), texture.get("type", "cube")
    if builtin != "none":
        sizes = ("width",) if kind != "2d" else ("width", "height")
        for name in sizes:
            if (numbers_of(texture, name, (0.0,), count=1) or (0.0,))[0] < 1:
                message = f"a texture with 'builtin' needs a {name!r} of at least 1"
                findings.report(rules.MISSING_ATTRIBUTE, texture, message, expected=f"@{name}")
    elif not any(name.startswith("file") for name in map(str, texture.attrib)):
        message = "<texture> has neither a file nor 'builtin'"
        findings.report(rules.MISSING_ATTRIBUTE, texture, message, expected="@file")


def _report_unfit(element: XmlElement, attribute: str, message: str, findings: ElementFindings) -> None:
    findings.report(rules.UNUSABLE_REFERENCE, element, message, f"@{attribute}", found=element.get(attribute))
