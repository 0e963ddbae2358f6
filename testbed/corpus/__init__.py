"""Real models, and what the compiler makes of each."""
