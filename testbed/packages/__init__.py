"""Robots with meshes, and the programs that judge packages of them."""
