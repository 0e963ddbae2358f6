"""Legalisation from URDF to SDF: a file for each pass, and `sequence.py` for their order."""
