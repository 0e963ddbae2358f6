"""Measurements: what the compiler makes of real files, what other engines say of its output, and how fast it is."""
