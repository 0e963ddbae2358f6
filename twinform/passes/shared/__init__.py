"""What several passes share: questions to a model (bodies, shapes, meshes) and rewrites (poses, URIs, flattening)."""
