"""Runs of `twinform batch` that are timed, killed and starved."""
