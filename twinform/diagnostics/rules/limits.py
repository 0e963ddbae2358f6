"""Rules about joint limits. The passes `fill-limits`, `check-limits` and `tighten-limits` report them."""

from twinform.diagnostics.fix import Safety
from twinform.diagnostics.rule import Rule, Severity

FILLED_LIMIT = Rule(
    name="filled-limit",
    severity=Severity.INFO,
    finds="A joint whose missing limits were filled with the values that the user chose.",
    matters="The new numbers are a choice, not a measurement: planners and controllers will trust them.",
    example="`fill-limits{effort=100}` on a joint with `<limit lower='0' upper='1' velocity='2'/>`.",
    better="Write the limits of the real actuator into the source; then there is nothing to fill.",
    references="URDF, `joint/limit`; SDF specification, `joint/axis/limit`.",
)
UNFILLED_LIMIT = Rule(
    name="unfilled-limit",
    severity=Severity.WARNING,
    finds="A missing lower or upper limit that was not filled, as the lower one would have been above the upper one.",
    matters="What is written is never changed, so the joint keeps a range of which one end is missing.",
    example="`fill-limits{lower=0 upper=1}` on a joint with `<limit lower='2' .../>` and no upper limit.",
    better="Write both ends in the source, or fill this joint on its own with the option `joints`.",
    references="URDF, `joint/limit`; SDF specification, `joint/axis/limit`.",
)
EMPTY_RANGE = Rule(
    name="empty-range",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A revolute or prismatic joint whose lower limit is its upper one; in URDF both are 0 where they are not "
    "written.",
    matters="The joint cannot move. MuJoCo takes it for one without limits, others for a fixed one that still costs a "
    "constraint.",
    example="`<joint type='revolute'>` with `<limit effort='10' velocity='1'/>`.",
    better="Write the range, or make the joint `continuous` or `fixed`.",
    references="URDF, `joint/limit`: lower and upper default to 0.",
)
RANGE_IN_DEGREES = Rule(
    name="range-in-degrees",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A limit of a turning joint of more than two turns (the option `turns` of `check-limits` changes that).",
    matters="Angles are in radians: 90 is more than 14 turns, and planners will use them.",
    example="`<limit lower='-90' upper='90' .../>`",
    better="Write radians; a joint that turns without end is `continuous`.",
)
ZERO_OUT_OF_RANGE = Rule(
    name="zero-out-of-range",
    severity=Severity.INFO,
    finds="A joint whose zero position is outside of its limits.",
    matters="Simulators and viewers start at zero: the joint jumps to its limit, or is pushed there with all force.",
    example="`<limit lower='0.5' upper='1' .../>`",
    better="Move the joint's origin so that zero is in the range, or set an initial position where it is started.",
)
IMPLAUSIBLE_LIMIT = Rule(
    name="implausible-limit",
    severity=Severity.INFO,
    finds="A limit of effort or velocity that no actuator of a robot reaches: by default 100,000 N m (or N) and 1,000 "
    "rad/s (or m/s).",
    matters="It is usually a placeholder, and controllers and planners use it as if it were real.",
    example="`<limit effort='1e6' velocity='10000' .../>`",
    better="Write the numbers in the data sheet of the actuator.",
)
SOFT_LIMIT_OUTSIDE = Rule(
    name="soft-limit-outside",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="Soft limits of a `<safety_controller>` that are outside of the hard ones, or whose lower one is above "
    "the upper one.",
    matters="The controller brakes too late, or never lets the joint move.",
    example="`<limit lower='-1' upper='1' .../><safety_controller soft_upper_limit='1.2' .../>`",
    better="Put the soft limits inside of the hard ones.",
    references="URDF, `joint/safety_controller`.",
)
NEGATIVE_DYNAMICS = Rule(
    name="negative-dynamics",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A damping or friction of a joint below zero.",
    matters="The joint gains energy from moving: the simulation explodes, or the engine refuses the file.",
    example="`<dynamics damping='-0.1'/>`",
    better="Write a number of zero or more.",
)
TIGHTENED_LIMIT = Rule(
    name="tightened-limit",
    severity=Severity.INFO,
    finds="A joint whose hard limits were moved inward, to its soft ones or by a margin.",
    matters="The robot reaches less than its mechanics allow, which is what was asked for.",
    example="`tighten-limits` on a joint with a `<safety_controller>`.",
    better="Nothing has to be done.",
)
UNTIGHTENED_LIMIT = Rule(
    name="untightened-limit",
    severity=Severity.WARNING,
    finds="A joint whose limits were to be moved inward, and which would have had no range left.",
    matters="The joint keeps the limits that it had.",
    example="`tighten-limits{margin=1}` on a joint from -0.5 to 0.5.",
    better="Take a smaller margin, or correct the soft limits.",
)
