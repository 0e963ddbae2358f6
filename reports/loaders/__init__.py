"""Do the profiles say what the loaders do? Every loader reads the corpus and mutated files, beside its profile."""
