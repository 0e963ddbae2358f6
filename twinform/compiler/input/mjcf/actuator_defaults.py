"""What an actuator of MJCF takes from the default classes: a class has one actuator, whatever element writes it.

All actuators take what is mechanical, such as `ctrlrange` and `gear`. The gains of a shortcut, such as the `kp` of
`position`, come from the nearest class that was written with the same shortcut, or with `general`, whose raw numbers
are read as those of the shortcut. A `general` takes the raw numbers that any shortcut stands for.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import NamedTuple

from twinform.compiler.input.mjcf.number_lists import Numbers, number_text, parse_numbers
from twinform.schemas import XmlElement

ACTUATORS = frozenset({
    "general", "motor", "position", "velocity", "intvelocity", "orientation", "pid", "damper", "cylinder", "muscle",
    "adhesion", "dcmotor", "plugin",
})  # fmt: skip
_RAW = ("gaintype", "gainprm", "biastype", "biasprm", "dyntype", "dynprm", "actdim", "actearly")
_MECHANICAL = frozenset({
    "ctrllimited", "ctrlrange", "forcelimited", "forcerange", "actlimited", "actrange", "gear", "group", "user",
    "cranklength", "delay", "nsample", "interp", "armature", "damping", "inheritrange", "ffrange", "velrange",
})  # fmt: skip
_ONLY_IN = {
    "actlimited": frozenset({"general", "intvelocity", "plugin"}),
    "actrange": frozenset({"general", "intvelocity", "plugin"}),
    "inheritrange": frozenset({"general", "position", "intvelocity", "pid"}),
    "ffrange": frozenset({"general", "pid"}),
    "velrange": frozenset({"general", "pid"}),
    "ctrllimited": ACTUATORS - {"orientation", "damper", "adhesion"},
    "gear": ACTUATORS - {"orientation", "adhesion"},
    "cranklength": ACTUATORS - {"orientation", "adhesion"},
    "armature": ACTUATORS - {"orientation", "adhesion"},
    "damping": ACTUATORS - {"orientation", "adhesion"},
    "forcelimited": ACTUATORS - {"dcmotor"},
    "forcerange": ACTUATORS - {"dcmotor"},
}
"""The elements that have a mechanical attribute, where not all have it."""
_LISTS = frozenset({"gear", "gainprm", "biasprm", "dynprm"})
_GENERAL = "general"


class ActuatorLevel(NamedTuple):
    """What one class writes about its actuator, in order: names of elements and their attributes."""

    written: tuple[tuple[str, Mapping[str, str]], ...]

    @classmethod
    def of(cls, elements: Iterable[XmlElement]) -> "ActuatorLevel":
        """Read the actuator elements of one class."""
        return cls(tuple((str(each.tag), {str(k): str(v) for k, v in each.items()}) for each in elements))


class _State(NamedTuple):
    """The actuator of a class: the element that it was written with, and the values of that element."""

    kind: str
    values: Mapping[str, str]


def actuator_values(element: XmlElement, levels: Sequence[ActuatorLevel]) -> dict[str, str]:
    """Return the values that an actuator takes from its class, which the levels from the top one down make up."""
    states = _states(levels)
    if states and element.tag == _GENERAL:
        _write_as_its_class(element, states[-1])
    tag = str(element.tag)
    mechanical = _merged(
        {name: text for name, text in values.items() if name in _MECHANICAL}
        for level in levels
        for _, values in level.written
    )
    if mechanical.get("ctrllimited") == "false" and tag not in _ONLY_IN["ctrllimited"]:
        for values in (mechanical, element.attrib):  # it would limit, and the element cannot say that it does not
            values.pop("ctrlrange", None)
    found = {name: text for name, text in mechanical.items() if tag in _ONLY_IN.get(name, ACTUATORS)}
    return {**found, **_without_other_damping(_gains(tag, states), {str(name) for name in element.attrib})}


def _write_as_its_class(element: XmlElement, state: _State) -> None:
    """Make a `general` the servo that its class was written as, which is its kind of input too, if it is no other."""
    if not any(name in element.attrib for name in _RAW) and _is_shortcut(state):
        element.tag = state.kind
        return
    own = {name: str(element.attrib[name]) for name in _RAW if name in element.attrib}
    servo = None if "input" in element.attrib else _servo_of(state.kind, _merged([_raw_of(state), own]))
    if servo is not None:
        element.tag = state.kind
        for name in own:
            del element.attrib[name]
        element.attrib.update(servo)


def _servo_of(kind: str, raw: Mapping[str, str]) -> dict[str, str] | None:
    """Return the gains of a `position` or `velocity` that raw numbers are exactly; None where they are none."""
    (gain, *more), (place, stiffness, damping, *others) = (
        (*_list(raw, name, ()), *(0.0,) * 10)[:10] for name in ("gainprm", "biasprm")
    )
    is_affine = raw.get("gaintype", "fixed") == "fixed" and raw.get("biastype") == "affine"
    is_instant = raw.get("dyntype", "none") == "none" and not {"actdim", "actearly"}.intersection(raw)
    if not (is_affine and is_instant) or any((*more, place, *others)) or damping > 0.0:
        return None
    if kind == "position" and stiffness == -gain:
        return {"kp": number_text([gain]), "kv": number_text([-damping])}
    if kind == "velocity" and damping == -gain and not stiffness:
        return {"kv": number_text([gain])}
    return None


def _without_other_damping(values: Mapping[str, str], over: Collection[str]) -> dict[str, str]:
    """Return the values without the damping of a servo that those over them say in the other way: it is one number."""
    gone = {other for own, other in (("kv", "dampratio"), ("dampratio", "kv")) if own in over}
    return {name: text for name, text in values.items() if name not in gone}


def _is_shortcut(state: _State) -> bool:
    return state.kind not in {_GENERAL, "plugin"} and not any(name in state.values for name in _RAW)


def _states(levels: Iterable[ActuatorLevel]) -> list[_State]:
    """Return the actuator of each level, the nearest one last."""
    states: list[_State] = []
    for level in levels:
        above, here = tuple(states), states[-1] if states else _State(_GENERAL, {})
        for tag, values in level.written:
            gains = {name: text for name, text in values.items() if name not in _MECHANICAL and name != "class"}
            if tag == _GENERAL:
                here = _State(here.kind, _merged([here.values, gains]))
            else:
                inherited = here.values if here.kind == tag else _gains(tag, above)
                here = _State(tag, _merged([_without_other_damping(_without_raw(inherited), gains), gains]))
        states.append(here)
    return states


def _gains(tag: str, states: Sequence[_State]) -> dict[str, str]:
    """Return the gains that an actuator takes from the nearest class that has some for it."""
    if tag == _GENERAL:
        return _raw_of(states[-1]) if states else {}
    if tag == "plugin":
        values = states[-1].values if states else dict[str, str]()
        return {name: text for name, text in values.items() if name in {"actdim", "actearly", "dyntype", "dynprm"}}
    for state in reversed(states):
        if state.kind == tag and not any(name in state.values for name in _RAW):
            return dict(state.values)
        if state.kind == tag:
            return _shortcut_of(tag, _raw_of(state)) or _without_raw(state.values)
        read = _shortcut_of(tag, state.values) if state.kind == _GENERAL and state.values else None
        if read is not None:
            return read
    return {}


def _without_raw(values: Mapping[str, str]) -> dict[str, str]:
    return {name: text for name, text in values.items() if name not in _RAW}


def _shortcut_of(tag: str, raw: Mapping[str, str]) -> dict[str, str] | None:
    """Return the gains of a shortcut that raw numbers stand for, or None where they are of another kind of gain."""
    gain, bias = _list(raw, "gainprm", (1.0,)), _list(raw, "biasprm", ())
    kind = raw.get("gaintype", "fixed")
    match tag:
        case "motor" if kind == "fixed":
            return {}
        case "position" | "intvelocity" if kind == "fixed":
            damping = bias[2] if len(bias) > 2 else 0.0
            key = "kv" if damping <= 0 else "dampratio"
            return {"kp": number_text(gain[:1]), **({key: number_text([abs(damping)])} if damping else {})}
        case "velocity" if kind == "fixed":
            return {"kv": number_text(gain[:1])}
        case "adhesion" if kind == "fixed":
            return {"gain": number_text(gain[:1])}
        case "damper" if kind == "affine" and len(gain) > 2:
            return {"kv": number_text([-gain[2]])}
        case "cylinder" if kind == "fixed":
            time = {"timeconst": number_text(_list(raw, "dynprm", ())[:1])} if "dynprm" in raw else {}
            return {"area": number_text(gain[:1]), **({"bias": number_text(bias[:3])} if len(bias) > 2 else {}), **time}
        case _:
            return None


def _raw_of(state: _State) -> dict[str, str]:
    """Return the raw numbers that the actuator of a class stands for."""
    values = state.values
    raw = {name: text for name, text in values.items() if name in _RAW}
    return _merged([_raw_gains(state.kind, values), raw])


def _raw_gains(kind: str, values: Mapping[str, str]) -> dict[str, str]:
    kp, kv = (_list(values, name, (default,))[0] for name, default in (("kp", 1.0), ("kv", 0.0)))
    match kind:
        case "motor":
            return {"gaintype": "fixed", "gainprm": "1", "biastype": "none"}
        case "position":
            damping = _list(values, "dampratio", (0.0,))[0] or -kv
            affine = {"gaintype": "fixed", "gainprm": number_text([kp]), "biastype": "affine"}
            time = {"dyntype": "filterexact", "dynprm": values["timeconst"]} if "timeconst" in values else {}
            return {**affine, "biasprm": number_text([0.0, -kp, damping]), **time}
        case "velocity":
            kv = kv if "kv" in values else 1.0
            affine = {"gaintype": "fixed", "gainprm": number_text([kv]), "biastype": "affine"}
            return {**affine, "biasprm": number_text([0.0, 0.0, -kv])}
        case "damper":
            return {"gaintype": "affine", "gainprm": number_text([0.0, 0.0, -kv])}
        case _:
            return {}


def _list(values: Mapping[str, str], name: str, default: Numbers) -> Numbers:
    return parse_numbers(values.get(name, "")) or default


def _merged(all_values: Iterable[Mapping[str, str]]) -> dict[str, str]:
    """Return the values of several elements over each other: of lists only the first numbers may be written."""
    found: dict[str, str] = {}
    for values in all_values:
        for name, text in values.items():
            own, below = text.split(), found.get(name, "").split() if name in _LISTS else []
            found[name] = " ".join([*own, *below[len(own) :]]) if len(below) > len(own) else text
    return found
