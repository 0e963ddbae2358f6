"""Sizes of planes between SDF and MJCF: what a plane without an end is, and how wide its grid is."""

ENDLESS = 200.0
"""The size in m that a plane without an end has in SDF, where it only matters for what is seen."""
GRID = 1.0
"""The distance in m of the lines that are drawn on a plane."""
