"""Edits that add something: a shape, sensor, plugin or frame, a link with its joint, what a joint or link lacked."""

from random import Random

from testbed.edits.edit import Edit, Insert, Operation, path_of
from testbed.edits.new_parts import (
    GAZEBO_JOINT_TAGS,
    GAZEBO_LINK_TAGS,
    JOINTS,
    SDF_JOINT_PARTS,
    SDF_PARTS,
    URDF_JOINT_PARTS,
    URDF_PARTS,
    origin,
    plugin,
    pose,
    sdf_inertial,
    sdf_link,
    urdf_ends,
    urdf_inertial,
    urdf_link,
)
from testbed.edits.scene import Scene, name_of
from twinform.schemas import XmlElement


def add_part(scene: Scene, random: Random) -> Edit | None:
    """A visual, collision or sensor in a link."""
    if not scene.links:
        return None
    kind = random.choice(sorted(URDF_PARTS if scene.is_urdf else SDF_PARTS))
    make = (URDF_PARTS if scene.is_urdf else SDF_PARTS)[kind]
    link = random.choice(scene.links)
    return Edit("add a part", (_into(link, make(scene.fresh(f"added_{kind}"), random), random),))


def add_inertial(scene: Scene, random: Random) -> Edit | None:
    """The mass of a link that had none."""
    bare = [each for each in scene.links if each.find("inertial") is None]
    if not bare:
        return None
    made = urdf_inertial(random) if scene.is_urdf else sdf_inertial(random)
    return Edit("add an inertial", (_into(random.choice(bare), made, random),))


def add_gazebo(scene: Scene, random: Random) -> Edit | None:
    """What Gazebo alone reads: tags for a link or joint, a plugin."""
    if not scene.is_urdf:
        return (
            Edit("add a plugin", (_into(random.choice(scene.models), plugin(scene.fresh("added_plugin")), random),))
            if scene.models
            else None
        )
    places = [name_of(each) for each in (*scene.links, *scene.joints) if name_of(each)]
    if not places or random.random() < 0.25:
        return Edit(
            "add a plugin", (_into(scene.root, f"<gazebo>{plugin(scene.fresh('added_plugin'))}</gazebo>", random),)
        )
    name = random.choice(places)
    of_joint = name in {name_of(each) for each in scene.joints}
    tags = GAZEBO_JOINT_TAGS if of_joint else GAZEBO_LINK_TAGS
    block = f'<gazebo reference="{name}">{random.choice(tags)}</gazebo>'
    return Edit("add <gazebo>", (_into(scene.root, block, random),))


def add_frame(scene: Scene, random: Random) -> Edit | None:
    """A frame of SDF; a link without mass on a fixed joint in URDF."""
    names = [name_of(each) for each in scene.links]
    if not names:
        return None
    name, base = scene.fresh("added_frame"), random.choice(names)
    if scene.is_urdf:
        joint = f'<joint name="{name}_joint" type="fixed">{urdf_ends(base, name)}{origin(random)}</joint>'
        return Edit("add a frame", (_into(scene.root, f'<link name="{name}"/>', random), _at_end(scene.root, joint)))
    attached = f' attached_to="{base}"' if random.random() < 0.7 else ""
    frame = f'<frame name="{name}"{attached}>{pose(random)}</frame>'
    return Edit("add a frame", (_into(_model_of(scene, base), frame, random),))


def add_link(scene: Scene, random: Random) -> Edit | None:
    """A whole link with mass and shapes, and its joint."""
    if not scene.links:
        return None
    base = random.choice(scene.links)
    name, kind = scene.fresh("added_link"), random.choice(JOINTS)
    texts = urdf_link if scene.is_urdf else sdf_link
    link, joint = texts(name, name_of(base), kind, random)
    place = scene.root if scene.is_urdf else base.getparent()
    if place is None:
        return None
    return Edit("add a link", (_into(place, link, random), _at_end(place, joint)))


def add_to_joint(scene: Scene, random: Random) -> Edit | None:
    """What a joint lacked: an axis, limits, dynamics, in URDF also mimic, a safety controller, a calibration."""
    wanted = URDF_JOINT_PARTS if scene.is_urdf else SDF_JOINT_PARTS
    moving = [joint for joint in scene.joints if joint.get("type") != "fixed"]
    spots = [(joint, path) for joint in moving for path in wanted if _lacks(joint, path)]
    if not spots:
        return None
    joint, path = random.choice(spots)
    others = [name_of(each) for each in moving if each is not joint]
    if path.endswith("mimic") and not others:
        return None
    made = wanted[path].format(other=random.choice(others) if others else "", by=random.choice([0.5, 1, -1, 2]))
    place = joint.find(path.rpartition("/")[0] or ".")
    assert place is not None
    return Edit("add to a joint", (_into(place, made, random),))


def _lacks(joint: XmlElement, path: str) -> bool:
    holder = joint.find(path.rpartition("/")[0] or ".")
    return holder is not None and joint.find(path) is None


def add_transmission(scene: Scene, random: Random) -> Edit | None:
    """What drives a joint, in URDF."""
    moving = [name_of(each) for each in scene.joints if each.get("type") in JOINTS[1:]]
    if not scene.is_urdf or not moving:
        return None
    joint, name = random.choice(moving), scene.fresh("added_transmission")
    made = (
        f'<transmission name="{name}"><type>transmission_interface/SimpleTransmission</type><joint name="{joint}">'
        f"<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>"
        f'<actuator name="{name}_motor"><mechanicalReduction>5</mechanicalReduction></actuator></transmission>'
    )
    return Edit("add a transmission", (_into(scene.root, made, random),))


def _into(place: XmlElement, xml: str, random: Random) -> Operation:
    return Insert(path_of(place), random.choice([len(place), len(place), random.randint(0, len(place))]), xml)


def _at_end(place: XmlElement, xml: str) -> Operation:
    return Insert(path_of(place), len(place) + 1, xml)


def _model_of(scene: Scene, link: str) -> XmlElement:
    homes = [each.getparent() for each in scene.links if name_of(each) == link]
    return homes[0] if homes and homes[0] is not None else scene.root
