"""SDF: front end and back end."""
