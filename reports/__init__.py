"""What measures: what the compiler makes of real files, and what other engines find in it. `make report` lists them."""
