"""Limits of joints: what they lack, what they cannot mean, and soft ones made hard."""
