"""Rewrites that several passes share: poses, frames, nested models, URIs."""
