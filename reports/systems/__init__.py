"""Is the catalog of plugins right? Checkouts of gz-sim and gz-sensors are given as ARGS."""
