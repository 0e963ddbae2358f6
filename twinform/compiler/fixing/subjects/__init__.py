"""The fixes of rules, by subject; each module has a table of fixers, or of fixers of texts."""
