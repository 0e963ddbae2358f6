"""What libsdformat finds in a robot beside bodies and joints, before and after a conversion."""
