"""Rules about masses and inertias. `check` reports the first ones; the pass `check-inertia` asks more."""

from twinform.diagnostics.fix import Safety
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
    fix=Safety.UNSAFE,
    finds="A mass of zero or less, or one that is not finite. A mass of zero is an info until the "
    "pass `check-inertia` finds that the link moves.",
    matters="The equations of motion have no solution: simulators refuse the link, drop it, or fling the robot away.",
    example="`<mass value='0'/>`, `<mass>-0.2</mass>`",
    better="Write the mass in kilograms; a link that is only a place needs no inertial and a fixed joint.",
    references="SDF specification, `inertial/mass`; URDF, `inertial/mass`.",
)
INDEFINITE_INERTIA = Rule(
    name="indefinite-inertia",
    severity=Severity.WARNING,
    finds="An inertia matrix that is not positive definite: one of its principal moments is negative, or, to the "
    "pass `check-inertia`, zero.",
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
    better="Compute the matrix from the shape and the mass, about the center of mass and in kg m^2.",
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
DISTANT_CENTER_OF_MASS = Rule(
    name="distant-centre-of-mass",
    severity=Severity.WARNING,
    finds="A center of mass outside of the box around the shapes of its link.",
    matters="The link swings about a point in the air. Most often the inertial was written in millimeters, or in the "
    "frame of the drawing and not of the link.",
    example="`<inertial><origin xyz='0 0 45'/>...` in a link whose collision is 90 mm long.",
    better="Write the center of mass in meters, in the link frame.",
)
IMPLAUSIBLE_DENSITY = Rule(
    name="implausible-density",
    severity=Severity.WARNING,
    finds="A mass that is too small or too large for the volume of the link's shapes: by default less than 1 kg/m^3, "
    "which is air, or more than 23,000 kg/m^3, which is osmium.",
    matters="A wrong unit is the usual reason (grams for kilograms), and the robot moves as if it were much too "
    "light or too heavy.",
    example="`<mass value='850'/>` for a gripper finger of 5 cm^3.",
    better="Write the mass in kilograms, or correct the size of the shapes.",
)
OVERSIZED_INERTIA = Rule(
    name="oversized-inertia",
    severity=Severity.WARNING,
    finds="An inertia that is larger than the mass of the link can have inside of the box around its shapes.",
    matters="No arrangement of the mass within the shapes has such moments, so the link turns as sluggishly as a much "
    "larger one. Most often they are in g mm^2, or not about the center of mass.",
    example="`<mass value='0.1'/><inertia ixx='25' iyy='25' izz='25' .../>` for a cube of 10 cm.",
    better="Write the inertia in kg m^2 about the center of mass, or let `fill-inertia{replace=all}` compute it.",
    references="T. Popoviciu 1935: a spread over a length l has a variance of at most l^2 / 4.",
)
MASS_RATIO = Rule(
    name="mass-ratio",
    severity=Severity.INFO,
    finds="Two bodies that a joint connects and of which one is many times as heavy as the other.",
    matters="Solvers that iterate over constraints (ODE, Bullet, PhysX, DART's PGS) converge slowly or not at all: "
    "joints stretch and shake, above all where the lighter body carries the heavier one.",
    example="A wheel hub of 1 g between a wheel of 5 kg and a chassis of 100 kg.",
    better="Give the light body more of the real mass, or fix it to a neighbor; `split-massless` spreads mass along a "
    "chain. Solvers in reduced coordinates (Drake, MuJoCo) do not mind.",
)
FILLED_INERTIA = Rule(
    name="filled-inertia",
    severity=Severity.INFO,
    finds="A link whose mass and inertia were computed from its shapes.",
    matters="The numbers are those of evenly filled shapes, not of the real part.",
    example="`fill-inertia{density=2700}` on a link with a collision and no `<inertial>`.",
    better="Write the numbers of a drawing or a scale into the source; then there is nothing to compute.",
)
UNFILLED_INERTIA = Rule(
    name="unfilled-inertia",
    severity=Severity.WARNING,
    finds="A link whose inertia was to be computed from its shapes and could not be: a shape has no inside, a mesh is "
    "open, not found or not readable, or a body that moves has no shape at all.",
    matters="The link stays as it was, and part of a link's shapes would give a wrong mass.",
    example="`fill-inertia` on a link whose collision is a `<plane>`, or an open mesh.",
    better="Name other shapes (`shapes=visual`), take the hull of open meshes (`open-meshes=hull`), say with `--path "
    "DIR` where the meshes are, or write the numbers.",
)
BALANCED_INERTIA = Rule(
    name="balanced-inertia",
    severity=Severity.WARNING,
    finds="A link whose impossible inertia was replaced by the nearest one that a body can have; an info where they "
    "differ by no more than digits that were cut off.",
    matters="The new numbers let a simulator run; they need not be those of the real part. The message tells how "
    "far they are from the old ones.",
    example="`balance-inertia` on `<inertia ixx='1' iyy='0.1' izz='0.1' .../>`, which becomes 0.733, 0.367, 0.367.",
    better="Compute the inertia from the shape and the mass, as `fill-inertia{replace=impossible}` does.",
    references="P. Wensing, S. Kim and J.-J. Slotine 2018, Linear matrix inequalities for physically-consistent "
    "inertial parameter identification.",
)
UNBALANCED_INERTIA = Rule(
    name="unbalanced-inertia",
    severity=Severity.WARNING,
    finds="An impossible inertia that has no nearest possible one: its link has no positive mass, or it is not finite.",
    matters="The link stays as it was, and simulators will refuse it.",
    example="`balance-inertia` on `<mass value='0'/><inertia ixx='0' .../>`.",
    better="Write a mass, or let `fill-inertia{replace=impossible}` or `split-massless` give it one.",
)
