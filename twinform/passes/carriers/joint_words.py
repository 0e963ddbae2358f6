"""Names of the annotations on joints, which both directions read."""

CONTINUOUS = "continuous"
"""The annotation on a continuous joint that is called so in SDF, where most files have revolute without limits."""
MIMIC = "mimic"
"""The annotation on a mimic joint with a `reference` in SDF, the position of the leader that counts as zero."""
OLD_NAME = "use_parent_model_frame"
"""The text of the annotation on an axis where the file called the model's frame so, and has newer syntax elsewhere."""
