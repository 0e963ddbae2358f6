"""Every built-in pass with options that make it do something on a given file."""

import json
from collections.abc import Callable
from pathlib import Path
from random import Random

from lxml import etree

from testbed.corpus.files import ROOT
from testbed.edits.scene import Scene, name_of

_GUESTS = ("examples/crate/model.sdf", "examples/gripper.urdf", "testbed/edits/nested.sdf")
_ALWAYS = {
    "add-plugin": "add-plugin{system=joint-state-publisher}",
    "balance-inertia": "balance-inertia{thickness=0.01}",
    "bridge-config": "bridge-config{file=bridge.yaml}",
    "check-inertia": "check-inertia",
    "check-limits": "check-limits{effort=500 velocity=20}",
    "check-plugins": "check-plugins",
    "drop": 'drop{visuals="*" sensors="*"}',
    "fill-inertia": "fill-inertia{density=2700 shapes=either replace=all}",
    "fill-limits": "fill-limits{effort=100 velocity=3.14 lower=-1 upper=1 damping=0.1 friction=0.2}",
    "flatten-models": "flatten-models{separator=__}",
    "lump-fixed-joints": "lump-fixed-joints",
    "materials": "materials{pbr=true roughness=0.7}",
    "migrate-gazebo-classic": "migrate-gazebo-classic",
    "prefix-names": "prefix-names{prefix=left_}",
    "rewrite-uris": "rewrite-uris{to=model kinds=[mesh,texture]}",
    "ros2-control-from-transmissions": "ros2-control-from-transmissions",
    "set-surface": "set-surface{mu=0.9 mu2=0.5 kp=10000 restitution=0.1}",
    "split-massless": "split-massless{share=0.05}",
    "tighten-limits": "tighten-limits{margin=0.02}",
    "transmissions-from-ros2-control": "transmissions-from-ros2-control",
}


def pipeline(name: str, text: bytes, random: Random) -> str | None:
    """The pass as a pipeline for this file; None where it has nothing for it to do."""
    if name in _ALWAYS:
        return _ALWAYS[name]
    return _CHOSEN[name](Scene(etree.fromstring(text)), random)


def _add_sensor(scene: Scene, random: Random) -> str | None:
    link = _link(scene, random)
    kind = random.choice(["camera", "imu", "gpu_lidar"])
    return link and f"add-sensor{{type={kind} link={link} xyz=[0.1,0,0.2] rpy=[0,0.3,0] rate=15}}"


def _attach(scene: Scene, random: Random) -> str | None:
    link, guest = _link(scene, random), ROOT / random.choice(_GUESTS)
    return link and f"attach{{file={_quoted(guest)} to={link} prefix=guest_ xyz=[0,0.1,0.3] rpy=[0,0,0.5]}}"


def _rename(scene: Scene, random: Random) -> str | None:
    named = [name_of(each) for each in (*scene.links, *scene.joints, *scene.parts("frame")) if name_of(each)]
    if not named:
        return None
    old = random.choice(named)
    pair = f"{old}:{scene.fresh('renamed')}"
    return f"rename{{names=[{_quoted(pair)}]}}" if ":" not in old else None


def _reroot(scene: Scene, random: Random) -> str | None:
    link = _link(scene, random)
    return link and f"reroot{{link={link}}}"


def _weld(_: Scene, random: Random) -> str:
    return random.choice(["weld-to-world{xyz=[0,0,0.5]}", "weld-to-world"])


def _link(scene: Scene, random: Random) -> str:
    return _quoted(name_of(random.choice(scene.links))) if scene.links else ""


def _quoted(value: str | Path) -> str:
    return json.dumps(str(value), ensure_ascii=False)


_CHOSEN: dict[str, Callable[[Scene, Random], str | None]] = {
    "add-sensor": _add_sensor,
    "attach": _attach,
    "rename": _rename,
    "reroot": _reroot,
    "weld-to-world": _weld,
}
NAMES = tuple(sorted((*_ALWAYS, *_CHOSEN)))
