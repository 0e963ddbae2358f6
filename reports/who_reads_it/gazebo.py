"""What do Gazebo's engines make of each element of SDF?"""

import tempfile
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import NotRequired, TypedDict

from reports.harness.needs import need
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.engines import gazebo
from testbed.engines.gazebo.differing import short
from testbed.markdown import subsection, table

_ABOUT = """\
Each row is a small model that was loaded into the engines of gz-physics 5 with libsdformat 12, those of Gazebo
Fortress, and stepped for 0.2 s. A link `a` is fixed to the world, `b` hangs on the joint in question; models are in
`reports/who_reads_it/gazebo_features.toml`. *Newer releases* were read, not run: gz-physics 6 to 9 (Garden to Jetty),
its main branch of August 2026, and the files that are named with each. Whole robots are on
[another page](same_robot.md#conversions-in-gazebos-own-physics).

Bullet is the plugin of constraints between free bodies here. It makes a hinge of every joint, in single precision; it
knows the degrees of freedom of `revolute` and `fixed` alone. Since gz-physics 6 there is Bullet Featherstone beside it.
TPE has no joints and no forces: links move with their model, as they are set to."""
_SOURCE = Path(__file__).with_name("gazebo_features.toml")
_BODY = "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
_NOTHING = "<inertial><mass>0</mass><inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz></inertia></inertial>"
_LINK = '<link name="{0}"><pose>{1} 0 0 0 0 0</pose>{2}</link>'
_FIX = '<joint name="world_joint" type="fixed"><parent>world</parent><child>a</child></joint>'
_MACROS = {
    "HELD": f"LINK_A {_FIX}",
    "LINK_A": _LINK.format("a", 0, "BODY"),
    "LINK_B": _LINK.format("b", 1, "BODY"),
    "LINK_C": _LINK.format("c", 2, "BODY"),
    "MASSLESS_B": _LINK.format("b", 1, _NOTHING),
    "BODY": _BODY,
    "NO_CONTACTS": '<collision name="c"><max_contacts>0</max_contacts>'
    "<geometry><sphere><radius>0.1</radius></sphere></geometry></collision>",
    "BALL": '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>',
}
_SETTINGS = gazebo.Settings(steps=200)
_ENGINES = {
    "DART 6.12": gazebo.PhysicsEngine.DART,
    "Bullet 3.24": gazebo.PhysicsEngine.BULLET,
    "TPE": gazebo.PhysicsEngine.TPE,
}
_every_engine = need(lambda: all(map(gazebo.available, _ENGINES.values())), gazebo.MISSING)
_PUSHED = 1e-3
"""So far apart, in m, is no rounding."""
_ASKED = {
    "limits": ("lower", "upper"),
    "strength": ("effort", "velocity"),
    "dynamics": ("friction", "damping", "stiffness", "rest"),
}


class _Case(TypedDict):
    name: str
    model: str
    asks: NotRequired[str]


class _Group(TypedDict):
    title: str
    newer: str
    case: list[_Case]


def measure(sample: Sample) -> Findings:
    """Run the models."""
    groups: list[_Group] = tomllib.loads(_SOURCE.read_text(encoding="utf-8"))["group"][:: sample.every]
    with tempfile.TemporaryDirectory() as folder:
        return Findings([_section(group, Path(folder)) for group in groups], f"{len(groups)} groups of models")


def _section(group: _Group, folder: Path) -> str:
    files = [_file(case, folder) for case in group["case"]]
    found = [gazebo.simulate(files, engine, _SETTINGS) for engine in _ENGINES.values()]
    rows = [
        (case["name"], *(_summary(one[file.resolve()], case.get("asks", "")) for one in found))
        for case, file in zip(group["case"], files, strict=True)
    ]
    return subsection(group["title"], table(["", *_ENGINES], rows), f"**Newer releases.** {group['newer']}")


def _file(case: _Case, folder: Path) -> Path:
    text = case["model"]
    for name, meaning in _MACROS.items():
        text = text.replace(name, meaning)
    path = folder / f"{abs(hash(text))}.sdf"
    path.write_text(f'<sdf version="1.9"><model name="m">{text}</model></sdf>', encoding="utf-8")
    return path


def _summary(found: gazebo.Simulation, asks: str) -> str:
    """What happened, in short."""
    if not found.done:
        why = found.errors or found.console.errors[:1]
        return f"**{found.outcome}** at {found.stage}" + (f": {why[0]}" if why else "")
    parts = [*_freedom(found), *_observe(found, asks)]
    parts += [f"error: {line}" for line in dict.fromkeys(found.console.errors)]
    parts += ["warning: no mass"] if any("zero mass" in line for line in found.console.warnings) else []
    return "; ".join(parts) or "loads"


def _freedom(found: gazebo.Simulation) -> Iterator[str]:
    if joint := found.joint.get("m::j"):
        free = joint.freedom
        yield "no joint" if free is None else f"{free} degree{'' if free == 1 else 's'} of freedom"


def _observe(found: gazebo.Simulation, asks: str) -> Iterator[str]:
    first, last = found.moments[0].links, found.moments[-1].links
    if asks == "fall":
        fallen = sum(last[name].pose[2] - first[name].pose[2] for name in last) / len(last)
        yield "falls" if fallen < -0.1 else "stays"
    elif asks == "apart":
        before, after = (abs(state["m::c"].pose[0] - state["m::b"].pose[0]) for state in (first, last))
        yield "pushed apart" if after > before + _PUSHED else "not pushed apart"
    elif asks:
        yield from _inside(found, _ASKED[asks])


def _inside(found: gazebo.Simulation, names: tuple[str, ...]) -> Iterator[str]:
    """Numbers of the joint as DART has them; the others do not give them."""
    for joint in found.joints:
        if short(joint.name) == "j" and joint.inside is not None:
            yield from (f"{name} {getattr(joint.inside, name)[0]:.6g}" for name in names)


SECTION = Section("gazebo", _ABOUT, measure, (_every_engine,))
