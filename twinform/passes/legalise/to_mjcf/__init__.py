"""Legalisation to MJCF: from the terms of SDF to the elements of MJCF."""
