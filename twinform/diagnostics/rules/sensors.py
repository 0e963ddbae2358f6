"""Rules about what sensors cost, for the pass that limits it."""

from twinform.diagnostics.rule import Rule, Severity

LIMITED_SENSOR = Rule(
    name="limited-sensor",
    severity=Severity.INFO,
    finds="A sensor whose update rate, image size or number of rays `limit-sensors` has lowered.",
    matters="It says what the sensor cost and costs: pixels or rays in a second. It sees less, and less often.",
    example="`limit-sensors{max-rate=15}` on a camera with an update rate of 60 Hz.",
    better="Nothing has to be done. Raise the limit where an algorithm needs what the sensor had.",
)
SENSOR_OVER_BUDGET = Rule(
    name="sensor-over-budget",
    severity=Severity.WARNING,
    finds="Sensors that together make more pixels or rays in a second than `limit-sensors` was told, and that it may "
    "not lower further; or one whose cost is not known, because it has no update rate.",
    matters="The simulation is slower than what the budget stands for.",
    example="`limit-sensors{pixels-per-second=1000 min-rate=10}` on a robot with a camera of 640 x 480 pixels.",
    better="Raise the budget or lower `min-rate`, write an `<update_rate>`, or remove a sensor.",
)
