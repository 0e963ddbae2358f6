"""Other model files: the contents of includes, and documents that passes ask for."""
