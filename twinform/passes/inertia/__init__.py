"""Masses and inertias: finding what no body has, computing it from shapes, and the nearest that a body can have."""
