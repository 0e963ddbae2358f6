"""Tests. A package, so that no other one of this name takes its place: some wheels bring their own tests along."""
