"""The expressions of xacro, interpreted from their syntax tree: no `eval`, and nothing that leads to Python."""
