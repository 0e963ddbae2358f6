"""Is every mistake found?"""

SECTIONS = {
    "mistakes": "Planted mistakes and false alarms",
    "agents": "Mistakes that a script mends with the tools of agents",
    "verdicts": "Mutated files before the parsers of record",
    "urdf_versions": "URDF 1.0, 1.1 and 1.2 before urdfdom 6",
    "changed_values": "What diff sees of a changed value",
    "mutation": "Mutation",
}
"""The sections of the page by the names of their modules, each with its title, in the order of the page."""
