"""Rewrites that several passes share: notation of poses, frames, nested models, URIs."""
