"""Rules of `--split`: what becomes of the models of a world."""

from twinform.diagnostics.rule import Rule, Severity

KEPT_AS_SDF = Rule(
    name="kept-as-sdf",
    severity=Severity.WARNING,
    finds="A model of a world that is split, and that Gazebo would read differently if it were URDF.",
    matters="Gazebo reads URDF with a converter of its own: it refuses floating joints, leaves out links without mass "
    "with all that hangs from them, and knows no planes and no models in models. It does not report what is "
    "missing. So the file of this model is SDF, and the world includes that.",
    example="A ground plane; a caster on a ball joint, which is three joints in URDF.",
    better="Nothing needs doing for Gazebo. `--model NAME --to urdf` makes URDF of the model for ROS. `--deny "
    "kept-as-sdf` refuses the world instead.",
)
