"""What do fixes and passes change?"""

SECTIONS = {
    "fixes": "Files after their fixes",
    "lumping": "Lumping of fixed joints",
    "physics": "Conversions for a consumer, and what the ledger lists",
    "classic": "From Gazebo Classic to gz-sim, over the corpus",
    "meshes": "Meshes",
}
"""The sections of the page by the names of their modules, each with its title, in the order of the page."""
