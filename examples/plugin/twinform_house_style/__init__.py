"""A pass and a rule of somebody else's."""
