"""Legalisation from SDF to URDF: a file for each pass, and `sequence.py` for their order."""
