"""How models look and touch: materials, surfaces, and where their files are."""
