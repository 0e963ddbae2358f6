"""Hints for unknown elements and attributes: typos, names of the other format or of other tools, wrong places."""

from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from functools import cache

from twinform.diagnostics import did_you_mean
from twinform.ir.versions import Version
from twinform.schemas.facts import Fact, Table, table
from twinform.schemas.xml import XmlElement, prefix_of

_INSTEAD = {
    ("urdf", "pose"): "URDF writes <origin xyz='x y z' rpy='roll pitch yaw'/>",
    ("urdf", "uri"): "URDF writes the attribute filename='package://...'",
    ("urdf", "ambient"): "URDF writes <color rgba='red green blue alpha'/>",
    ("urdf", "diffuse"): "URDF writes <color rgba='red green blue alpha'/>",
    ("urdf", "plugin"): "write it into <gazebo>",
    ("urdf", "sensor"): "write it into <gazebo reference='the link'>",
    ("urdf", "surface"): "write <mu1>, <mu2>, <kp> or <kd> into <gazebo reference='the link'>",
    ("urdf", "static"): "write <gazebo><static>true</static></gazebo>",
    ("urdf", "include"): "URDF has no includes; xacro has <xacro:include filename='...'/>",
    ("urdf", "frame"): "URDF writes a link without anything in it, on a fixed joint",
    ("urdf", "model"): "URDF has one <robot>, with all links and joints in it",
    ("sdf", "origin"): "SDF writes <pose>x y z roll pitch yaw</pose>",
    ("sdf", "color"): "SDF writes <ambient> and <diffuse>, each with 'red green blue alpha'",
    ("sdf", "texture"): "SDF writes <pbr><metal><albedo_map>",
    ("sdf", "robot"): "SDF writes <model>",
    ("sdf", "gazebo"): "SDF needs no <gazebo>: what is in it stands in the link, joint or model itself",
    ("sdf", "transmission"): "it is an element of URDF; in SDF a plugin drives the joints",
    ("sdf", "safety_controller"): "it is an element of URDF; SDF has <limit> in <axis>",
    ("mjcf", "link"): "MJCF writes <body>, and the bodies that hang on it inside",
    ("mjcf", "collision"): "MJCF writes <geom>",
    ("mjcf", "visual"): "MJCF writes <geom contype='0' conaffinity='0'>",
    ("mjcf", "geometry"): "MJCF writes <geom type='...' size='...'>",
    ("mjcf", "origin"): "MJCF writes pos='x y z' and quat='w x y z' into the element",
    ("mjcf", "pose"): "MJCF writes pos='x y z' and quat='w x y z' into the element",
    ("mjcf", "limit"): "MJCF writes range='lower upper' into the joint",
    ("mjcf", "dynamics"): "MJCF writes damping='...' and frictionloss='...' into the joint",
    ("mjcf", "mimic"): "MJCF writes <joint joint1='...' joint2='...' polycoef='...'/> into <equality>",
    ("mjcf", "sdf"): "the root of MJCF is <mujoco>",
    ("mjcf", "robot"): "the root of MJCF is <mujoco>",
}
"""What to write instead of an element of another format."""
_OTHERS = {"urdf": ("sdf",), "sdf": ("urdf",), "mjcf": ("urdf", "sdf")}
"""The formats of which somebody may have used an element."""
_SAME = {
    "altitude": "altimeter",
    "continuous": "hinge",
    "floating": "free",
    "free": "floating",
    "height": "length",
    "hinge": "revolute",
    "laser": "gpu_lidar",
    "prismatic": "slide",
    "revolute": "hinge",
    "rigid": "fixed",
    "rotary": "revolute",
    "rotation": "revolute",
    "rotational": "revolute",
    "slide": "prismatic",
    "slider": "prismatic",
    "spherical": "ball",
    "translational": "prismatic",
    "weld": "fixed",
}
"""Names in other tools, and what they are called here."""
_MOST_PARENTS = 3


def hint_for_word(word: str, known: Collection[str]) -> str | None:
    """For a value that is none of the allowed ones."""
    same = _SAME.get(word.lower())
    return f"did you mean {same!r}?" if same in known else did_you_mean(word, known)


def hint_for_element(
    format_: str, name: str, known: Collection[str], attributes: Collection[str], around: Sequence[str] = ()
) -> str | None:
    """For an element that is not known where it stands, below the elements `around` it, the nearest first.

    The nearest one has the `known` children, and attributes.
    """
    if name in attributes:
        return f"{format_.upper()} writes it as an attribute: {name}='...'"
    return (
        _INSTEAD.get((format_, name))
        or did_you_mean(name, known)
        or _elsewhere(format_, name, around)
        or next((f"it is an element of {each.upper()}" for each in _OTHERS[format_] if name in _parents(each)), None)
    )


def hint_for_attribute(format_: str, name: str, known: Collection[str], children: Collection[str]) -> str | None:
    """For an attribute that its element does not have; it has the `known` ones, and children."""
    if name in children:
        return f"{format_.upper()} writes it as an element: <{name}>...</{name}>"
    return hint_for_word(name, known)


def new_holder(format_: str, fact: Fact, around: Sequence[str], version: Version) -> str | None:
    """Return which of the elements `around` a value has it in a later version; None if it did not move further out."""
    definitions = table(format_).definitions
    for holder in around[1:]:
        rows = definitions[holder].children if holder in definitions else ()
        if fact.type and any(
            row.name == fact.name and row.type == fact.type and row.exists_in(version) for row in rows
        ):
            return holder
    return None


def _elsewhere(format_: str, name: str, around: Sequence[str]) -> str | None:
    parents = sorted(_parents(format_).get(name, ()))
    if around[1:] and around[0] in parents:  # an element of the same name has it, in another place
        others = sorted(_places_with(format_, around[0], name))
        if not others or around[1] in others:
            return None  # another version has it here
        where = f"that of <{others[0]}> has" if len(others) == 1 else "others have"
        return f"the <{around[0]}> of <{around[1]}> has no <{name}>; {where}"
    if not 0 < len(parents) <= _MOST_PARENTS:  # where it may stand in many they are no hint
        return None
    return f"it belongs in {' or '.join(f'<{parent}>' for parent in parents)}"


@cache  # both names are in the tables
def _places_with(format_: str, name: str, child: str) -> frozenset[str]:
    """Return the elements in which an element of a name may have a child."""
    facts = table(format_)
    found: set[str] = set()
    pending = [(holder, row) for holder, fact in facts.definitions.items() for row in fact.children]
    while pending:
        holder, row = pending.pop()
        inside = facts.resolve(row).children
        if row.name == name and not row.dialect and any(each.name == child for each in inside):
            found.add(holder)
        pending.extend((row.name, each) for each in row.children)
    return frozenset(found)


@cache
def _parents(format_: str) -> dict[str, frozenset[str]]:
    """For each element of a format, in which others it may stand."""
    facts = table(format_)
    found: defaultdict[str, set[str]] = defaultdict(set)
    for holder, child in _children(facts):
        found[child].add(holder)
    return {child: frozenset(holders) for child, holders in found.items()}


def _children(facts: Table) -> Iterator[tuple[str, str]]:
    """Every element with one that may stand in it, by their names."""
    todo = [(facts.root, facts.definitions[facts.root])]
    seen: set[tuple[str, str]] = set()
    while todo:
        name, fact = todo.pop()
        for row in (row for row in facts.resolve(fact).children if not row.dialect):
            yield name, row.name
            if not _is_seen(row, seen):
                todo.append((row.name, row))


def _is_seen(row: Fact, seen: set[tuple[str, str]]) -> bool:
    """Whether a definition was looked into already under this name; definitions may hold themselves."""
    if row.reference is None:
        return False
    key = (row.name, row.reference)
    known = key in seen
    seen.add(key)
    return known


_DRAKE = """
    acceleration accepting_renderer angle ball_constraint ball_constraint_body_A ball_constraint_body_B
    ball_constraint_p_AP ball_constraint_p_BQ bushing_force_damping bushing_force_stiffness bushing_frameA
    bushing_frameC bushing_torque_damping bushing_torque_stiffness capsule child circular_arc
    collision_filter_group compliant_hydroelastic controller_gains curves damping declare_convex
    deformable_properties diffuse_map ellipsoid gear_ratio hunt_crossley_dissipation hydroelastic_margin
    hydroelastic_modulus ignored_collision_filter_group illustration_properties initial_tangent is_periodic
    joint length line_segment linear_bushing_rpy linear_spring_damper linear_spring_damper_body_A
    linear_spring_damper_body_B linear_spring_damper_damping linear_spring_damper_free_length
    linear_spring_damper_p_AP linear_spring_damper_p_BQ linear_spring_damper_stiffness mass_damping mass_density
    material_model member member_group mesh_resolution_hint mimic mu_dynamic mu_static outward_normal parent
    perception_properties plane_normal point_contact_stiffness point_on_plane poissons_ratio
    proximity_properties radius relaxation_time rigid_hydroelastic rotor_inertia screw_thread_pitch
    soft_hydroelastic stiffness_damping tendon_constraint tendon_constraint_damping tendon_constraint_joint
    tendon_constraint_lower_limit tendon_constraint_offset tendon_constraint_stiffness
    tendon_constraint_upper_limit visual wall_boundary_condition youngs_modulus
"""

# Drake compares the text `drake:`, whatever namespace it stands for, and 38 of its own files
# declare none: so the prefix decides. The names are those in the Drake 1.51 wheel.
_NAMES = {"drake": frozenset(_DRAKE.split())}
"""The names that have each prefix. It is also the name of the dialect."""


def dialect_of(element: XmlElement, name: str) -> tuple[str, str] | None:
    """The prefix and the local name of an element or attribute, where the prefix is that of a known reader."""
    prefix = prefix_of(element, name)
    return (prefix, name.partition("}")[2]) if prefix in _NAMES else None


def words_of(prefix: str) -> frozenset[str]:
    """What the reader that a prefix stands for knows."""
    return _NAMES[prefix]
