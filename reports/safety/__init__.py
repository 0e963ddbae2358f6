"""Is it safe?"""

SECTIONS = {
    "batch_losses": "Batches that fail",
    "fuzzing": "Fuzzing",
}
"""The sections of the page by the names of their modules, each with its title, in the order of the page."""
