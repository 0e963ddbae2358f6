"""Read-only questions that several passes ask of a model: bodies, shapes, meshes, automatic inertias."""
