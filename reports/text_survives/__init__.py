"""Does the text survive, and do edits win?"""

SECTIONS = {
    "corpus": "What the compiler makes of real files",
    "comments": "Comments of real files, after everything that writes them",
    "edits": "Edits win",
    "mjcf_home": "Everything comes back from MJCF",
    "mjcf_edits": "Edits win in MJCF too",
    "following": "The other file follows",
    "xacro": "What becomes of real xacro files",
}
"""The sections of the page by the names of their modules, each with its title, in the order of the page."""
