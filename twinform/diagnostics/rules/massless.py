"""Rules of the pass that gives bodies without mass some."""

from twinform.diagnostics.rule import Rule, Severity

SPLIT_MASS = Rule(
    name="split-mass",
    severity=Severity.INFO,
    finds="A body that moves and weighs nothing, and that took a share of the mass of the body which it carries.",
    matters="At the zero position of the joints mass, center of mass and inertia of the robot stay exactly what they "
    "were. Elsewhere the share moves with the carrier and not with what it carries.",
    example="`split-massless` on the link between the two joints of a pan-tilt head.",
    better="Write the real mass of the part, if it has one.",
)
TOKEN_MASS = Rule(
    name="token-mass",
    severity=Severity.WARNING,
    finds="A body that moves, weighs nothing and carries nothing, and that got a small ball as its mass; or one whose "
    "joint was made fixed instead.",
    matters="The robot weighs a little more than in its file, or can do one thing less.",
    example="`split-massless` on a wheel without `<inertial>`.",
    better="Write the mass of the part, or let `fill-inertia` compute it from its shapes.",
)
