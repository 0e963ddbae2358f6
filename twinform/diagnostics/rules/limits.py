"""Rules about joint limits. The pass `fill-limits` reports them."""

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
    finds="A missing lower or upper limit that was not filled, as the range would have been upside down.",
    matters="What is written is never changed, so the joint keeps a range of which one end is missing.",
    example="`fill-limits{lower=0 upper=1}` on a joint with `<limit lower='2' .../>` and no upper limit.",
    better="Write both ends in the source, or fill this joint on its own with the option `joints`.",
    references="URDF, `joint/limit`; SDF specification, `joint/axis/limit`.",
)
