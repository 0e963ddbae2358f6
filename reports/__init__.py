"""What measures: what the compiler makes of real files, and what other engines say of it. `make report` lists them."""
