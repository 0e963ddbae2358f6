"""Passes on joint limits: checking, filling and tightening them, and soft limits."""
