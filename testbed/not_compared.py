"""What `twinform diff` does not compare.

Everything else in a file is compared. The table is the one list of exceptions: the documentation is made from it, and a
test changes values of real files to see that every change is found, or is at one of these places.
"""

from twinform.dataclass import dataclass
from twinform.passes.carriers.carriers import PREFIX

_ISOTROPIC = (
    "number(inertia/{0}ixx) = number(inertia/{0}iyy) and number(inertia/{0}iyy) = number(inertia/{0}izz)"
    " and not(number(inertia/{0}ixy) or number(inertia/{0}ixz) or number(inertia/{0}iyz))"
)


@dataclass(frozen=True, slots=True)
class NotCompared:
    """A place whose values make no difference; the XPath selects attributes, texts, or elements with their content."""

    xpath: str
    what: str
    why: str


# Worlds, densities, and second cameras were once passed over because nothing named them. So
# whatever is in a file is compared, and what is not stands in this list, with a reason.
NOT_COMPARED = (
    NotCompared("/robot/@version | /sdf/@version", "the version of the format", "It says how the file is written."),
    NotCompared(
        "//*[*]/text() | //link/text() | //joint/text() | //visual/text() | //collision/text()",
        "text between elements",
        "No reader looks at it, and a safe fix makes a comment of it.",
    ),
    NotCompared(
        f"//{PREFIX}:*",
        "carriers and annotations as such",
        "What one of them means for the part around it is compared. Without effect, or where the file contradicts it,"
        " it means nothing.",
    ),
    NotCompared(
        "//joint[@type='fixed' or @type='floating' or @type='spherical']"
        "/*[self::axis or self::limit or self::dynamics or self::mimic"
        " or self::safety_controller or self::calibration]"
        " | //joint[@type='ball']/axis//*[not(self::dynamics or self::damping)]"
        " | //joint[@type='ball' and /mujoco]/@axis",
        "the axis of a joint that has none",
        "A fixed, floating or ball joint has no axis, and no reader uses what is said of it but the damping of a ball.",
    ),
    NotCompared(
        "/mujoco/compiler/@*",
        "settings of MuJoCo's compiler",
        "What they make of angles, masses and files is compared; one that nothing in the file needs means nothing.",
    ),
    NotCompared(
        "/mujoco/contact/exclude",
        "excluded contacts of MJCF",
        "A conversion derives them from the tree and from what collides; pairs are compared.",
    ),
    NotCompared(
        "//joint[not(@type='universal' or @type='revolute2' or @type='gearbox')]/axis2",
        "the second axis of a joint that has one",
        "Readers move the joint about the first.",
    ),
    NotCompared(
        "//pbr/metal[following-sibling::metal] | //pbr/specular[following-sibling::specular]",
        "a workflow of PBR that another one follows",
        "Readers take the last of each kind.",
    ),
    NotCompared(
        "/robot/joint[@type='planar']/*[self::limit or self::dynamics or self::mimic]",
        "limits of a planar joint",
        "It has three axes, and no reader says which of them a limit is about.",
    ),
    NotCompared(
        f"//*[{PREFIX}:stands-again(.)]",
        "what stands again where it may stand once",
        "Readers take the first, or of the workflows of `<pbr>` the last; `stands-again` is not of XPath, and true of"
        " what `repeated-element` finds. Compared are the cameras of a sensor and what is in elements of other tools.",
    ),
    NotCompared(
        "//joint//mimic[not(@joint = //joint/@name)"
        " or @joint = //joint[@type='fixed' or @type='floating' or @type='ball' or @type='spherical']/@name]",
        "a mimic of what has no axis",
        "No joint of that name moves about one, so readers have nothing to follow.",
    ),
    NotCompared(
        "/robot/joint[@type='continuous']/limit/@*[name()='lower' or name()='upper']"
        " | //joint[@type='continuous']/axis/limit/*[self::lower or self::upper]",
        "the ends of a continuous joint",
        "It turns without end.",
    ),
    NotCompared(
        "//joint[@type='ball']/pose",
        "how the frame of a ball joint is turned",
        "It has no axis; its place is compared.",
    ),
    NotCompared(
        f"//inertial[mass = 0 or mass/@value = 0 or ({_ISOTROPIC.format('@')}) or not(inertia)]/origin/@rpy"
        f" | //inertial[mass = 0 or ({_ISOTROPIC.format('')}) or not(inertia)]/pose",
        "how an inertia is turned that is the same in all directions",
        "Turned, it is the same inertia; its center is compared.",
    ),
    NotCompared(
        "//inertial[@auto='true' or @auto='1']/*[self::mass or self::inertia or self::pose]",
        "mass and inertia of a link whose inertia is automatic",
        "Readers compute them from the shapes.",
    ),
    NotCompared(
        "/robot/link/inertial[mass/@value = 0]/*[self::inertia or self::origin]",
        "center and inertia of a link without mass",
        "On a fixed joint such a link is a frame.",
    ),
    NotCompared(
        "/robot/material | //visual/material/@name",
        "names of materials, and materials that no visual has",
        "A name leads to a look, and the look of each visual is compared.",
    ),
    NotCompared("/robot/link/collision/material", "the material of a collision", "No reader of URDF looks at it."),
    NotCompared(
        "//link//frame | //joint//frame[not(ancestor::force_torque or ancestor::sensor/force_torque)]",
        "frames in links and joints of SDF 1.5 and 1.6",
        "No reader has ever used them.",
    ),
    NotCompared(
        "//axis/use_parent_model_frame | //axis2/use_parent_model_frame",
        "in which frame the direction of an axis is written",
        "Its direction in the model is compared, which is another one only where the two frames are turned.",
    ),
    NotCompared("//gui//pose/@*", "the frame of a pose in the window", "Gazebo takes it as one in the world."),
)
"""Every place that `diff` ignores."""
