"""Passes that make meshes and sensors cheaper, and meshes readable; another process works on the triangles."""
