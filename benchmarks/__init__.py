"""Measurements: what the compiler makes of real files, what other engines find in its output, and how fast it is."""
