"""How the work of commands grows with their files: documents of any size, and what is counted."""
