"""Is every conversion the same robot, by `twinform diff`?"""
