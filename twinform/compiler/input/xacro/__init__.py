"""xacro input: expanded in a process of its own."""
