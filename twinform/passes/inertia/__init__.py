"""Passes on mass and inertia: checking them, computing them from shapes, correcting them."""
