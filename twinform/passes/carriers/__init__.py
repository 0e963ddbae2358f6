"""Carriers and annotations: elements of our namespace inside a file of the other format, for the reverse conversion."""
