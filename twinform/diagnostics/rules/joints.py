"""Rules about axes, limits and mimics that say little, nothing, or something that cannot be."""

from twinform.diagnostics.rule import Rule, Severity

MISSING_AXIS = Rule(
    name="missing-axis",
    severity=Severity.INFO,
    finds="A joint that moves and has no axis.",
    matters="The default of URDF is x and that of SDF is z, so the same omission means two different robots.",
    example="A revolute joint without `<axis>`.",
    better="Write the axis.",
    references="URDF, `joint/axis`; SDF specification, `joint/axis/xyz`",
)
UNUSED_AXIS = Rule(
    name="unused-axis",
    severity=Severity.INFO,
    finds="An axis, or something that belongs to one such as a limit, on a joint that has no use for it.",
    matters="Every reader ignores it. If the joint was meant to move, its type is wrong.",
    example="`<joint type='fixed'>` with `<axis xyz='0 0 1'/>`; `<axis2>` of a revolute joint.",
    better="Delete it, or correct the type.",
)
UNNORMALIZED_AXIS = Rule(
    name="unnormalised-axis",
    severity=Severity.INFO,
    finds="A joint axis that is not of length one.",
    matters="It is only a direction: readers normalize it, so its length has no effect.",
    example="`<axis xyz='0 0 10'/>`",
    better="Write a vector of length one.",
    references="URDF, `joint/axis`: the vector should be normalized",
)
UNUSED_LIMIT = Rule(
    name="unused-limit",
    severity=Severity.INFO,
    finds="A `continuous` joint with a lower or upper limit.",
    matters="Every reader ignores the limits: the joint turns as far as it likes.",
    example="`<joint type='continuous'>` with `<limit lower='-1' upper='1' .../>`",
    better="Make the joint `revolute`, or leave the limits out.",
)
CONTINUOUS_IN_SDF = Rule(
    name="continuous-in-sdf",
    severity=Severity.WARNING,
    finds="A `continuous` joint in SDF.",
    matters="SDF has the type, but no physics engine of Gazebo supports it: DART and Bullet Featherstone hold the "
    "joint still, "
    "with an error in the log, and Bullet leaves it out. Drake and converters to URDF turn it.",
    example="`<joint name='wheel_joint' type='continuous'>`",
    better="Make it `revolute` without lower and upper limits, as libsdformat does with URDF; `replace-continuous` "
    "does that, and leaves URDF, where the type is right, as it is.",
    references="gz-physics, `SDFFeatures.cc` of dartsim, bullet and bullet-featherstone",
)
REPLACED_CONTINUOUS = Rule(
    name="replaced-continuous",
    severity=Severity.INFO,
    finds="A `continuous` joint of SDF that `replace-continuous` has made `revolute`.",
    matters="It turns as before, and in Gazebo as well. Limits of its angle, which no reader obeyed, are gone.",
    example="`<joint name='wheel_joint' type='continuous'>`",
    better="Nothing needs doing.",
)
ZERO_LIMIT = Rule(
    name="zero-limit",
    severity=Severity.INFO,
    finds="A limit of zero for the effort or the velocity of a joint that moves.",
    matters="Gazebo enforces it, so the joint does not move; ROS controllers that enforce limits hold it.",
    example="`<limit effort='0' velocity='0' .../>`",
    better="Write what the actuator can do; a passive joint needs neither in SDF and in URDF 1.2.",
)
MIMIC_CYCLE = Rule(
    name="mimic-cycle",
    severity=Severity.WARNING,
    unsound=True,
    finds="Joints that mimic each other in a circle.",
    matters="None of them has a position of its own; engines drop the constraint or do not settle.",
    example="`left` mimics `right` and `right` mimics `left`.",
    better="Let one of them lead and the others follow.",
)
EMPTY_DYNAMICS = Rule(
    name="empty-dynamics",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A `<dynamics>` of URDF with neither damping nor friction.",
    matters="It has no effect, and urdfdom refuses the whole file for it.",
    example="`<dynamics/>`",
    better="Delete it, or write `damping` or `friction`.",
)
