"""Reproducers: files to run a failed pass again, for `twinform reproduce`."""
