"""Passes that make cheaper or other mesh files, and that limit what sensors cost."""
