"""What do Gazebo's engines make of each element of SDF?"""
