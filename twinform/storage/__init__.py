"""Files that are written whole or not at all, and folders that go when the program does."""
