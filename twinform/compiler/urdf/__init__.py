"""URDF: front end and back end."""
