"""`python -m reports.pictures`: makes the pictures of the README and of the site, in a real browser."""
