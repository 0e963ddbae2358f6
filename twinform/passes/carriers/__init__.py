"""Carriers and marks: what travels in our namespace inside a file of the other format, in both directions."""
