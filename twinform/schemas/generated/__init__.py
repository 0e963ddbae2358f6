"""Python that `make generate` writes from the facts tables, so that no run has to; not to be edited."""
