"""Passes on appearance and contact: materials, surfaces, and the URIs of their files."""
