"""Are sensors and plugins of SDF still there when Gazebo reads the URDF?"""
