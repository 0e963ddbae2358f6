"""The work on triangles with numpy, scipy, trimesh, coacd and fast-simplification: for the child process only."""
