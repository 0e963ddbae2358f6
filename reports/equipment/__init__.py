"""Does Gazebo find surfaces, materials, sensors, plugins and flags of SDF in our URDF, and of URDF in our SDF?"""
