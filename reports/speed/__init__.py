"""How fast is it?"""

SECTIONS = {
    "performance": "How fast it is",
    "growth": "How time grows",
    "editor": "An editor at work",
    "folders": "Folders and repositories",
    "batch": "Many models",
    "imports": "What commands import",
}
"""The sections of the page by the names of their modules, each with its title, in the order of the page."""
