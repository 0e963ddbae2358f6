"""Whether work grows in proportion to what a command is given."""
