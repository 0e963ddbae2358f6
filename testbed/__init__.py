"""What tests, reports and benchmarks share: real and generated robots, edits, mistakes, and programs that judge."""
