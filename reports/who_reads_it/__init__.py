"""Who reads it?"""

SECTIONS = {
    "who_reads_what": "Who reads what",
    "loaders": "What loaders do, and what their profiles say",
    "portable": "Converted for all loaders",
    "gazebo_ready": "What was converted for Gazebo",
    "gazebo": "What Gazebo's engines make of SDF",
    "usd": "What converters to USD lose",
    "systems": "The catalog against the sources of Gazebo",
}
"""The sections of the page by the names of their modules, each with its title, in the order of the page."""
