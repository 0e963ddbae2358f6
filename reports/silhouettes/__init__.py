"""Are the pixels of a robot in the 3D view where its frames say, and the same from URDF as from SDF?"""
