"""Rules about masses and inertias that no body can have. `check` reports them; the pass `check-inertia` asks more."""

from twinform.diagnostics.rule import Rule, Severity

MISSING_INERTIAL = Rule(
    name="missing-inertial",
    severity=Severity.WARNING,
    finds="A body that moves and for which the file gives no mass: in URDF no link of a rigidly joined group has one.",
    matters="Gazebo drops such a body of URDF with all that hangs on it, and gives one of SDF 1 kg and 1 kg m^2.",
    example="`<link name='upper_arm'><visual>...</visual></link>` as the child of a revolute joint.",
    better="Write an `<inertial>` with the mass and inertia of the part, or fix what stands still to the world.",
    references="SDF specification, `link/inertial`; URDF, `link/inertial`; sdformat, parser_urdf.cc.",
)
NON_POSITIVE_MASS = Rule(
    name="non-positive-mass",
    severity=Severity.WARNING,
    finds="A mass of zero or less, or one that is not finite. A mass of zero is an info until the "
    "pass `check-inertia` finds that the link moves.",
    matters="The equations of motion have no solution: simulators refuse the link, drop it, or fling the robot away.",
    example="`<mass value='0'/>`, `<mass>-0.2</mass>`",
    better="Write the mass in kilograms; a link that only marks a place needs no inertial and a fixed joint.",
    references="SDF specification, `inertial/mass`; URDF, `inertial/mass`.",
)
INDEFINITE_INERTIA = Rule(
    name="indefinite-inertia",
    severity=Severity.WARNING,
    finds="An inertia matrix that is not positive definite: about some axis the body would resist with less than "
    "nothing, or, to the pass `check-inertia`, with nothing.",
    matters="Turning about that axis takes no torque, so integrators divide by zero; Gazebo refuses the link.",
    example="`<inertia ixx='0.01' ixy='0.02' ixz='0' iyy='0.01' iyz='0' izz='0.01'/>`: ixy is larger than ixx and iyy.",
    better="Compute the matrix from the shape and the mass; check the signs and the units of the products of inertia.",
    references="SDF specification, `inertial/inertia`; any text on rigid body dynamics: the inertia is a Gram matrix.",
)
IMPOSSIBLE_INERTIA = Rule(
    name="impossible-inertia",
    severity=Severity.WARNING,
    finds="Principal moments of inertia of which one is larger than the sum of the other two.",
    matters="No arrangement of mass has such moments. libsdformat refuses the model, even where the sum is only just "
    "exceeded because digits were cut off; physics engines become unstable.",
    example="`<inertia ixx='1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/>`: 1 is more than 0.1 + 0.1.",
    better="Compute the matrix from the shape and the mass, about the centre of mass and in kg m^2.",
    references="The triangle inequality of the moments of inertia: ixx + iyy - izz = 2 * sum(m * z^2) >= 0.",
)
INERTIA_FROM_NOTHING = Rule(
    name="inertia-from-nothing",
    severity=Severity.WARNING,
    finds="A link whose inertia is to be computed from its collisions (`auto='true'`), and that has none.",
    matters="Nothing can be computed: libsdformat reports an error and takes 1 kg.",
    example="`<link name='a'><inertial auto='true'/></link>`",
    better="Add the collisions, or write the mass and the inertia.",
    references="libsdformat: ELEMENT_MISSING",
)
