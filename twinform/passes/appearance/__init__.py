"""Passes on appearance and contact: materials, surfaces, shapes, and the URIs of their files."""
