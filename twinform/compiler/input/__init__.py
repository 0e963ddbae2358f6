"""From a file to a verified document: parsing, recovery, xacro, JSON, and the front ends."""
